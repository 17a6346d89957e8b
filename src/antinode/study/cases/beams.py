"""The beams of some cases: on arrays where what varies allows it, else one by one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.limits import check_limits
from antinode.beam.plausible import MOST_STRAIN, largest_strain
from antinode.errors import AntinodeError
from antinode.riccati.chain import Chain
from antinode.study.design.file import LOAD_OUTPUTS
from antinode.vehicle.case import Case, vehicle_beam
from antinode.vehicle.many_beams import Chains, ManyBeams
from antinode.vehicle.many_loads import ManyLoads, loads_of_many
from antinode.vehicle.numbers import Numbers, is_vectorised
from antinode.vehicle.refusals import OUT_OF_RANGE

from .reasons import BEYOND_LIMITS, NO_BEAM
from .values import Cases

_OTHER = "a warning of its own: 'antinode loads' of that case alone says it"


@dataclass(frozen=True)
class CaseBeams:
    """The beams of some cases.

    Attributes
    ----------
    reason : array of int, shape (cases,)
        0, or why a case has no beam.
    scalars : dict
        Loads by the names of `LOAD_OUTPUTS`, shape (cases,).
    doubts : array of bool, shape (warnings, cases)
        Which cases each of the `load_messages` concerns.
    strained : array of bool, shape (cases,)
        Where the axial force strains the body by more than any material bears.
    exact : bool
        Whether nothing varies inside the segments of any chain.
    chains : callable
        Returns the bending chains of some cases at a refinement, those of equal size together.
    built : mapping
        Cases and their beams, where each was built by itself.
    """

    reason: Integers
    scalars: Mapping[str, Array]
    doubts: npt.NDArray[np.bool_]
    strained: npt.NDArray[np.bool_]
    exact: bool
    chains: Callable[[Integers, int], list[Chains]] = field(repr=False)
    built: Mapping[int, tuple[Case, Beam]] = field(default_factory=dict, repr=False)


def beams_of(cases: Cases) -> CaseBeams:
    """Return the beams of some cases."""
    reason = np.where(cases.outside(), OUT_OF_RANGE, 0)
    arrays = all(v.kind == "time" or is_vectorised(v.keys) for v in cases.variables)
    arrays = arrays and not cases.study.vehicle_case.model.water_answers
    if arrays:
        return beams_on_arrays(cases.study.vehicle_case, cases.numbers, reason)
    return _one_by_one(cases, reason)


def beams_on_arrays(case: Case, numbers: Numbers, reason: Integers) -> CaseBeams:
    """Return the beams of cases that differ from one in numbers for which `is_vectorised` holds.

    Parameters
    ----------
    case : Case
    numbers : mapping
        By keys, each (cases,) or (cases, rows).
    reason : array of int, shape (cases,)
        What speaks against a case already; else 0.
    """
    loads = loads_of_many(case.many(numbers, len(reason)))
    beams = ManyBeams(loads)
    reason = np.where(reason == 0, loads.refusals.code, reason)
    with np.errstate(all="ignore"):
        far = beams.beyond_limits()
        soft = beams.beyond_shear()
        strained = beams.strained(MOST_STRAIN)
    reason = np.where(far & (reason == 0), BEYOND_LIMITS, reason)
    reason = np.where(soft & (reason == 0), NO_BEAM, reason)
    doubts = _doubts(loads)
    return CaseBeams(reason, loads.numbers, doubts, strained, beams.exact, beams.chains)


def load_messages(case: Case) -> tuple[str, ...]:
    """Return what the loads of cases that differ from one in numbers can warn of."""
    return (*(warning.message for warning in case.many_loads.warnings), _OTHER)


def _doubts(loads: ManyLoads) -> npt.NDArray[np.bool_]:
    """Return which cases each message concerns; none on arrays has one of its own."""
    known = [warning.concerns for warning in loads.warnings]
    return np.array([*known, np.zeros(loads.cases.cases, dtype=bool)])


def _one_by_one(cases: Cases, reason: Integers) -> CaseBeams:
    """Build every case by itself."""
    built: dict[int, tuple[Case, Beam]] = {}
    scalars = {name: np.full(len(cases), np.nan) for name in LOAD_OUTPUTS}
    messages = load_messages(cases.study.vehicle_case)
    doubts = np.zeros((len(messages), len(cases)), dtype=bool)
    strained = np.zeros(len(cases), dtype=bool)
    for i in np.flatnonzero(reason == 0).tolist():
        try:
            case = cases.case(i)
            many = case.many_loads
            reason[i] = many.refusals.code[0]
            beam = vehicle_beam(case)
            check_limits(beam)
        except AntinodeError:
            reason[i] = reason[i] or NO_BEAM
            continue
        built[i] = case, beam
        told = {warning.message for warning in many.warnings if warning.concerns[0]}
        doubts[:, i] = [message in told for message in messages]
        doubts[-1, i] = not told <= set(messages)
        strained[i] = largest_strain(beam)[0] > MOST_STRAIN
        for name in LOAD_OUTPUTS:
            scalars[name][i] = many.numbers[name][0]
    beams = {i: beam for i, (_, beam) in built.items()}
    exact = not any(np.any(b.varies(BENDING)) for b in beams.values())
    chains = partial(_chains_of, beams)
    return CaseBeams(reason, scalars, doubts, strained, exact, chains, built)


def _chains_of(beams: Mapping[int, Beam], rows: Integers, refinement: int) -> list[Chains]:
    chains = {i: beams[i].chain(BENDING, refinement) for i in rows.tolist()}
    found = []
    for size in sorted({len(chain.length) for chain in chains.values()}):
        own = {i: chain for i, chain in chains.items() if len(chain.length) == size}
        table = [
            np.stack([getattr(chain, name) for chain in own.values()])
            for name in ("length", "mass", "stiffness", "axial_force")
        ]
        length, m, EI, N = table
        more = _more(list(own.values()))
        ends = np.array([chain.following for chain in own.values()])
        following = ends if ends.any() else None
        found.append(Chains(np.array(list(own)), length, m, EI, N, more, following))
    return found


def _more(chains: Sequence[Chain]) -> dict[str, Array]:
    """Return the columns of chains besides those of their law, one row a chain."""
    names = [name for name in chains[0].columns if name not in chains[0].law.columns]
    return {name: np.stack([chain.columns[name] for chain in chains]) for name in names}
