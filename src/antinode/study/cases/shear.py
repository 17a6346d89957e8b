"""What shear and rotary inertia would do to the bending frequencies of the cases of a chunk.

The estimate of `modes/shapes.py` asks for three integrals of each mode. Shapes cost more than
frequencies: they are computed for 16 cases, spread evenly over the mean of N/EI, and give weights
for every interval of the stations. Between these cases the weights are interpolated; EI, EA, r and
the mass are those of the case itself.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.errors import AntinodeError
from antinode.modes.backends import choose
from antinode.modes.following import energies_of_modes
from antinode.modes.shapes import ModelErrorParts, model_error_parts
from antinode.riccati.chain import Chain
from antinode.vehicle.case import body_as_beam

from .beams import CaseBeams
from .bending import Eigenvalues, chain_of
from .reasons import failed
from .values import Cases

_SAMPLE = 16
_ENTRIES = 1_000_000  # of the weights that are held at once


def model_errors(cases: Cases, beams: CaseBeams, family: FamilyName, found: Eigenvalues) -> Array:
    """Return the estimated effect on every frequency of a family, relative, (cases, modes).

    NaN where a mode diverges, in families and cases that have none, and where the law has them.
    """
    effect = np.full(found.omega2.shape, np.nan)
    rows = np.flatnonzero(~failed(found.reason))
    left_out = cases.study.vehicle_case.model.theory == "euler_bernoulli"
    if FAMILIES[family].rotary and left_out and len(rows):
        with np.errstate(all="ignore"):
            _estimate(_Bodies(cases, np.asarray(beams.scalars["mass"])), beams, found, rows, effect)
    return effect


def _estimate(
    bodies: _Bodies, beams: CaseBeams, found: Eigenvalues, rows: Integers, effect: Array
) -> None:
    """Set the effect in some cases, a part of them at a time."""
    load = found.net_force / bodies.column("bending_stiffness").mean(axis=1)
    sample = _spread(rows, load)
    weights = _weights(bodies, beams, sample, found.omega2)
    wanted = max(1, _ENTRIES // weights[0, 0].size)
    for some in np.array_split(rows, -(-len(rows) // wanted)):
        own = _sums(load[sample], weights, load[some], bodies.factors(some))
        effect[some] = ModelErrorParts(*own).effect(found.omega2[some])


def _spread(rows: Integers, load: Array) -> Integers:
    """Return cases at even ranks of their loads, both ends included, in the order of these."""
    order = np.asarray(rows[np.argsort(load[rows], kind="stable")])
    if len(order) <= _SAMPLE:
        return order
    return np.asarray(order[np.linspace(0, len(order) - 1, _SAMPLE).round().astype(int)])


def _sums(at: Array, weights: Array, load: Array, factors: Array) -> Array:
    """Return the sums of weights times factors over the intervals, shape (3, cases, modes).

    Parameters
    ----------
    at : array, shape (sample,)
        Loads of the sample, which ascend.
    weights : array, shape (3, sample, modes, intervals)
        What is interpolated over the loads.
    load : array, shape (cases,)
    factors : array, shape (3, cases, 1, intervals)
    """
    known = np.flatnonzero(np.isfinite(weights).all(axis=(0, 2, 3)))
    found = np.full((3, len(load), weights.shape[2]), np.nan)
    if not len(known):
        return found
    place = np.interp(load, at[known], np.arange(len(known)))
    low = np.minimum(place.astype(int), max(len(known) - 2, 0))
    for k in np.unique(low).tolist():
        rows, own = np.flatnonzero(low == k), factors[:, low == k, 0]
        part = (place[rows] - k)[:, None]
        near, far = (
            own @ weights[:, known[j]].swapaxes(1, 2) for j in (k, min(k + 1, len(known) - 1))
        )
        found[:, rows] = (1 - part) * near + part * far
    return found


@dataclass(frozen=True)
class _Bodies:
    """What R, S and K go with, of all cases: one value for each interval of the stations.

    Attributes
    ----------
    cases : Cases
    mass : array, shape (cases,)
        Of the whole body [kg].
    """

    cases: Cases
    mass: Array

    @property
    def x(self) -> Array:
        """The stations [m]."""
        return self.cases.study.vehicle_case.vehicle.stations.x

    def column(self, name: str) -> Array:
        """Return the means of a column over the intervals, shape (cases, intervals)."""
        vehicle = self.cases.study.vehicle_case.vehicle
        whole = self.cases.numbers.get(("vehicle", "stations", name))
        if whole is None:
            own = getattr(vehicle.stations, name)
            whole = np.broadcast_to(own, (len(self.cases), len(own)))
        stepped = vehicle.interpolation == "step"
        return np.asarray(whole[:, :-1] if stepped else (whole[:, :-1] + whole[:, 1:]) / 2)

    def factors(self, rows: Integers) -> Array:
        """Return what the weights of some cases are multiplied by, (3, rows, 1, intervals)."""
        EI, EA = (self.column(name)[rows] for name in ("bending_stiffness", "axial_stiffness"))
        stations = self.cases.study.vehicle_case.vehicle.stations
        given = stations.radius_of_gyration is not None or stations.wall is not None
        rotary = np.ones(EI.shape) if given else EI / EA
        mass = self.mass[rows, None]
        return np.stack([rotary, EI**2 / EA / mass, EI / mass])[:, :, None]

    def beams(self, rows: Integers) -> dict[bytes, Beam | None]:
        """Return the bodies of some cases as beams without loads, by their structures.

        None where a body cannot be one.
        """
        one_of = {self.cases.structure(row): row for row in rows.tolist()}
        return {structure: self._beam(row) for structure, row in one_of.items()}

    def _beam(self, row: int) -> Beam | None:
        case = self.cases.case(row)
        burnt = case.condition.burn_fraction
        try:
            return body_as_beam(case.vehicle, case.vehicle.mass_distribution(burnt).x, burnt)
        except AntinodeError:
            return None


def _weights(bodies: _Bodies, beams: CaseBeams, sample: Integers, omega2: Array) -> Array:
    """Return R, S and K of some cases over their factors, (3, sample, modes, intervals).

    NaN where the shapes fail.
    """
    found = np.full((3, len(sample), omega2.shape[1], len(bodies.x) - 1), np.nan)
    place = {row: at for at, row in enumerate(sample.tolist())}
    bare = bodies.beams(sample)
    for chains in beams.chains(sample, 1):
        for k, row in enumerate(chains.rows.tolist()):
            body = bare[bodies.cases.structure(row)]
            if body is not None:
                found[:, place[row]] = _parts(body, chain_of(chains, k), omega2[row], bodies.x)
    return found / bodies.factors(sample)


def _parts(body: Beam, chain: Chain, omega2: Array, stations: Array) -> Array:
    """Return R, S and K of one case by interval of the stations, shape (3, modes, intervals)."""
    compiled = choose("numba")
    try:
        states = compiled.mode_states(chain, omega2, np.ones(len(omega2), dtype=np.int64))
        energies = energies_of_modes(compiled, chain, states, omega2)
        parts = model_error_parts(body, chain, energies)
    except (ArithmeticError, ValueError):
        return np.full((3, len(omega2), len(stations) - 1), np.nan)
    middle = (chain.nodes[1:] + chain.nodes[:-1]) / 2
    first = np.searchsorted(middle, stations[:-1])
    return np.stack([np.add.reduceat(part, first, axis=0).T for part in parts])
