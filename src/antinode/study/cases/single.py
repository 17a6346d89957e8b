"""One beam of a study by itself: frequencies alone where that is quick, else all of its modes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.errors import AntinodeError
from antinode.modes.backends import choose
from antinode.modes.following import energies_of_modes
from antinode.modes.frequencies import natural_frequencies
from antinode.modes.hertz import error_hz, growth_rate, hertz
from antinode.modes.rigid import pivot_of, rigid_modes, rigid_rotation, turns_freely
from antinode.modes.shapes import can_estimate, estimate_model_errors
from antinode.modes.solve import solve_modes
from antinode.riccati.roots import CountingError
from antinode.riccati.shapes import split_for
from antinode.vehicle.derivatives import ChainModes

from .bending import unit_shapes


class Motion(NamedTuple):
    """How the modes of a beam move, which may be damped or grow; each of shape (modes,).

    Attributes
    ----------
    frequency_hz, error_hz : array
        [Hz].
    growth_rate_per_s : array
        Re s [1/s].
    damping_ratio : array
        -Re s over abs(s).
    """

    frequency_hz: Array
    error_hz: Array
    growth_rate_per_s: Array
    damping_ratio: Array

    @classmethod
    def steady(cls, omega2: Array, error: Array) -> Motion:
        """Return that of modes which nothing damps."""
        ratio = np.where(omega2 > 0, 0.0, np.where(omega2 < 0, -1.0, np.nan))
        return cls(hertz(omega2), error_hz(omega2, error), growth_rate(omega2), ratio)


class Solved(NamedTuple):
    """One family of a beam.

    Attributes
    ----------
    family : str
    omega2, error : array, shape (modes,)
        Of the elastic modes 1, 2, ... [rad^2/s^2].
    model_error : array or None
        What the model leaves out, relative, (modes,), if it is known already.
    effect_of_shear : array or None
        What shear and rotary inertia do to each frequency, solved, relative, (modes,), likewise.
    warnings : tuple of str or None
        The same of what is warned of.
    motion : Motion or None
        What vibrates how, if that is not told by omega^2 alone.
    """

    family: FamilyName
    omega2: Array
    error: Array
    model_error: Array | None = None
    effect_of_shear: Array | None = None
    warnings: tuple[str, ...] | None = None
    motion: Motion | None = None


def is_quick(beam: Beam, family: FamilyName) -> bool:
    """Tell whether frequencies alone are found much sooner than modes."""
    own = FAMILIES[family]
    plain = not beam.is_curved and not own.used(beam) and not any(beam.following(family))
    return own.rotary and plain and not is_damped(beam.attachments, family)


def solve_alone(beam: Beam, family: FamilyName, modes: int, tolerance: float) -> Solved | None:
    """Return one family of a beam; None where it cannot be solved."""
    try:
        with np.errstate(all="ignore"):
            if is_quick(beam, family):
                quick = natural_frequencies(beam, modes, tolerance=tolerance)
                if quick.omega2[0] > quick.error_omega2[0]:
                    return Solved(family, quick.omega2, quick.error_omega2)
            return _by_modes(beam, family, modes, tolerance)
    except (AntinodeError, ArithmeticError, CountingError):
        return None


def _by_modes(beam: Beam, family: FamilyName, modes: int, tolerance: float) -> Solved | None:
    result = solve_modes(beam, modes, tolerance=tolerance, families=[family])
    own = [m for m in result.modes if m.number][:modes]
    if len(own) < modes:
        return None
    estimated, solved = (
        np.array([np.nan if getattr(m, name) is None else getattr(m, name) for m in own])
        for name in ("model_error", "effect_of_shear")
    )
    return Solved(
        family,
        np.array([m.omega2 for m in own]),
        np.array([m.error_omega2 for m in own]),
        estimated,
        solved,
        result.warnings,
        Motion(*(np.array([getattr(m, n) for m in own], dtype=float) for n in Motion._fields)),
    )


def model_error(beam: Beam, family: FamilyName, omega2: Array) -> Array:
    """Return the estimated effect of what the model leaves out on each frequency, relative."""
    if not can_estimate(beam, family):
        return np.full(len(omega2), np.nan)
    compiled = choose("numba")
    try:
        with np.errstate(all="ignore"):
            chain = split_for(beam.chain(family), np.abs(omega2))
            states = compiled.mode_states(chain, omega2, np.ones(len(omega2), dtype=np.int64))
            energies = energies_of_modes(compiled, chain, states, omega2)
            effect = estimate_model_errors(beam, chain, omega2, energies)
    except (AntinodeError, ArithmeticError, ValueError):
        effect = [None] * len(omega2)
    return np.array([np.nan if e is None else e for e in effect])


def shapes_of(beam: Beam, family: FamilyName, omega2: Array, x: Array) -> Array:
    """Return the shapes at places [m], of unit norm, (modes, places)."""
    modes = ChainModes(beam.chain(family), omega2, shear_form=beam.shear_form)
    return unit_shapes(modes.displacement(x - beam.x[0]))


def rotation_diverges(beam: Beam, family: FamilyName, omega2: Array) -> bool:
    """Tell whether a rigid rotation of the beam has omega^2 < 0, where its elastic modes have none.

    By the count of eigenvalues below zero, where end forces keep their direction; where they
    follow, by the sign of what turns the body.
    """
    loaded = FAMILIES[family].law.has_axial_force and not beam.is_unloaded
    if not loaded or "rotation" not in rigid_modes(beam, family):
        return False
    chain, small = beam.chain(family), _SMALL * float(np.abs(omega2[-1]))
    if chain.follows:
        free = turns_freely(beam, family)
        return not free and rigid_rotation(chain, pivot_of(beam)) < -small
    return int(choose("numba").evaluate(chain, np.array([-small])).below[0]) > 0


_SMALL = 1e-9  # of the highest omega^2: rounding of one that is zero
