"""Certified bending frequencies of many beams at once, by the compiled chain.

    result = solve_many(BeamBatch(length, mass_per_length, bending_stiffness, axial_force))
    result.frequencies_hz

Every beam is a chain of uniform segments, exact as it stands; rigid modes are set aside by their
index. Each beam starts from the roots of the one before, so that a sweep is best kept in order.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.ends import FREE, Ends
from antinode.errors import InputError
from antinode.riccati.chain import Chain
from antinode.riccati.laws import BENDING
from antinode.riccati.roots import CountingError, Eigenvalue, check_certificate, find_eigenvalues
from antinode.riccati.shapes import split_for

from .guesses import guess_omega2
from .kernel import kernel as compiled_kernel
from .rigid import rigid_modes_of, translates

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
_NOT_BRACKETED, _NOT_FINITE, _CLUSTERED, _PAST_BUCKLING = 2, 3, 5, 6
_ALONE = _NOT_BRACKETED, _CLUSTERED


@dataclass(frozen=True)
class BeamBatch:
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
        If the shapes do not go together. Values are checked beam by beam when they are solved.
    """

    length: Array
    mass_per_length: Array
    bending_stiffness: Array
    axial_force: Array = field(default_factory=lambda: np.zeros(1))
    ends: Ends = FREE
    modes: int = 6
    _one_structure: bool = field(default=False, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not 1 <= self.modes <= 500:
            raise InputError(f"modes is {self.modes}; allowed are 1 ... 500")
        tables = [np.asarray(getattr(self, name), dtype=float) for name in _ARRAYS]
        rows, n = _common_shape(tables)
        object.__setattr__(self, "_one_structure", all(_rows(v) == 1 for v in tables[:3]))
        for name, values in zip(_ARRAYS, tables, strict=True):
            shape = (_rows(values) if name == "length" else rows, n)
            if values.shape != shape:
                whole = values.size == shape[0] * n
                values = values.reshape(shape) if whole else np.broadcast_to(values, shape)
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


@dataclass(frozen=True)
class BatchResult:
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
        return _hertz(self.omega2)

    @property
    def error_hz(self) -> Array:
        """Half-width of the interval of frequency that holds the beam's own [Hz]."""
        error = np.minimum(self.error_omega2, np.abs(self.omega2))
        return np.asarray(_hertz(self.omega2) - _hertz(self.omega2 - error))

    def why(self, beam: int) -> str:
        """Return why a beam has NaN among its frequencies; empty if it has none."""
        return REASONS[self.reason[beam]]

    def __len__(self) -> int:
        return len(self.omega2)


def _hertz(omega2: Array) -> Array:
    known = np.where(omega2 >= 0, omega2, np.nan)
    return np.asarray(np.sqrt(known) / (2 * np.pi))


def solve_many(batch: BeamBatch) -> BatchResult:
    """Compute the natural frequencies of every beam of a batch, with brackets and counts.

    Parameters
    ----------
    batch : BeamBatch

    Returns
    -------
    BatchResult
        A beam that fails has NaN and a reason; the others are not touched by it.
    """
    kernel = compiled_kernel()
    beams, modes = len(batch), batch.modes
    omega2, low, high, rounding = np.zeros((4, beams, modes))
    counts = np.zeros((beams, modes, 2), dtype=np.int64)
    reason, evaluations = _solve(kernel, batch, (omega2, low, high, counts, rounding))
    if translates(batch.ends):  # past buckling its omega^2 = 0 lies above an elastic mode
        reason[(reason == 0) & (omega2[:, 0] < 0)] = _NOT_BRACKETED
    if not np.isfinite(high).all():
        reason[(reason == 0) & ~np.isfinite(high).all(axis=1)] = _NOT_FINITE
    if reason.any():
        for row in np.flatnonzero(np.isin(reason, _ALONE)):
            reason[row] = _alone(kernel, batch, int(row), (omega2, low, high, rounding), counts)
        failed = reason != 0
        omega2[failed], low[failed], high[failed], counts[failed] = np.nan, np.nan, np.nan, -1
    bracket = np.empty((beams, modes, 2))
    low = np.subtract(low, rounding, out=bracket[..., 0])
    high = np.add(high, rounding, out=bracket[..., 1])
    if (low[:, 1:] <= high[:, :-1]).any():
        _share(low, high, counts)
    reason[omega2[:, 0] < 0] = _PAST_BUCKLING
    error = np.maximum(high - omega2, omega2 - low)
    return BatchResult(omega2, bracket, counts, error, reason, evaluations)


def _solve(
    kernel: Any, batch: BeamBatch, results: tuple[Array, Array, Array, Integers, Array]
) -> tuple[Integers, Integers]:
    """Solve chain after chain; where loads alone vary, by guesses from a few of them."""
    tables = batch.length, batch.mass_per_length, batch.bending_stiffness
    ends = np.array([kernel.ENDS[batch.ends.left], kernel.ENDS[batch.ends.right]])
    below = rigid_modes_of(batch.ends)
    guess = None
    if batch._one_structure:
        guess = guess_omega2(batch.axial_force, lambda N: _exact(batch, N))
    if guess is None:
        return _all_rows(kernel, tables, batch.axial_force, ends, below, results)
    own = tuple(values[0] for values in tables)
    reason, total = kernel.certify_guesses(
        own, batch.axial_force, ends, below, _WIDTH, guess, results
    )
    again = np.flatnonzero(reason)
    if len(again):
        part = tuple(values[again] for values in results)
        rest = (values[:1] if len(values) == 1 else values[again] for values in tables)
        reason[again], more = _all_rows(
            kernel, tuple(rest), batch.axial_force[again], ends, below, part
        )
        total[again] += more
        for values, found in zip(results, part, strict=True):
            values[again] = found
    return reason, total


def _all_rows(
    kernel: Any,
    tables: tuple[Array, ...],
    force: Array,
    ends: Integers,
    below: int,
    results: tuple[Any, ...],
) -> tuple[Integers, Integers]:
    for table in (*tables, force):
        table.flags.writeable = False  # as the kernel was compiled
    reason, total = kernel.solve_chains(*tables, force, ends, below, _WIDTH, results)
    return reason, total


def _exact(batch: BeamBatch, force: Array) -> Array:
    """Return omega^2 of the batch's structure under other forces, NaN where it is not certain."""
    h, m, EI = batch.length[0], batch.mass_per_length[0], batch.bending_stiffness[0]
    some = BeamBatch(h, m, EI, force, batch.ends, batch.modes)
    object.__setattr__(some, "_one_structure", False)
    return solve_many(some).omega2


def _alone(
    kernel: Any, batch: BeamBatch, row: int, results: tuple[Array, ...], counts: Integers
) -> int:
    """Solve a beam by itself; return the reason if it cannot be solved.

    Modes that nearly coincide are parted by frames; past buckling an elastic mode lies below the
    translation, whose omega^2 = 0 is set aside.
    """
    below = rigid_modes_of(batch.ends)
    h = batch.length[row if len(batch.length) > 1 else 0]
    m, EI, N = (getattr(batch, name)[row] for name in _ARRAYS[1:])
    chain = Chain(BENDING, h, BENDING.named(m, EI, N), batch.ends.left, batch.ends.right)
    zeros = below if not np.any(N) else int(translates(batch.ends))
    try:
        found = kernel.find_eigenvalues(chain, below + batch.modes, zeros=zeros, width=_WIDTH)
        if found is None or not check_certificate(found):
            found = find_eigenvalues(chain, below + batch.modes, zeros=zeros, width=_WIDTH)
        if not check_certificate(found):
            return _NOT_BRACKETED
        others = [value for value in found if value.omega2 != 0.0]
        moved = below - (len(found) - len(others))  # the rigid modes that N moves off zero
        wanted = others[moved : moved + batch.modes]
        rounding = _rounding_by_shapes(kernel, chain, wanted)
    except (CountingError, ArithmeticError):
        return _NOT_BRACKETED
    columns = [v.omega2 for v in wanted], *zip(*(v.bracket for v in wanted), strict=True), rounding
    for values, column in zip(results, columns, strict=True):
        values[row] = np.array(column)
    counts[row] = [v.counts for v in wanted]
    return 0


def _rounding_by_shapes(kernel: Any, chain: Chain, found: list[Eigenvalue]) -> Array:
    """Return the rounding of omega^2 [rad^2/s^2]: small against the energies that make it."""
    omega2 = np.array([value.omega2 for value in found])
    together = np.array([sum(other.bracket == v.bracket for other in found) for v in found])
    fine = split_for(chain, omega2)
    energies = kernel.mode_energies(fine, kernel.mode_states(fine, omega2, together), omega2)
    return np.asarray(_ROUNDING * energies.size / energies.mass)


def _share(low: Array, high: Array, counts: Integers) -> None:
    """Let neighbouring modes share a bracket where rounding makes theirs overlap."""
    for row in np.flatnonzero(np.any(low[:, 1:] <= high[:, :-1], axis=1)):
        edges = np.flatnonzero(low[row, 1:] > np.maximum.accumulate(high[row])[:-1]) + 1
        for group in np.split(np.arange(low.shape[1]), edges):
            low[row, group], high[row, group] = low[row, group].min(), high[row, group].max()
            counts[row, group] = counts[row, group, 0].min(), counts[row, group, 1].max()
