"""One chunk of a study: from the values of its inputs to the numbers that are kept.

A chunk is computed by itself, from nothing but the study and its number: warm starts do not cross
its bounds. So every executor gets the same numbers.

The error by what varies inside segments is estimated on every 32nd case of a chunk, from the change
when each step is halved; the chunk is refined until it is within the tolerance.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from pydantic import ValidationError

from antinode.arrays import Array, Integers
from antinode.beam.families import BENDING, FAMILIES, LONGITUDINAL, FamilyName
from antinode.beam.limits import check_limits
from antinode.errors import AntinodeError
from antinode.modes.batch import REASONS, BeamBatch, solve_many
from antinode.riccati.chain import Chain
from antinode.riccati.roots import CountingError, find_eigenvalues
from antinode.vehicle.case import Case
from antinode.vehicle.columns import column_values
from antinode.vehicle.derivatives import Modes
from antinode.vehicle.many_beams import Chains, ManyBeams
from antinode.vehicle.many_loads import (
    CAVITATION,
    EXTRA_DRAG,
    FINS,
    NOT_FINITE,
    OUT_OF_RANGE,
    compute_many_loads,
    is_vectorised,
)
from antinode.vehicle.paths import Keys, replaced, value_at

from .design import Points, Variable
from .file import LOAD_OUTPUTS, Study

PAST_BUCKLING, BEYOND_LIMITS, NO_BEAM = 6, 15, 16
WHY: dict[int, str] = {
    **dict(enumerate(REASONS)),
    0: "solved",
    OUT_OF_RANGE: "an input is outside the range that the case allows",
    CAVITATION: "speed, depth and pressures give no cavitation number between 0 and 1, "
    "or contradict each other",
    FINS: "a fin set is off the body, or its tips are inside it",
    EXTRA_DRAG: "the extra drag acts off the body",
    NOT_FINITE: "the loads are too large or too small for numbers",
    BEYOND_LIMITS: "the axial force is out of all proportion to the bending stiffness",
    NO_BEAM: "the case has no loads or no beam",
}
"""What the reason codes mean; past buckling is an answer, all others but 0 are failures."""
_SAMPLE = 32
_SAFETY = 2.5
_LAW = FAMILIES[BENDING].law
_NEAR_BUCKLING = 1e-7  # share of the highest omega^2 below which the first may be a rigid one
_FINEST = 32


def failed(reason: Integers) -> npt.NDArray[np.bool_]:
    """Tell which cases have no answer."""
    return np.asarray((reason != 0) & (reason != PAST_BUCKLING))


def mode_names(study: Study) -> list[str]:
    """Return the names of the modes, family by family."""
    return [f"{f} {k}" for f in study.solve.families for k in range(1, study.solve.modes + 1)]


def compute_chunk(points: Points, chunk: int) -> dict[str, npt.NDArray[Any]]:
    """Compute a chunk: arrays over its cases, by the names of the variables of the result."""
    study, values = points.study, points.values(chunk)
    work = Work(study, points.variables, values, points.tracked)
    solved = work.solve()
    out: dict[str, npt.NDArray[Any]] = {
        v.name: values[:, k] for k, v in enumerate(points.variables)
    }
    out["reason"] = solved.reason.astype(np.int16)
    omega2 = solved.omega2
    hz = _hertz(omega2)
    error = np.minimum(solved.error, np.abs(omega2))
    every = {
        "omega2": omega2,
        "frequency_hz": hz,
        "error_hz": hz - _hertz(omega2 - error),
        "growth_rate_per_s": np.sqrt(np.where(omega2 < 0, -omega2, np.nan)),
        **solved.scalars,
    }
    out.update({name: every[name] for name in study.outputs})
    if points.tracked:
        out["shape"] = solved.shapes
    return out


def _hertz(omega2: Array) -> Array:
    return np.asarray(np.sqrt(np.where(omega2 >= 0, omega2, np.nan)) / (2 * np.pi))


@dataclass
class _Solved:
    """What is known of the cases of a chunk; NaN where nothing is."""

    omega2: Array
    error: Array
    reason: Integers
    scalars: dict[str, Array]
    shapes: Array


@dataclass(frozen=True)
class Work:
    """Some cases of a study: the values of its variables, and what follows from them."""

    study: Study
    variables: Sequence[Variable]
    values: Array
    tracked: bool
    _beams: dict[str, Any] = field(default_factory=dict)

    @property
    def cases(self) -> int:
        """Number of cases."""
        return len(self.values)

    @cached_property
    def numbers(self) -> dict[Keys, Array]:
        """What varies, by keys: arrays over cases, columns with a second dimension."""
        case, found = self.study.case, {}
        logarithms: dict[Keys, Array] = {}
        for k, v in enumerate(self.variables):
            given = self.values[:, k]
            if v.kind == "time":
                continue
            if v.kind == "column":
                assert v.weights is not None
                with np.errstate(all="ignore"):
                    share = np.log(given)[:, None] * v.weights
                logarithms[v.keys] = logarithms.get(v.keys, 0.0) + share
            else:
                start = value_at(case, v.keys)
                found[v.keys] = given * start if v.given.factor and start is not None else given
        for keys, share in logarithms.items():
            own = column_values(case.vehicle.stations, keys[2:])
            found[keys] = own * np.exp(share)
        return self._with_rows_of_columns(found)

    def _with_rows_of_columns(self, found: dict[Keys, Array]) -> dict[Keys, Array]:
        """Gather single rows of columns into the columns."""
        rows = {k: v for k, v in found.items() if k[:2] == ("vehicle", "stations") and v.ndim == 1}
        kept = {k: v for k, v in found.items() if k not in rows}
        for keys, values in rows.items():
            column = keys[:-1]
            own = column_values(self.study.case.vehicle.stations, column[2:])
            whole = kept.get(column, np.broadcast_to(own, (self.cases, len(own)))).copy()
            whole[:, int(keys[-1])] = values
            kept[column] = whole
        return kept

    def solve(self) -> _Solved:
        """Compute frequencies, loads and shapes of all cases."""
        out = _empty(self.study, self.cases, tracked=self.tracked)
        out.reason[self.outside()] = OUT_OF_RANGE
        fast = all(v.kind == "time" or is_vectorised(v.keys) for v in self.variables)
        make = self._vectorised(out) if fast else self._one_by_one(out)
        self._bending(out, make)
        if LONGITUDINAL in self.study.solve.families:
            self._longitudinal(out)
        bad = failed(out.reason)
        out.omega2[bad], out.error[bad] = np.nan, np.nan
        for values in out.scalars.values():
            values[out.reason >= OUT_OF_RANGE] = np.nan
        return out

    def outside(self) -> npt.NDArray[np.bool_]:
        """Tell in which cases an input is outside its range."""
        wrong = np.zeros(self.cases, dtype=bool)
        for k, v in enumerate(self.variables):
            if v.kind == "column":
                wrong |= ~(self.values[:, k] > 0)
            elif v.kind == "number":
                given = self.numbers.get(v.keys, self.values[:, k])
                if given.ndim == 1:
                    wrong |= outside_range(self.study.case, v.keys, given)
        return wrong

    # --- the two ways to chains ---

    def _vectorised(self, out: _Solved) -> Callable[[Integers, int], list[Chains]]:
        case = self.study.case
        loads = compute_many_loads(case, self.numbers, self.cases)
        beams = ManyBeams(case, self.numbers, loads)
        first = out.reason == 0
        out.reason[first] = loads.code[first]
        with np.errstate(all="ignore"):
            far = beams.beyond_limits()
        out.reason[far & (out.reason == 0)] = BEYOND_LIMITS
        out.scalars = {k: v.copy() for k, v in loads.scalars.items()}
        self._beams["exact"] = beams.exact
        return beams.chains

    def _one_by_one(self, out: _Solved) -> Callable[[Integers, int], list[Chains]]:
        """Build every case by itself."""
        beams: dict[int, Any] = {}
        out.scalars = {name: np.full(self.cases, np.nan) for name in LOAD_OUTPUTS}
        for i in np.flatnonzero(out.reason == 0).tolist():
            try:
                case = case_of(self.study.case, self.numbers, i)
                beam = case.beam()
                check_limits(beam)
            except AntinodeError:
                out.reason[i] = NO_BEAM
                continue
            beams[i] = beam
            for name in LOAD_OUTPUTS:
                out.scalars[name][i] = _scalar(case, name)

        def make(rows: Integers, refinement: int) -> list[Chains]:
            chains = {i: beams[i].chain(BENDING, refinement) for i in rows.tolist()}
            sizes = {i: len(c.length) for i, c in chains.items()}
            found = []
            for n in sorted(set(sizes.values())):
                own = [i for i in rows.tolist() if sizes[i] == n]
                table = [
                    np.stack([getattr(chains[i], name) for i in own])
                    for name in ("length", "mass", "stiffness", "axial_force")
                ]
                found.append(Chains(np.array(own), *table))
            return found

        self._beams["exact"] = not any(np.any(b.varies(BENDING)) for b in beams.values())
        return make

    # --- solving ---

    def _bending(self, out: _Solved, make: Callable[[Integers, int], list[Chains]]) -> None:
        """Solve the chains, refined until the error on a sample is within the tolerance."""
        if BENDING not in self.study.solve.families:
            return
        columns = self._columns(BENDING)
        rows = np.flatnonzero(out.reason == 0)
        if not len(rows):
            return
        refinement, share = 1, np.zeros(self.study.solve.modes)
        weight = self._weight(out, rows)
        if not self._beams["exact"]:
            refinement, share = self._refine(make, rows, weight)
        for chains in make(rows, refinement):
            omega2, error, reason = solve_chains(chains, self.study.solve.modes)
            at = chains.rows
            out.omega2[at, columns] = omega2
            out.error[at, columns] = error + np.abs(omega2) * share * weight[at, None]
            out.reason[at] = reason
            if out.shapes.size:
                out.shapes[at, columns] = self._shapes(chains, omega2, reason)

    def _weight(self, out: _Solved, rows: Integers) -> Array:
        """Return what the error of a chain goes with: the slope of N, where only N varies."""
        weight = np.ones(self.cases)
        if self.study.case.vehicle.interpolation == "step" and not self.study.case.vehicle.masses:
            size = np.abs(out.scalars["a_X"])
            largest = np.max(size[rows])
            weight = np.maximum(size, 0.05 * largest) if largest > 0 else weight
        return np.nan_to_num(weight, nan=1.0)

    def _refine(
        self,
        make: Callable[[Integers, int], list[Chains]],
        rows: Integers,
        weight: Array,
    ) -> tuple[int, Array]:
        """Return the refinement, and the estimated relative error of every omega^2, by weight."""
        sample, modes = rows[:: max(1, min(_SAMPLE, len(rows) // 8))], self.study.solve.modes
        share, refinement = np.zeros(modes), 1
        coarse = _solved_rows(make(sample, 1), modes)
        while True:
            fine = _solved_rows(make(sample, 2 * refinement), modes)
            with np.errstate(all="ignore"):
                change = np.abs(fine - coarse) / np.maximum(np.abs(fine), 1e-3 * fine[:, -1:])
                change = np.nan_to_num(change) / weight[sample, None]
            share = change.max(axis=0) * _SAFETY * 16 / 15
            share = np.maximum(share, share.max() / 4)
            error = share.max() * weight[rows].max() / 2
            if error <= self.study.solve.tolerance or 2 * refinement > _FINEST:
                return refinement, share
            refinement, coarse = 2 * refinement, fine

    def _columns(self, family: FamilyName) -> slice:
        n = self.study.solve.modes
        k = self.study.solve.families.index(family)
        return slice(k * n, (k + 1) * n)

    def _shapes(self, chains: Chains, omega2: Array, reason: Integers) -> Array:
        """Return the shapes at even points, of unit norm; NaN where there are none."""
        x = np.linspace(0, self.study.case.vehicle.length, self.study.tracking.points)
        found = np.full((*omega2.shape, len(x)), np.nan)
        for i in np.flatnonzero(~failed(reason)).tolist():
            j = i if len(chains.length) > 1 else 0
            columns = _LAW.named(chains.mass[i], chains.stiffness[i], chains.axial_force[i])
            chain = Chain(_LAW, chains.length[j], columns)
            found[i] = _unit(Modes(chain, omega2[i]).displacement(x))
        return found

    def _longitudinal(self, out: _Solved) -> None:
        """Solve the longitudinal modes, once for every different pair of mass and stiffness."""
        columns, modes = self._columns(LONGITUDINAL), self.study.solve.modes
        known: dict[bytes, tuple[Array, Array, Array]] = {}
        varies = [k for k in self.numbers if k[:2] == ("vehicle", "stations")]
        varies += [k for k in self.numbers if k == ("condition", "burn_fraction")]
        x = np.linspace(0, self.study.case.vehicle.length, self.study.tracking.points)
        for i in np.flatnonzero(~failed(out.reason)).tolist():
            key = b"".join(np.ascontiguousarray(self.numbers[k][i]).tobytes() for k in varies)
            if key not in known:
                known[key] = self._longitudinal_of(i, modes, x)
            out.omega2[i, columns], out.error[i, columns], shapes = known[key]
            if out.shapes.size:
                out.shapes[i, columns] = shapes

    def _longitudinal_of(self, i: int, modes: int, x: Array) -> tuple[Array, Array, Array]:
        from antinode.modes.solve import solve_modes

        beam = case_of(self.study.case, self.numbers, i).beam()
        result = solve_modes(
            beam, modes, tolerance=self.study.solve.tolerance, families=[LONGITUDINAL]
        )
        found = [m for m in result.modes if m.number][:modes]
        shapes = result.at(x, LONGITUDINAL)[:, [bool(m.number) for m in result.modes], 0]
        omega2, error = (
            np.array([getattr(m, k) for m in found]) for k in ("omega2", "error_omega2")
        )
        return omega2, error, _unit(shapes[:, :modes])


def _empty(study: Study, cases: int, *, tracked: bool) -> _Solved:
    modes = study.solve.modes * len(study.solve.families)
    points = study.tracking.points if tracked else 0
    return _Solved(
        omega2=np.full((cases, modes), np.nan),
        error=np.full((cases, modes), np.nan),
        reason=np.zeros(cases, dtype=np.int64),
        scalars={},
        shapes=np.full((cases, modes, points), np.nan),
    )


def _unit(displacement: Array) -> Array:
    """Return shapes (points, modes) as rows of unit norm, the largest displacement positive."""
    y = displacement.T
    largest = np.take_along_axis(y, np.argmax(np.abs(y), axis=1)[:, None], axis=1)
    return np.asarray(y * np.sign(largest) / np.linalg.norm(y, axis=1)[:, None])


def _scalar(case: Case, name: str) -> float:
    loads = case.loads
    if name == "cavity_length":
        return loads.cavity.L_c
    return loads.cavity.D_c if name == "cavity_diameter" else float(getattr(loads, name))


def _solved_rows(groups: list[Chains], modes: int) -> Array:
    """Return omega^2 of all chains, in the order of their cases."""
    rows = np.concatenate([g.rows for g in groups])
    omega2 = np.concatenate([solve_chains(g, modes)[0] for g in groups])
    return np.asarray(omega2[np.argsort(rows)])


def solve_chains(chains: Chains, modes: int) -> tuple[Array, Array, Integers]:
    """Return omega^2, its error and the reason for every chain; by frames where lanes fail."""
    batch = BeamBatch(chains.length, chains.mass, chains.stiffness, chains.axial_force, modes=modes)
    result = solve_many(batch)
    omega2, error, reason = result.omega2, result.error_omega2, result.reason
    buckled = ~(omega2[:, 0] > _NEAR_BUCKLING * omega2[:, -1])
    for i in np.flatnonzero(failed(reason) | buckled).tolist():
        j = i if len(batch.length) > 1 else 0
        m, EI, N = (
            getattr(batch, k)[i] for k in ("mass_per_length", "bending_stiffness", "axial_force")
        )
        found = _by_frames(Chain(_LAW, batch.length[j], _LAW.named(m, EI, N)), modes)
        if found is not None:
            omega2[i], error[i] = found
            reason[i] = PAST_BUCKLING if omega2[i, 0] < 0 else 0
    return omega2, error, reason


def _by_frames(chain: Chain, modes: int) -> tuple[Array, Array] | None:
    """Return omega^2 of the elastic modes of a free chain, and its error.

    Translation is the eigenvalue that is zero, wherever it stands: past buckling elastic modes come
    before it. The lowest one beside it is the rotation.
    """
    zeros = 1 if np.any(chain.axial_force) else 2
    try:
        found = find_eigenvalues(chain, modes + 2, zeros=zeros)
    except (CountingError, FloatingPointError, ValueError):
        return None
    rest = [e for e in found if e.omega2 != 0.0][2 - zeros :][:modes]
    if len(rest) < modes:
        return None
    omega2 = np.array([e.omega2 for e in rest])
    return omega2, np.array([e.bracket[1] - e.bracket[0] for e in rest])


def case_of(case: Case, numbers: dict[Keys, Array], i: int) -> Case:
    """Return one case with its own numbers, unchecked."""
    for keys, values in numbers.items():
        value = values[i]
        case = replaced(case, keys, float(value) if np.ndim(value) == 0 else np.asarray(value))
    return case


def outside_range(case: Case, keys: Keys, values: Array) -> npt.NDArray[np.bool_]:
    """Tell which values the case does not allow at a place; what is allowed is an interval."""

    def allowed(value: float) -> bool:
        return _is_allowed(case, keys, value)

    finite = np.isfinite(values)
    known = np.unique(values[finite])
    if not len(known):
        return ~finite
    if allowed(float(known[0])) and allowed(float(known[-1])):
        return ~finite
    inside = [k for k in _probes(len(known)) if allowed(float(known[k]))][:1]
    if not inside:
        return np.ones(len(values), dtype=bool)
    low = _last(lambda k: allowed(float(known[k])), inside[0], 0)
    high = _last(lambda k: allowed(float(known[k])), inside[0], len(known) - 1)
    return np.asarray(~finite | (values < known[low]) | (values > known[high]))


def _probes(n: int) -> list[int]:
    """Return indices, coarse ones first, then all."""
    return list(dict.fromkeys([*range(0, n, max(1, n // 16)), *range(n)]))


def _last(test: Callable[[int], bool], good: int, end: int) -> int:
    """Return the last index from `good` towards `end` that passes a test that fails but once."""
    if test(end):
        return end
    bad = end
    while abs(bad - good) > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if test(middle) else (good, middle)
    return good


def _is_allowed(case: Case, keys: Keys, value: float) -> bool:
    if keys[:2] == ("vehicle", "stations"):
        return value > 0
    model: Any = case
    for key in keys[:-1]:
        model = model[int(key)] if isinstance(model, tuple) else getattr(model, str(key))
    if isinstance(model, tuple):
        return _is_allowed_in_list(case, keys, value)
    fields = {name: getattr(model, name) for name in type(model).model_fields}
    try:
        type(model).model_validate({**fields, str(keys[-1]): value})
    except ValidationError:
        return False
    return True


def _is_allowed_in_list(case: Case, keys: Keys, value: float) -> bool:
    """Tell the same of a number in a list, such as a roll angle."""
    owner: Any = case
    for key in keys[:-2]:
        owner = owner[int(key)] if isinstance(owner, tuple) else getattr(owner, str(key))
    changed = list(getattr(owner, str(keys[-2])))
    changed[int(keys[-1])] = value
    fields = {name: getattr(owner, name) for name in type(owner).model_fields}
    try:
        type(owner).model_validate({**fields, str(keys[-2]): changed})
    except ValidationError:
        return False
    return True
