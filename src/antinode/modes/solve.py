"""Natural frequencies and modes of a beam: certified, named, with error bounds and shapes.

    result = solve_modes(beam, modes=6)

Bending and longitudinal vibration are solved apart. Rigid modes are set aside by their index among
the eigenvalues, never because they look small; the others are numbered 1, 2, ... in order of
omega^2, whatever its sign.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from antinode.arguments import choice, whole, within
from antinode.arrays import Array
from antinode.beam.attachments import feeds_back, is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FAMILIES, FamilyName
from antinode.beam.limits import check_tension, out_of_range_is_an_error
from antinode.errors import ComputationError, InputError
from antinode.riccati.chain import omega2_scale
from antinode.riccati.normalised import Wanted
from antinode.riccati.roots import Eigenvalue
from antinode.text import short

from .backends import Backend, BackendName, choose, for_one
from .brackets import ROUNDING, cancelling
from .hertz import settled
from .naming import name_modes, with_joint_brackets
from .refinement import NEAR_ZERO, Solved, solve_family
from .result import Damping, Kind, Method, ModalResult, Mode, Normalisation, Solution
from .shapes import left_out, model_errors_of, normalised_modes, output_grid
from .solvers import Solver, solver_of


class HasBeam(Protocol):
    """Anything that can be turned into a beam, such as a case of a vehicle in a condition."""

    def beam(self) -> Beam:
        """Return the beam."""
        ...


@out_of_range_is_an_error()
def solve_modes(
    problem: Beam | HasBeam,
    modes: int = 6,
    *,
    tolerance: float = 1e-6,
    families: Sequence[FamilyName] | None = None,
    method: Method = "riccati",
    normalisation: Normalisation = "amplitude",
    unloaded: bool = False,
    backend: BackendName = "auto",
    damping: Damping = "auto",
) -> ModalResult:
    """Compute natural frequencies, modes and internal-force modes of a beam.

    Parameters
    ----------
    problem : Beam or case
        A beam, or anything with a method ``beam()``.
    modes : int
        Elastic modes 1 ... `modes` of each family; rigid and divergent ones always come along.
    tolerance : float
        Largest relative error of a frequency that is allowed to what varies inside segments.
    families : sequence of {"bending", "longitudinal", "torsion"}, optional
        Default: all for which the beam has the columns.
    method : {"riccati", "tmm"}
        "tmm" scans the determinant of equation 66 instead: for comparison, without a certificate.
    normalisation : {"amplitude", "mass"}
        Largest displacement 1, or unit modal mass.
    unloaded : bool
        Also solve the beam without axial force, to tell what the force does to each mode.
    backend : {"auto", "numpy", "numba"}
        Compiled code, or numpy, which is slower by some milliseconds for every hundred segments and
        mode, and needs no compiler once an install. "auto" is numba.
    damping : {"auto", "none", "complex"}
        Complex modes, motion ``exp(s t)``: "auto" where a dashpot or a feedback acts, "complex" in
        all families, "none" as if there were no dashpots. Loss factors count in complex modes.

    Returns
    -------
    ModalResult

    Raises
    ------
    InputError
        If an argument is outside its range.
    ComputationError
        If the eigenvalues could not be bracketed.
    """
    modes = whole("modes", modes, 500, " for each family")
    tolerance = within("tolerance", tolerance, 1e-12, 0.1, " (relative)")
    choice("normalisation", normalisation, Normalisation)
    solver = solver_of(method, choose(backend))
    beam = beam_of(problem)
    check_tension(beam)
    chosen = beam.families if families is None else _chosen(families)
    damped = [family for family in chosen if _complex(beam, family, damping, method)]
    found = _solve_families(
        beam, chosen, modes, tolerance, solver, method, normalisation, unloaded, damped
    )
    return _with_notes(found, problem)


def _complex(beam: Beam, family: FamilyName, damping: Damping, method: Method) -> bool:
    """Tell whether the modes of a family are complex.

    Raises
    ------
    InputError
        If there are no others, and they were not asked for.
    """
    choice("damping", damping, Damping)
    feedback = feeds_back(beam.attachments, family)
    turning = FAMILIES[family].law.has_axial_force and beam.loads_turn
    if method == "tmm" and damping == "complex":
        raise InputError(
            "method = 'tmm' scans real omega^2 and has no complex modes; leave it out for those"
        )
    if (feedback or turning) and (damping == "none" or method == "tmm"):
        asked = "damping = 'none'" if damping == "none" else "method = 'tmm'"
        what = "a point feedback" if feedback else "a tangential_load that turns with the section"
        raise InputError(
            f"{what} acts on the beam, and {asked} asks for modes that know nothing of "
            "it; leave that out for complex modes, or remove it from the beam"
        )
    own = damping == "auto" and method != "tmm" and is_damped(beam.attachments, family)
    own = own or turning
    return damping == "complex" or own


def beam_of(problem: Beam | HasBeam) -> Beam:
    """Return the beam of a problem, or say that there is none."""
    if isinstance(problem, Beam):
        return problem
    if not hasattr(problem, "beam"):
        raise InputError(
            f"the problem is {short(problem)}; a Beam or a case is wanted, such as "
            "load_beam('beam.toml') or load_case('case.toml')"
        )
    return problem.beam()


def _with_notes(result: ModalResult, problem: Beam | HasBeam) -> ModalResult:
    """Return the result with what the file of its problem should have been told about."""
    notes = getattr(problem, "notes", ())
    return replace(result, noted=(*notes, *result.noted)) if notes else result


def _solve_families(
    beam: Beam,
    families: Sequence[FamilyName],
    modes: int,
    tolerance: float,
    solver: Solver,
    method: Method,
    normalisation: Normalisation,
    unloaded: bool,
    damped: Sequence[FamilyName],
) -> ModalResult:
    """Solve family after family, and gather what was found."""
    grid = output_grid(beam, modes)
    found: list[Mode] = []
    segments: dict[str, int] = {}
    solutions: dict[FamilyName, Solution] = {}
    warnings: list[str] = []
    certificates: dict[FamilyName, Mapping[str, Any]] = {}
    for family in families:
        if family in damped:
            from .damped.modes import damped_modes

            own = damped_modes(
                beam, family, modes, tolerance, solver.backend, grid, normalisation, lossy=True
            )
            found += own.modes
            solutions[family], segments[family] = own.solution, own.segments
            warnings += own.warnings
            certificates[family] = own.certificate
            continue
        solved = solve_family(beam, family, modes, tolerance, solver)
        named, solutions[family] = _modes_of(
            solver.backend, beam, solved, grid, modes, normalisation
        )
        found += named
        segments[family] = len(solved.chain.length)
        warnings += solved.warnings
        certificates[family] = solved.certificate
    if unloaded:
        found = _compare_unloaded(solver.counting, beam, found, modes, tolerance)
    found = _compare_rigid_in_shear(solver.counting, beam, found, modes, tolerance)
    if not all(math.isfinite(mode.omega2) for mode in found):
        raise ComputationError("a frequency is no finite number; check the units of the input")
    return ModalResult(
        beam=beam,
        modes=tuple(found),
        x=grid,
        method=method,
        tolerance=tolerance,
        normalisation=normalisation,
        segments=segments,
        solutions=solutions,
        noted=tuple(warnings),
        certificate=certificates.get(BENDING, next(iter(certificates.values()))),
    )


@out_of_range_is_an_error()
def solve_one(problem: Beam | HasBeam, modes: int = 6, **settings: Any) -> ModalResult:
    """Compute what `solve_modes` does, for a command that solves one problem and ends.

    A small one is solved by numpy, so that a fresh install answers before anything is compiled. An
    interval in which something varies counts as the segments of its first three representations.
    """
    beam = beam_of(problem)
    segments = max(int(np.sum(np.where(beam.varies(f), 14, 1))) for f in beam.families)
    found = solve_modes(beam, modes, backend=for_one(segments, modes), **settings)
    return _with_notes(found, problem)


def _chosen(families: Sequence[FamilyName]) -> tuple[FamilyName, ...]:
    """Return the families asked for, each once; one may stand by itself."""
    names: list[Any] = [families] if isinstance(families, str) else list(dict.fromkeys(families))
    if not names:
        raise InputError("families is empty; name at least one, or leave it out for all")
    for name in names:
        choice("a family of modes", name, FamilyName)
    return tuple(names)


def _modes_of(
    backend: Backend,
    beam: Beam,
    solved: Solved,
    grid: Array,
    modes: int,
    normalisation: Normalisation,
) -> tuple[list[Mode], Solution]:
    """Name the eigenvalues, attach shapes and everything that follows from them."""
    family = solved.chain.family
    names = name_modes(beam, family, solved.eigenvalues)
    keep = [
        k
        for k, (value, (_, number)) in enumerate(zip(solved.eigenvalues, names, strict=True))
        if number <= modes or value.order < 0 or value.imaginary
    ]
    places = grid - grid[0]
    chain = backend.cut(solved.chain, places, np.array([solved.eigenvalues[k].value for k in keep]))
    wanted = Wanted(places, left_out(beam, chain), normalisation == "mass")
    omega2, (states, at_grid, forms) = normalised_modes(
        backend, beam, chain, solved.eigenvalues, keep, names, wanted
    )
    mass = np.abs(forms.mass)
    model_errors = model_errors_of(beam, chain, omega2, forms)
    size = cancelling(forms.size, mass, omega2)
    off = np.abs(forms.stiffness / forms.mass - omega2)
    quadratic = zip(mass.tolist(), off.tolist(), size.real.tolist(), strict=True)
    near_zero = NEAR_ZERO * omega2_scale(solved.chain)
    given = zip(keep, at_grid.real, quadratic, model_errors, strict=True)
    rows = [
        _mode(solved, k, names[k], shape, sums, model_error, near_zero)
        for k, shape, sums, model_error in given
    ]
    if chain.follows:
        return rows, Solution(chain, omega2, states)
    return with_joint_brackets(rows), Solution(chain, omega2, states)


def _mode(
    solved: Solved,
    k: int,
    named: tuple[str, int],
    shape: Array,
    quadratic: tuple[float, float, float],
    model_error: float | None,
    near_zero: float,
) -> Mode:
    value, family = solved.eigenvalues[k], solved.chain.family
    (name, number), (mass, off, size) = named, quadratic
    exact = value.omega2 == 0.0 and number == 0
    rounding = 0.0 if exact else ROUNDING * size
    if math.isnan(mass):  # no shape: as if much cancelled
        rounding = 1e3 * ROUNDING * abs(value.omega2)
    moved = value.order - value.omega2
    low, high = value.bracket[0] - rounding, value.bracket[1] + rounding
    half = max(value.omega2 - low, high - value.omega2)
    error = 0.0 if exact else half + float(solved.discretisation[k])
    omega2, error = settled(value.order, error)
    reference = max(abs(value.value), near_zero)
    growth = _growth(value)
    kind: Kind = "divergent" if omega2 < 0 else "elastic" if number else "rigid"
    return Mode(
        family=family,
        number=number,
        name=name,
        kind="flutter" if growth > 0 else kind,
        omega2=omega2,
        bracket_omega2=(low + moved, high + moved),
        counts=value.counts,
        error_omega2=error,
        modal_mass=mass,
        residual=0.0 if exact else off / reference,
        model_error=model_error if number else None,
        states=shape,
        growth=growth,
    )


def _growth(value: Eigenvalue) -> float:
    """Return Re s of a complex eigenvalue ``omega^2 = -s^2``: the second of a pair grows."""
    if not value.imaginary:
        return 0.0
    return math.copysign((-(value.value**0.5)).imag, -value.imaginary)


def _compare_unloaded(
    solver: Solver, beam: Beam, found: list[Mode], modes: int, tolerance: float
) -> list[Mode]:
    """Attach to every mode its omega^2 without axial force: its own where N does not matter."""
    plain = [m for m in found if m.eigenvalue is None]
    if not plain:
        return found
    moved = {m.family for m in plain if FAMILIES[m.family].law.has_axial_force}
    free = {name: _unloaded(solver, beam, name, plain, modes, tolerance) for name in moved}
    return [
        m
        if m.eigenvalue is not None
        else replace(
            m, unloaded_omega2=free[m.family].get(m.name) if m.family in free else m.omega2
        )
        for m in found
    ]


def _compare_rigid_in_shear(
    solver: Solver, beam: Beam, found: list[Mode], modes: int, tolerance: float
) -> list[Mode]:
    """Attach to every mode what shear and rotary inertia do to its frequency, if they are solved.

    The modes of both theories are compared by their numbers.
    """
    if not beam.is_timoshenko:
        return found
    plain = replace(beam, theory="euler_bernoulli")
    compared = []
    for family, entry in FAMILIES.items():
        own = [mode for mode in found if mode.family == family]
        if own and own[0].eigenvalue is None and entry.used(beam) != entry.used(plain):
            solved = solve_family(plain, family, modes, tolerance, solver)
            names = name_modes(plain, family, solved.eigenvalues)
            values = zip(names, solved.eigenvalues, strict=True)
            rigid = {name: value.omega2 for (name, number), value in values if number}
            own = [replace(m, effect_of_shear=_effect(m, rigid.get(m.name))) for m in own]
        compared += own
    return compared


def _effect(mode: Mode, rigid: float | None) -> float | None:
    """Return the relative change of a frequency from omega^2 = `rigid`; None if one is none."""
    if rigid is None or rigid <= 0 or mode.omega2 <= 0 or mode.growth:
        return None
    return math.sqrt(mode.omega2 / rigid) - 1


def _unloaded(
    solver: Solver,
    beam: Beam,
    family: FamilyName,
    found: list[Mode],
    modes: int,
    tolerance: float,
) -> dict[str, float]:
    """Return omega^2 without axial force by the names of the modes of a family."""
    most = max(m.number for m in found if m.family == family)
    free = beam.without_axial_force()
    solved = solve_family(free, family, max(modes, most), tolerance, solver)
    names = name_modes(free, family, solved.eigenvalues)
    return {name: value.omega2 for (name, _), value in zip(names, solved.eigenvalues, strict=True)}
