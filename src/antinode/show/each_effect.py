"""What each effect does, as a picture: one bar a mode, each solved with the effect and without it.

The bar of an effect is ``f/f_without - 1`` at all that the beam has besides. Modes are compared by
their numbers, as everywhere.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.errors import ComputationError, InputError
from antinode.modes.solve import solve_modes

from .style import PALETTE, WIDTH, pyplot, styled, zero_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from antinode.modes.result import ModalResult


class EachEffect(NamedTuple):
    """What one effect does to the bending modes."""

    name: str
    """Of the effect: axial force N, ends that follow, shear, rotary inertia, foundation, ..."""
    change: Array
    """Relative, of the frequencies of modes 1, 2, ...; NaN where one of the two has none."""


def each_effect(result: ModalResult) -> tuple[EachEffect, ...]:
    """Return what each effect that a beam has does to its bending frequencies.

    Parameters
    ----------
    result : ModalResult
        With bending modes.

    Returns
    -------
    tuple of EachEffect
        Empty where the beam has none of them.

    Raises
    ------
    InputError
        If bending is not among the modes.
    """
    modes = [mode for mode in result.family(BENDING) if mode.number]
    if not modes:
        raise InputError("the effects are those on bending modes, and none was solved; ask for one")
    own = {mode.name: mode.omega2 for mode in modes if not mode.growth}
    return tuple(
        EachEffect(name, _change(own, without, len(modes), result.tolerance))
        for name, without in _without(result.beam)
    )


def _without(beam: Beam) -> Iterator[tuple[str, Beam]]:
    """Yield each effect that a beam has, and the beam without it."""
    if not beam.is_unloaded:
        yield "axial force N", beam.without_axial_force()
    if any(beam.following()):
        fixed = replace(beam.ends, left_follower=0.0, right_follower=0.0)
        yield "ends that follow", replace(beam, ends=fixed, end_force=None)
    if beam.is_timoshenko:
        if beam.shear_stiffness is not None:
            yield "shear", replace(beam, theory="timoshenko", shear_stiffness=None)
        if beam.rotary_inertia_per_length is not None or beam.radius_of_gyration is not None:
            bare = replace(beam, rotary_inertia_per_length=None, radius_of_gyration=None)
            yield "rotary inertia", replace(bare, theory="timoshenko")
    if beam.foundation_stiffness is not None:
        yield "foundation", replace(beam, foundation_stiffness=None)
    if beam.added_mass_per_length is not None:
        yield "added mass", replace(beam, added_mass_per_length=None)


def _change(own: dict[str, float], without: Beam, modes: int, tolerance: float) -> Array:
    """Return the relative change of each frequency, NaN where there is none."""
    change = np.full(modes, np.nan)
    try:
        found = solve_modes(without, modes, tolerance=tolerance, families=[BENDING])
    except ComputationError:
        return change
    bare = {mode.name: mode.omega2 for mode in found.modes if not mode.growth}
    for k in range(modes):
        name = f"{BENDING} {k + 1}"
        f2, g2 = own.get(name, math.nan), bare.get(name, math.nan)
        if f2 > 0 and g2 > 0:
            change[k] = math.sqrt(f2 / g2) - 1
    return change


@styled()
def plot_each_effect(effects: Sequence[EachEffect]) -> Figure:
    """Draw what each effect does, a panel for each, one bar a mode.

    Parameters
    ----------
    effects : sequence of EachEffect
        From `each_effect`.

    Raises
    ------
    InputError
        If there is no effect.
    """
    if not effects:
        raise InputError(
            "there is no effect to draw: the beam has no axial force, shear, rotary inertia, "
            "foundation or added mass"
        )
    plt = pyplot()
    figure: Figure = plt.figure(figsize=(WIDTH, 0.4 + 1.1 * len(effects)), layout="constrained")
    panels = figure.subplots(len(effects), 1, sharex=True, squeeze=False)[:, 0]
    for k, (axes, effect) in enumerate(zip(panels, effects, strict=True)):
        number = np.arange(1, len(effect.change) + 1)
        bars = axes.bar(number, 100 * effect.change, 0.6, color=PALETTE[k % len(PALETTE)])
        known = [f"{100 * c:+.2g} %" if np.isfinite(c) else "none" for c in effect.change]
        axes.bar_label(bars, known, padding=2, fontsize="small")
        axes.margins(y=0.35)
        axes.set_title(effect.name, loc="left", fontsize="medium")
        axes.set_ylabel("f [%]")
        axes.grid(visible=False, axis="x")
        zero_line(axes)
    panels[-1].set_xticks(number)
    panels[-1].set_xlabel("bending mode; each solved with the effect and without it")
    return figure
