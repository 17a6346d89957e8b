"""Natural frequencies and modes of a beam: certified, named, with error bounds and shapes.

    result = solve_modes(beam, modes=6)

Bending and longitudinal vibration are solved apart. Rigid modes are set aside by their index among
the eigenvalues, never because they look small; the others are numbered 1, 2, ... in order of
omega^2, whatever its sign.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
import numpy.typing as npt

from .beam import Beam
from .errors import ComputationError, InputError
from .kernel import kernel_if_worthwhile, shapes_for
from .limits import out_of_range_is_an_error
from .result import Kind, Method, ModalResult, Mode, Normalisation, Solution
from .riccati.chain import Chain, Family, omega2_scale
from .riccati.literal import find_eigenvalues_tmm
from .riccati.roots import CountingError, Eigenvalue, check_certificate, find_eigenvalues
from .riccati.shapes import Energies, propagate

Array = npt.NDArray[np.float64]
FAMILIES: tuple[Family, ...] = ("bending", "longitudinal")
_ROUNDING = 64 * np.finfo(float).eps  # times the conditioning of an eigenvalue
_MOST_SEGMENTS = 100_000
_MOST_WORK = 250_000  # segments times modes, some seconds
_LEAST_PER_MODE = 8  # segments that are never too many
_MODES_PER_REFINEMENT = 8  # that the coarsest steps are meant for
_MOST_DOUBTS = 5  # representations after which a strange order of convergence is accepted
_SAFETY = 2.5  # estimate over likely error
_ACCIDENT = 1 / 1024  # share of the last change but one that an estimate keeps
_LIKELY = 1e-9  # least relative distance of samples from where an eigenvalue is expected
_BESIDE = np.array([-4.0, -1.0, 1.0, 4.0])
_LAYER = 0.1  # N h^2/EI up to which two representations are enough where N alone varies
_NEAR_ZERO = 1e-9  # of the chain's own omega^2
_MODEL_LIMIT = 0.02


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
    families: Sequence[Family] | None = None,
    method: Method = "riccati",
    normalisation: Normalisation = "amplitude",
    unloaded: bool = False,
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
    families : sequence of {"bending", "longitudinal"}, optional
        Default: both, or bending alone where the beam has no axial stiffness.
    method : {"riccati", "tmm"}
        "tmm" scans the determinant of equation 66 instead: for comparison, without a certificate.
    normalisation : {"amplitude", "mass"}
        Largest displacement 1, or unit modal mass.
    unloaded : bool
        Also solve the beam without axial force, to tell what the force does to each mode.

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
    if not 1 <= modes <= 500:
        raise InputError(f"modes is {modes}; allowed are 1 ... 500 for each family")
    if not 1e-12 <= tolerance <= 0.1:
        raise InputError(f"tolerance is {tolerance:g}; allowed are 1e-12 ... 0.1 (relative)")
    beam = problem if isinstance(problem, Beam) else problem.beam()
    chosen = families or (FAMILIES if beam.axial_stiffness is not None else FAMILIES[:1])
    grid = _output_grid(beam, modes)
    found: list[Mode] = []
    segments: dict[str, int] = {}
    solutions: dict[Family, Solution] = {}
    warnings: list[str] = []
    for family in chosen:
        solved = _solve_family(beam, family, modes, tolerance, method)
        named, solutions[family] = _modes_of(beam, solved, grid, modes, normalisation)
        found += named
        segments[family] = len(solved.chain.length)
        warnings += solved.warnings
    if unloaded:
        found = _compare_unloaded(beam, found, modes, tolerance)
    if not all(np.isfinite(mode.omega2) for mode in found):
        raise ComputationError("a frequency is no finite number; check the units of the input")
    warnings += _result_warnings(beam, found)
    return ModalResult(
        beam=beam,
        modes=tuple(found),
        x=grid,
        method=method,
        tolerance=tolerance,
        normalisation=normalisation,
        segments=segments,
        solutions=solutions,
        warnings=tuple(warnings),
    )


@dataclass(frozen=True)
class _Solved:
    """Eigenvalues of one family on the finest chain, with the error of the representation."""

    chain: Chain
    eigenvalues: list[Eigenvalue]
    discretisation: Array
    warnings: list[str]


def rigid_modes(beam: Beam, family: Family) -> tuple[str, ...]:
    """Return the names of the rigid modes that the supports leave, e.g. translation, rotation."""
    freedoms = beam.freedoms(family)
    if len(freedoms) == 2:
        return "translation", "rotation"
    return tuple("translation" if _is_translation(row, beam) else "rotation" for row in freedoms)


def _is_translation(freedom: Array, beam: Beam) -> bool:
    return bool(abs(freedom[1]) * beam.length < 1e-9 * abs(freedom[0]))


def exact_zeros(beam: Beam, family: Family) -> int:
    """Return how many rigid modes have omega^2 = 0 exactly: translation, and all without N."""
    rigid = rigid_modes(beam, family)
    if family == "bending" and not beam.is_unloaded:
        return int("translation" in rigid)
    return len(rigid)


def _solve_family(
    beam: Beam, family: Family, modes: int, tolerance: float, method: Method
) -> _Solved:
    """Refine until the estimated error of every wanted frequency is within the tolerance.

    Two representations give an estimate. Where m or EI vary, the coarsest may be too coarse for
    the error to fall as the fourth power of the steps: further ones must confirm that it does.
    """
    wanted = modes + len(rigid_modes(beam, family))
    zeros = exact_zeros(beam, family)
    smooth = not np.any(beam.without_axial_force().varies(family))
    most = max(min(_MOST_SEGMENTS, _MOST_WORK // wanted), _LEAST_PER_MODE * wanted)
    refinement = max(1, wanted // _MODES_PER_REFINEMENT)
    chain = beam.chain(family, refinement)
    smooth = smooth and _resolves_force(chain)
    eigenvalues = _certified(chain, wanted, zeros)
    levels = [_omega2(eigenvalues)]
    error = np.zeros(len(eigenvalues))
    warnings: list[str] = []
    while np.any(beam.varies(family)):
        refinement *= 2
        chain, before = beam.chain(family, refinement), error
        eigenvalues = _certified(chain, wanted, zeros, _expected(levels))
        levels.append(_omega2(eigenvalues))
        error = _discretisation_error(levels[-3:])
        relative = _relative_error(chain, levels[-1], error)
        trusted = smooth or len(levels) > _MOST_DOUBTS or _order_is_four(levels, relative)
        if trusted and np.all(relative <= tolerance):
            break
        if 2 * len(chain.length) > most or _is_noise(error, before, relative):
            if np.any(relative > tolerance):
                warnings.append(
                    f"{family}: {len(chain.length)} segments do not reach the tolerance "
                    f"{tolerance:g}; see the errors, or ask for fewer modes or a larger tolerance"
                )
            break
    if method == "tmm":
        eigenvalues, error, more = _by_tmm(chain, eigenvalues, error, zeros)
        warnings += more
    return _Solved(chain, eigenvalues, error, warnings)


def _resolves_force(chain: Chain) -> bool:
    """Tell whether no segment is long against sqrt(EI/N), the width of a layer at an end."""
    if chain.family == "longitudinal":
        return True
    return bool(np.all(np.abs(chain.axial_force) * chain.length**2 < _LAYER * chain.stiffness))


def _expected(levels: list[Array]) -> Array | None:
    """Return places beside the next eigenvalues, if the error keeps falling as the fourth power."""
    if len(levels) < 2 or len(levels[-1]) != len(levels[-2]):
        return None
    last, change = levels[-1], levels[-1] - levels[-2]
    spread = np.maximum(np.abs(change) / 64, _LIKELY * np.abs(last))
    return np.unique(last + change / 16 + spread * _BESIDE[:, None])


def _certified(
    chain: Chain, wanted: int, zeros: int, expected: Array | None = None
) -> list[Eigenvalue]:
    width = 1e-10 if len(chain.length) <= 1000 else 2e-10
    compiled = kernel_if_worthwhile(len(chain.length), wanted)
    try:
        if compiled is not None:
            fast = compiled.find_eigenvalues(chain, wanted, zeros=zeros, width=width)
            if fast is not None and check_certificate(fast):
                return list(fast)
        found = find_eigenvalues(chain, wanted, zeros=zeros, width=width, expected=expected)
    except (CountingError, FloatingPointError) as error:
        raise ComputationError(
            f"the {chain.family} eigenvalues could not be certified: {error}; "
            "check stiffness, mass and axial force for values of a wrong unit"
        ) from error
    if not check_certificate(found):
        raise ComputationError(f"the counts of the {chain.family} modes contradict each other")
    return found


def _omega2(eigenvalues: list[Eigenvalue]) -> Array:
    return np.array([value.omega2 for value in eigenvalues])


def _discretisation_error(levels: list[Array]) -> Array:
    """Estimate the error of the last omega^2 from solutions with steps halved each time.

    When the error falls by 16 it is 1/15 of the last change. A multiple of that is reported, a
    larger one where the changes fall more slowly or faster, as they do before the fourth order is
    reached. Where two solutions agree by accident, a share of the change before takes over.
    """
    changes, fall = _changes(levels)
    error = changes[-1] * (_SAFETY / 15)
    if len(changes) > 1:
        fall = np.clip(np.minimum(fall, 256 / np.maximum(fall, 1.0)), 3.0, 16.0)
        error = np.maximum(_SAFETY * changes[-1] / (fall - 1), changes[-2] * _ACCIDENT)
    return np.append(error, np.full(len(levels[-1]) - len(error), np.max(error)))


def _changes(levels: list[Array]) -> tuple[Array, Array]:
    """Return how omega^2 changed from level to level, and by what the last change is smaller."""
    common = min(map(len, levels))
    changes = np.abs(np.diff([omega2[:common] for omega2 in levels], axis=0))
    return changes, changes[-2 % len(changes)] / np.maximum(changes[-1], np.finfo(float).tiny)


def _order_is_four(levels: list[Array], relative: Array) -> bool:
    """Tell whether the last change of every omega^2 is near 1/16 of the one before, or tiny."""
    if len(levels) < 3:
        return False
    _, fall = _changes(levels[-3:])
    near = (fall > 16 / 2.5) & (fall < 16 * 2.5)
    return bool(np.all(near | (relative[: len(fall)] < 1e-10)))


def _relative_error(chain: Chain, omega2: Array, error: Array) -> Array:
    """Return the error of each frequency relative to it (to the chain's own, where near zero)."""
    return np.asarray(error / 2 / np.maximum(np.abs(omega2), _NEAR_ZERO * omega2_scale(chain)))


def _is_noise(error: Array, before: Array, relative: Array) -> bool:
    """Tell whether estimates are so small, and fall so little, that rounding makes them."""
    common = min(len(error), len(before))
    falls_little = np.any(before) and np.all(error[:common] > before[:common] / 4)
    return bool(falls_little and np.max(relative) < _NEAR_ZERO)


def _by_tmm(
    chain: Chain, certified: list[Eigenvalue], error: Array, zeros: int
) -> tuple[list[Eigenvalue], Array, list[str]]:
    """Replace certified eigenvalues by those of the transfer matrix method, and compare."""
    lowest, highest = certified[0].omega2, certified[-1].omega2
    below = min(1.5 * lowest, -1e-3 * abs(highest))
    found = find_eigenvalues_tmm(
        chain, len(certified), below=below, above=1.1 * abs(highest), zeros=zeros
    )
    steps = sum(e.counts == (e.index - 1, e.index) or e.omega2 == 0.0 for e in found)
    warnings = []
    if steps < len(certified):
        warnings.append(
            f"{chain.family}: the transfer matrix scan confirms {steps} of "
            f"{len(certified)} eigenvalues; use the default method for a certified list"
        )
    if not found:
        raise ComputationError(f"the transfer matrix scan found no {chain.family} mode")
    return found, np.resize(error, len(found)), warnings


def _output_grid(beam: Beam, modes: int) -> Array:
    """Return breakpoints and points between, dense enough for smooth shapes [m]."""
    spacing = beam.length / max(200, 20 * (modes + 2))
    h = np.diff(beam.x)
    pieces = np.ceil(h / spacing).astype(int)
    k = np.repeat(np.arange(len(pieces)), pieces)
    number = np.arange(len(k)) - (np.cumsum(pieces) - pieces)[k]
    points = beam.x[k] + number * (h / pieces)[k]
    inner = [item.x for item in beam.attachments if beam.x[0] < item.x < beam.x[-1]]
    doubled = sorted({int(np.argmin(np.abs(beam.x - x))) for x in inner})
    return np.sort(np.concatenate([points, beam.x[-1:], beam.x[doubled]]))


def _modes_of(
    beam: Beam, solved: _Solved, grid: Array, modes: int, normalisation: Normalisation
) -> tuple[list[Mode], Solution]:
    """Name the eigenvalues, attach shapes and everything that follows from them."""
    family = solved.chain.family
    names = _names(beam, family, solved.eigenvalues)
    keep = [
        k
        for k, (value, (_, number)) in enumerate(zip(solved.eigenvalues, names, strict=True))
        if number <= modes or value.omega2 < 0
    ]
    chain = solved.chain.cut_at(np.unique(grid - grid[0]))
    omega2 = np.array([solved.eigenvalues[k].omega2 for k in keep])
    states = _shapes(beam, chain, solved.eigenvalues, keep, names)
    energies = shapes_for(len(chain.length), len(keep)).mode_energies(chain, states, omega2)
    scale = _normalising_factors(states, energies.mass, normalisation)
    states = states * scale[:, None]
    at_grid = _on_grid(chain, states, omega2, grid - grid[0])
    energies = energies.scaled(scale)
    model_errors = _model_errors(beam, chain, omega2, energies)
    quadratic = np.transpose(energies[1:]).tolist()
    rows = [
        _mode(solved, k, names[k], at_grid[:, column], quadratic[column], model_errors[column])
        for column, k in enumerate(keep)
    ]
    return _with_joint_brackets(rows), Solution(chain, omega2, states)


def _names(beam: Beam, family: Family, eigenvalues: list[Eigenvalue]) -> list[tuple[str, int]]:
    """Return name and number of each eigenvalue, rigid modes set aside by index."""
    rigid = list(rigid_modes(beam, family))
    names: list[tuple[str, int] | None] = [None] * len(eigenvalues)
    zeros = [k for k, value in enumerate(eigenvalues) if value.omega2 == 0.0]
    for k, name in zip(zeros, rigid[: exact_zeros(beam, family)], strict=False):
        names[k] = (f"rigid {name}", 0)
        rigid.remove(name)
    for name in rigid:  # a rotation that the axial force moves off zero is the lowest of the rest
        names[names.index(None)] = (f"rigid {name}", 0)
    number = 0
    for k, given in enumerate(names):
        if given is None:
            number += 1
            names[k] = (f"{family} {number}", number)
    return [name for name in names if name is not None]


def _shapes(
    beam: Beam,
    chain: Chain,
    eigenvalues: list[Eigenvalue],
    keep: list[int],
    names: list[tuple[str, int]],
) -> Array:
    """Return the states of the kept modes at all nodes; rigid modes at omega^2 = 0 are known."""
    size = 4 if chain.family == "bending" else 2
    states = np.zeros((len(chain.length) + 1, len(keep), size))
    free = [c for c, k in enumerate(keep) if eigenvalues[k].omega2 != 0.0 or names[k][1] > 0]
    for c in set(range(len(keep))) - set(free):
        states[:, c] = _rigid_state(beam, chain, names[keep[c]][0])
    if free:
        omega2 = np.array([eigenvalues[keep[c]].omega2 for c in free])
        clusters = np.array(
            [
                sum(eigenvalues[keep[o]].bracket == eigenvalues[keep[c]].bracket for o in free)
                for c in free
            ]
        )
        solver = shapes_for(len(chain.length), len(free))
        states[:, free] = solver.mode_states(chain, omega2, clusters)
    return states


def _rigid_state(beam: Beam, chain: Chain, name: str) -> Array:
    """Return the state of a rigid mode at omega^2 = 0, shape (nodes, s)."""
    state = np.zeros((len(chain.length) + 1, 4 if chain.family == "bending" else 2))
    if name == "rigid translation":
        state[:, 0] = 1.0
        return state
    freedoms = beam.freedoms("bending")
    held = len(freedoms) == 1
    pivot = -freedoms[0, 0] / freedoms[0, 1] if held else _centre_of_mass(chain)
    state[:, 0], state[:, 1] = chain.nodes - pivot, 1.0
    return state


def _centre_of_mass(chain: Chain) -> float:
    """Return the centre of all mass of a chain, from its left end [m]."""
    nodes = chain.nodes
    middle, dm = (nodes[1:] + nodes[:-1]) / 2, chain.mass * chain.length
    masses = np.array([p.mass for p in chain.points])
    places = np.array([nodes[p.node] + p.offset for p in chain.points])
    return float((dm @ middle + masses @ places) / (np.sum(dm) + np.sum(masses)))


def _on_grid(chain: Chain, states: Array, omega2: Array, grid: Array) -> Array:
    """Return the states at grid positions; a doubled position has its left side first."""
    nodes = chain.nodes
    node = np.clip(np.searchsorted(nodes, grid - 1e-9 * nodes[-1]), 0, len(nodes) - 1)
    values = states[node].copy()
    left = np.flatnonzero(np.diff(grid, append=np.inf) == 0.0)
    if len(left):
        before = node[left] - 1
        values[left] = propagate(chain, states[before], omega2, chain.length[before], before)
    return np.asarray(values)


def _normalising_factors(states: Array, mass: Array, normalisation: Normalisation) -> Array:
    """Return the factor for each mode: size as asked, first extremum from the nose positive."""
    displacement = states[..., 0]
    largest = np.max(np.abs(displacement), axis=0)
    sign = _first_extremum_signs(displacement, largest)
    return np.asarray(sign / (np.sqrt(mass) if normalisation == "mass" else largest))


def _first_extremum_signs(Y: Array, largest: Array) -> Array:
    """Return the sign of the first local maximum of every column of abs(Y), ends included."""
    size = np.abs(Y)
    extreme = size > 1e-3 * largest
    extreme[1:] &= size[1:] >= size[:-1]
    extreme[:-1] &= size[:-1] >= size[1:]
    first = np.argmax(extreme, axis=0)
    return np.where(Y[first, np.arange(Y.shape[1])] >= 0, 1.0, -1.0)


def _mode(
    solved: _Solved,
    k: int,
    named: tuple[str, int],
    shape: Array,
    quadratic: list[float],
    model_error: float | None,
) -> Mode:
    value, family = solved.eigenvalues[k], solved.chain.family
    (name, number), (mass, stiffness, size) = named, quadratic
    exact = value.omega2 == 0.0 and number == 0
    rounding = 0.0 if exact else _ROUNDING * size / mass
    low, high = value.bracket[0] - rounding, value.bracket[1] + rounding
    half = max(value.omega2 - low, high - value.omega2)
    error = 0.0 if exact else half + float(solved.discretisation[k])
    quotient = stiffness / mass
    reference = max(abs(value.omega2), 1e-9 * omega2_scale(solved.chain))
    kind: Kind = "divergent" if value.omega2 < 0 else "elastic" if number else "rigid"
    return Mode(
        family=family,
        number=number,
        name=name,
        kind=kind,
        omega2=value.omega2,
        bracket_omega2=(low, high),
        counts=value.counts,
        error_omega2=error,
        modal_mass=mass,
        residual=0.0 if exact else abs(quotient - value.omega2) / reference,
        model_error=model_error if number else None,
        states=shape,
    )


def _with_joint_brackets(modes: list[Mode]) -> list[Mode]:
    """Let modes share a bracket where rounding cannot part them."""
    groups: list[list[Mode]] = []
    for mode in modes:
        if groups and mode.bracket_omega2[0] <= max(m.bracket_omega2[1] for m in groups[-1]):
            groups[-1].append(mode)
        else:
            groups.append([mode])
    return [mode for group in groups for mode in (_sharing(group) if group[1:] else group)]


def _sharing(group: list[Mode]) -> list[Mode]:
    low, high = zip(*(mode.bracket_omega2 for mode in group), strict=True)
    below, above = zip(*(mode.counts for mode in group), strict=True)
    bracket, counts = (min(low), max(high)), (min(below), max(above))
    return [replace(mode, bracket_omega2=bracket, counts=counts) for mode in group]


def _model_errors(
    beam: Beam, chain: Chain, omega2: Array, energies: Energies
) -> list[float | None]:
    """Return the first-order effect of rotary inertia and shear on each frequency, relative.

    ``-1/2 [int m r^2 theta^2 + int M'^2/(kGA) / omega^2] / int m Y^2``, with the shear stiffness
    kGA = EA / (4 (1 + nu)) of a thin-walled tube, nu = 0.3.
    """
    if chain.family != "bending" or beam.axial_stiffness is None:
        return [None] * len(omega2)
    middle = (chain.nodes[1:] + chain.nodes[:-1]) / 2 + beam.x[0]
    k = np.clip(np.searchsorted(beam.x, middle) - 1, 0, len(beam.x) - 2)
    t = (middle - beam.x[k]) / np.diff(beam.x)[k]
    EA = beam.at(beam.axial_stiffness, k, t)
    if beam.radius_of_gyration is not None:
        r2 = beam.at(beam.radius_of_gyration, k, t) ** 2
    else:
        r2 = chain.stiffness / EA
    kGA = EA / (4 * 1.3)
    vibrates = omega2 > 0
    rotary = (chain.mass * r2) @ energies.squares.slope
    shear = (1 / kGA) @ energies.squares.shear / np.where(vibrates, omega2, 1.0)
    errors = (-(rotary + shear) / energies.mass / 2).tolist()
    return [e if known else None for e, known in zip(errors, vibrates.tolist(), strict=True)]


def _compare_unloaded(beam: Beam, found: list[Mode], modes: int, tolerance: float) -> list[Mode]:
    """Attach to every bending mode its omega^2 without axial force."""
    most = max((m.number for m in found if m.family == "bending"), default=0)
    if most == 0:
        return found
    free = beam.without_axial_force()
    solved = _solve_family(free, "bending", max(modes, most), tolerance, "riccati")
    names = _names(free, "bending", solved.eigenvalues)
    omega2 = {
        name: value.omega2 for (name, _), value in zip(names, solved.eigenvalues, strict=True)
    }
    return [
        replace(m, unloaded_omega2=omega2.get(m.name) if m.family == "bending" else m.omega2)
        for m in found
    ]


def _rotation_warning(beam: Beam) -> str:
    """Say why the rotation of a body that may turn diverges."""
    k = np.arange(len(beam.x) - 1)
    ends = [beam.axial_force_at(k, np.full(len(k), t)) for t in (0.0, 0.5, 1.0)]
    net = float(np.diff(beam.x) @ (ends[0] + 4 * ends[1] + ends[2])) / 6
    if net > 0 or beam.attachments:
        return (
            "rigid rotation is divergent (omega^2 < 0), as for every free body in net compression "
            "by forces of fixed direction; control of the attitude is outside this model"
        )
    return (
        "the lowest mode, counted as rigid rotation, is divergent (omega^2 < 0): the body is in "
        "net tension, but compressed in parts past their buckling; reduce the compression there"
    )


def _result_warnings(beam: Beam, modes: list[Mode]) -> list[str]:
    warnings = []
    divergent = [m.name for m in modes if m.kind == "divergent" and m.number]
    if divergent:
        warnings.append(
            f"{', '.join(divergent)}: omega^2 < 0, the axial compression is past buckling; "
            "the motion grows instead of vibrating: reduce the compression or stiffen the beam"
        )
    if any(m.kind == "divergent" and not m.number for m in modes):
        warnings.append(_rotation_warning(beam))
    errors = [(m.name, m.model_error) for m in modes if m.model_error is not None]
    large = [name for name, error in errors if abs(error) > _MODEL_LIMIT]
    if large:
        warnings.append(
            f"{large[0]} and above: shear and rotary inertia, which the model leaves out, lower "
            f"the frequency by more than {_MODEL_LIMIT:.0%}; use a Timoshenko model there"
        )
    return warnings
