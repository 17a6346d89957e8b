"""One beam of a study by itself: frequencies alone where that is quick, else all of its modes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Complex
from antinode.beam.attachments import is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.errors import AntinodeError
from antinode.modes.backends import choose
from antinode.modes.following import energies_of_modes
from antinode.modes.frequencies import natural_frequencies
from antinode.modes.hertz import error_hz, growth_rate, hertz
from antinode.modes.result import ModalResult, Mode
from antinode.modes.rigid import pivot_of, rigid_modes, rigid_rotation, turns_freely
from antinode.modes.shapes import can_estimate, estimate_model_errors
from antinode.modes.solve import solve_modes
from antinode.riccati.roots import CountingError
from antinode.riccati.shapes import split_for
from antinode.study.design.file import KINDS
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
    kind : array
        By the numbers of `KINDS`.
    """

    frequency_hz: Array
    error_hz: Array
    growth_rate_per_s: Array
    damping_ratio: Array
    kind: Array

    @classmethod
    def steady(cls, omega2: Array, error: Array) -> Motion:
        """Return that of modes which nothing damps."""
        return cls.of_squares(omega2, error, growth_rate(omega2))

    @classmethod
    def of_squares(cls, omega2: Array, error: Array, growth: Array) -> Motion:
        """Return that of modes by omega^2, which diverge or flutter by growth, else NaN."""
        rate = np.nan_to_num(growth)
        with np.errstate(invalid="ignore", divide="ignore"):
            size = np.where(omega2 < 0, np.abs(rate), np.hypot(rate, np.sqrt(omega2)))
            ratio = -rate / size + 0.0
            flutters = np.where(rate > 0, KINDS.index("flutter"), KINDS.index("elastic"))
            kind = np.where(omega2 < 0, KINDS.index("divergent"), flutters)
        kind = np.where(np.isfinite(omega2), kind, np.nan)
        return cls(hertz(omega2), error_hz(omega2, error), growth, ratio, kind)

    @classmethod
    def of_modes(cls, modes: Sequence[Mode]) -> Motion:
        """Return that of modes as they were solved."""
        kinds = [KINDS.index(m.kind) for m in modes]
        told = {
            name: np.array([getattr(m, name) for m in modes], dtype=float)
            for name in cls._fields[:-1]
        }
        return cls(**told, kind=np.array(kinds, dtype=float))


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
    proven, is_complex : bool
        Whether all of its modes are proven to be found, and whether they are complex.
    shapes : array or None
        Of complex modes at the places asked for, of unit norm, (modes, places).
    """

    family: FamilyName
    omega2: Array
    error: Array
    model_error: Array | None = None
    effect_of_shear: Array | None = None
    warnings: tuple[str, ...] | None = None
    motion: Motion | None = None
    proven: bool = True
    is_complex: bool = False
    shapes: Array | None = None


def is_quick(beam: Beam, family: FamilyName) -> bool:
    """Tell whether frequencies alone are found much sooner than modes."""
    own = FAMILIES[family]
    plain = not beam.is_curved and not own.used(beam) and not any(beam.following(family))
    return own.rotary and plain and not is_damped(beam.attachments, family)


def solve_alone(
    beam: Beam, family: FamilyName, modes: int, tolerance: float, x: Array | None = None
) -> Solved | None:
    """Return one family of a beam, complex shapes at places [m]; None where it is not solved."""
    try:
        with np.errstate(all="ignore"):
            if is_quick(beam, family):
                quick = natural_frequencies(beam, modes, tolerance=tolerance)
                if quick.omega2[0] > quick.error_omega2[0]:
                    return Solved(family, quick.omega2, quick.error_omega2)
            return _by_modes(beam, family, modes, tolerance, x)
    except (AntinodeError, ArithmeticError, CountingError):
        return None


def _by_modes(
    beam: Beam, family: FamilyName, modes: int, tolerance: float, x: Array | None
) -> Solved | None:
    result = solve_modes(beam, modes, tolerance=tolerance, families=[family])
    own = [m for m in result.modes if m.number][:modes]
    if len(own) < modes:
        return None
    is_complex = any(m.eigenvalue is not None for m in own)
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
        Motion.of_modes(own),
        result.certificate.get("kind") != "none",
        is_complex,
        None if x is None or not is_complex else _complex_shapes(result, family, modes, x),
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


def _complex_shapes(result: ModalResult, family: FamilyName, modes: int, x: Array) -> Array:
    rows = [k for k, mode in enumerate(result.family(family)) if mode.number][:modes]
    at = result.solutions[family].at(x - result.beam.x[0])[:, rows, 0]
    return unit_shapes(in_phase(np.asarray(at, dtype=complex)))


def in_phase(displacement: Complex) -> Array:
    """Return complex shapes (points, modes) at the phase at which most of them moves."""
    square = np.sum(displacement**2, axis=0)
    return np.asarray((displacement * np.exp(-0.5j * np.angle(square))).real)


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
