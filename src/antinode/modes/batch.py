"""Certified bending frequencies of many beams at once, by the compiled chain.

    result = solve_many(BeamBatch(length, mass_per_length, bending_stiffness, axial_force))
    result.frequencies_hz

Every beam is a chain of uniform segments, exact as it stands; rigid modes are set aside by their
index. Each beam starts from the roots of the one before, so that a sweep is best kept in order.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from antinode.arguments import ByValue, owned, whole
from antinode.arrays import Array, Integers
from antinode.beam.ends import FREE, Ends
from antinode.errors import InputError
from antinode.riccati.chain import Chain
from antinode.riccati.chains import ChainRoots, Chains
from antinode.riccati.laws import BENDING
from antinode.riccati.reasons import (
    BY_ITSELF,
    CLUSTERED,
    INVALID,
    NOT_BRACKETED,
    NOT_FINITE,
    OUT_OF_REACH,
    PAST_BUCKLING,
)
from antinode.riccati.roots import CountingError, Eigenvalue, check_certificate
from antinode.riccati.shapes import split_for

from .backends import Backend, BackendName, choose
from .brackets import share_brackets
from .guesses import guess_omega2
from .hertz import error_hz, hertz
from .rigid import elastic, rigid_modes_of, translates, zeros_of

REASONS = (
    "",
    "out of reach: stiffness, mass and axial force of one segment do not go together",
    "not certified: the counts did not bracket every mode",
    "not certified: the characteristic function is not finite",
    "invalid: length, mass and stiffness must be positive, and everything finite",
    "not certified: modes too close to each other for the counts between them",
    "past buckling: omega^2 of the first mode is negative",
)
"""What the codes in `BatchResult.reason` mean; 0 is success."""

_WIDTH = 0.98e-10  # of a bracket before its rounding, relative in omega^2
_ROUNDING = 64 * np.finfo(float).eps
_ALONE = NOT_BRACKETED, CLUSTERED, BY_ITSELF


@dataclass(frozen=True, eq=False)
class BeamBatch(ByValue):
    """Beams of as many uniform segments each, one a row.

    Parameters
    ----------
    length : array, shape (n,) or (beams, n)
        Of the segments, from left to right [m].
    mass_per_length, bending_stiffness : array, shape (n,) or (beams, n)
        m [kg/m] and EI [N m^2].
    axial_force : array, shape (n,) or (beams, n), optional
        N [N], compression positive; zero by default.
    ends : Ends
        The same for all beams.
    modes : int
        Elastic modes 1 ... `modes` are computed.

    Raises
    ------
    InputError
        If the shapes do not go together, or a value is masked. Values are checked beam by beam
        when they are solved.

    Notes
    -----
    Immutable: it owns its arrays, which are copied unless they are read-only, compares by value,
    and has a hash.
    """

    length: Array
    mass_per_length: Array
    bending_stiffness: Array
    axial_force: Array = field(default_factory=lambda: np.zeros(1))
    ends: Ends = FREE
    modes: int = 6
    _one_structure: bool = field(default=False, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", whole("modes", self.modes, 500))
        tables = [owned(name, getattr(self, name)) for name in _ARRAYS]
        rows, n = _common_shape(tables)
        object.__setattr__(self, "_one_structure", all(_rows(v) == 1 for v in tables[:3]))
        for name, values in zip(_ARRAYS, tables, strict=True):
            shape = (_rows(values) if name == "length" else rows, n)
            if values.shape != shape:
                same = values.size == shape[0] * n
                values = values.reshape(shape) if same else np.broadcast_to(values, shape)
            kept = np.ascontiguousarray(values).view()
            kept.flags.writeable = False
            object.__setattr__(self, name, kept)

    def __len__(self) -> int:
        return len(self.mass_per_length)


def _rows(values: Array) -> int:
    return len(values) if values.ndim > 1 else 1


def _common_shape(tables: list[Array]) -> tuple[int, int]:
    """Return how many beams and segments the arrays of a batch describe."""
    rows, n = max(map(_rows, tables)), max(v.shape[-1] if v.ndim else 1 for v in tables)
    for values in tables:
        columns = values.shape[-1] if values.ndim else 1
        if values.ndim > 2 or _rows(values) not in (1, rows) or columns not in (1, n) or not n:
            told = ", ".join(f"{k} {v.shape}" for k, v in zip(_ARRAYS, tables, strict=True))
            raise InputError(
                "the arrays of a batch have shapes (segments,) or (beams, segments); "
                f"received {told}"
            )
    return rows, n


_ARRAYS = ("length", "mass_per_length", "bending_stiffness", "axial_force")


@dataclass(frozen=True, eq=False)
class BatchResult(ByValue):
    """Elastic bending modes of every beam of a batch, each with its certificate.

    Attributes
    ----------
    omega2 : array, shape (beams, modes)
        [rad^2/s^2]; NaN where a beam could not be solved.
    bracket_omega2 : array, shape (beams, modes, 2)
        Encloses the eigenvalue, rounding included [rad^2/s^2].
    counts : array of int, shape (beams, modes, 2)
        Number of eigenvalues, rigid ones included, below either end of the bracket.
    error_omega2 : array, shape (beams, modes)
        Distance to the farther end of the bracket [rad^2/s^2].
    reason : array of int, shape (beams,)
        0, or why a beam has NaN among its frequencies: an index of `REASONS`.
    evaluations : array of int, shape (beams,)
        How often the chain was evaluated.
    """

    omega2: Array
    bracket_omega2: Array
    counts: Integers
    error_omega2: Array
    reason: Integers
    evaluations: Integers

    @property
    def frequencies_hz(self) -> Array:
        """Natural frequencies [Hz], shape (beams, modes); NaN where omega^2 < 0 or unknown."""
        return hertz(self.omega2)

    @property
    def error_hz(self) -> Array:
        """Half-width of the interval of frequency that holds the beam's own [Hz]."""
        return error_hz(self.omega2, self.error_omega2)

    def why(self, beam: int) -> str:
        """Return why a beam has NaN among its frequencies; empty if it has none."""
        return REASONS[self.reason[beam]]

    def __len__(self) -> int:
        return len(self.omega2)


def solve_many(batch: BeamBatch, *, backend: BackendName = "auto") -> BatchResult:
    """Compute the natural frequencies of every beam of a batch, with brackets and counts.

    Parameters
    ----------
    batch : BeamBatch
    backend : {"auto", "numpy", "numba"}
        What solves: compiled code, or numpy, which takes some milliseconds a beam. "auto" is numba.

    Returns
    -------
    BatchResult
        A beam that fails has NaN and a reason; the others are not touched by it.
    """
    solver = choose(backend)
    found = _solve(solver, batch)
    omega2, low, high, counts, rounding, reason, evaluations = found
    if translates(batch.ends):  # past buckling its omega^2 = 0 lies above an elastic mode
        reason[(reason == 0) & (omega2[:, 0] < 0)] = NOT_BRACKETED
    if not np.isfinite(high).all():
        reason[(reason == 0) & ~np.isfinite(high).all(axis=1)] = NOT_FINITE
    if reason.any():
        for row in np.flatnonzero(np.isin(reason, _ALONE)):
            reason[row] = _alone(solver, batch, int(row), found)
        failed = reason != 0
        omega2[failed], low[failed], high[failed], counts[failed] = np.nan, np.nan, np.nan, -1
    bracket = np.empty((*omega2.shape, 2))
    low = np.subtract(low, rounding, out=bracket[..., 0])
    high = np.add(high, rounding, out=bracket[..., 1])
    if (low[:, 1:] <= high[:, :-1]).any():
        for row in np.flatnonzero(np.any(low[:, 1:] <= high[:, :-1], axis=1)):
            share_brackets(low[row], high[row], counts[row])
    reason[omega2[:, 0] < 0] = PAST_BUCKLING
    error = np.maximum(high - omega2, omega2 - low)
    return BatchResult(omega2, bracket, counts, error, reason, evaluations)


def _solve(solver: Backend, batch: BeamBatch) -> ChainRoots:
    """Solve chain after chain; where loads alone vary, by guesses from a few of them."""
    below, chains = rigid_modes_of(batch.ends), _chains(batch)
    guess = None
    if batch._one_structure and solver.name != "numpy":
        guess = guess_omega2(batch.axial_force, lambda N: _exact(batch, N))
    if guess is None:
        return solver.solve_chains(chains, below, batch.modes, _WIDTH)
    found = solver.certify_guesses(chains, guess, below, _WIDTH)
    again = np.flatnonzero(found.reason)
    if len(again):
        part = solver.solve_chains(chains.some(again), below, batch.modes, _WIDTH)
        part.evaluations[:] += found.evaluations[again]
        for values, others in zip(found, part, strict=True):
            values[again] = others
    return found


def _chains(batch: BeamBatch) -> Chains:
    h, m, EI, N = (getattr(batch, name) for name in _ARRAYS)
    return Chains(BENDING, h, m, EI, N, batch.ends.left, batch.ends.right)


def _exact(batch: BeamBatch, force: Array) -> Array:
    """Return omega^2 of the batch's structure under other forces, NaN where it is not certain."""
    h, m, EI = batch.length[0], batch.mass_per_length[0], batch.bending_stiffness[0]
    some = BeamBatch(h, m, EI, force, batch.ends, batch.modes)
    object.__setattr__(some, "_one_structure", False)
    return solve_many(some).omega2


def _alone(solver: Backend, batch: BeamBatch, row: int, results: ChainRoots) -> int:
    """Solve a beam by itself; return the reason if it cannot be solved.

    Modes that nearly coincide are parted by frames; past buckling an elastic mode lies below the
    translation, whose omega^2 = 0 is set aside.
    """
    below, chain = rigid_modes_of(batch.ends), _chains(batch)[row]
    if not _is_valid(chain):
        return INVALID
    zeros = zeros_of(batch.ends, chain.axial_force)
    try:
        found = solver.find_eigenvalues(chain, below + batch.modes, zeros=zeros, width=_WIDTH)
        if not check_certificate(found):
            return NOT_BRACKETED
        wanted = elastic(found, below)[: batch.modes]
        rounding = _rounding_by_shapes(solver, chain, wanted)
    except FloatingPointError:
        return OUT_OF_REACH
    except (CountingError, ArithmeticError):
        return NOT_BRACKETED
    results.omega2[row] = [v.omega2 for v in wanted]
    results.low[row], results.high[row] = np.transpose([v.bracket for v in wanted])
    results.counts[row], results.rounding[row] = [v.counts for v in wanted], rounding
    return 0


def _is_valid(chain: Chain) -> bool:
    """Tell whether lengths, masses and stiffnesses are positive, and all is finite."""
    structure = np.concatenate([chain.length, chain.mass, chain.stiffness])
    positive = np.all((structure > 0) & np.isfinite(structure))
    return bool(positive and np.all(np.isfinite(chain.axial_force)))


def _rounding_by_shapes(solver: Backend, chain: Chain, found: list[Eigenvalue]) -> Array:
    """Return the rounding of omega^2 [rad^2/s^2]: small against the energies that make it."""
    omega2 = np.array([value.omega2 for value in found])
    together = np.array([sum(other.bracket == v.bracket for other in found) for v in found])
    fine = split_for(chain, omega2)
    energies = solver.mode_energies(fine, solver.mode_states(fine, omega2, together), omega2)
    return np.asarray(_ROUNDING * energies.size / energies.mass)
