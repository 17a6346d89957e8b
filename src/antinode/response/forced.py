"""One family of modes of a beam on one chain, driven: outputs over drives at any frequency.

    H(omega) = output / drive,   time as exp(+i omega t)

`riccati.forced` gives the states; here they become what was asked for. On a beam in which something
varies the chain is an approximation: `refined` halves its steps, by the one error rule.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from antinode.arrays import Array, Numbers
from antinode.beam.attachments import on_beam
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.beam.representation import make_chain
from antinode.errors import ComputationError
from antinode.modes.backends import BackendName, choose
from antinode.modes.refinement import layer_length, varying_segments
from antinode.riccati.convergence import extrapolate
from antinode.riccati.forced import Lanes, Loads, Sides, unit_jump
from antinode.riccati.points import Point

from .damping import Damping
from .quantities import Base, Drive, Output, family_of

_MOST_SEGMENTS = 20_000
_WISHED = 3
_EPS = 1e-14  # of states in their units: what rounding leaves of one that is nothing
NOISE = 1e-12
"""Of the largest response of a unit: what is left where the exact one is nothing."""


class Forced:
    """A beam's chain of one family with its drives and outputs.

    Parameters
    ----------
    beam : Beam
        With a breakpoint at every station.
    family : str
    drives : tuple of Force or Base
    outputs : tuple of Output
    damping : Damping
    refinement : int
        As `Beam.chain` has it.
    backend : {"auto", "numpy", "numba"}
    """

    def __init__(
        self,
        beam: Beam,
        family: FamilyName,
        drives: tuple[Drive, ...],
        outputs: tuple[Output, ...],
        damping: Damping,
        refinement: int = 1,
        backend: BackendName = "auto",
    ) -> None:
        self.chain, self.damping = beam.chain(family, refinement), damping
        self.drives, self.outputs, self.origin = drives, outputs, float(beam.x[0])
        self._nodes: dict[float, int] = {}
        self.columns = make_chain(beam, family, refinement, damping.loss_factor).columns
        nodes = [self.node(output.x) for output in outputs]
        self.places = np.unique(nodes)
        self._found = list(zip(nodes, np.searchsorted(self.places, nodes).tolist(), strict=True))
        self.loads = self._loads(family)
        self.driven = choose(backend).driven(self.chain, self.columns, self.loads, self.places)

    def node(self, x: float) -> int:
        """Return the node at a station [m]."""
        if x not in self._nodes:
            self._nodes[x] = int(np.argmin(np.abs(self.chain.nodes - (x - self.origin))))
        return self._nodes[x]

    def _loads(self, family: FamilyName) -> Loads:
        """Return unit loads, a case for each drive; those of other families do nothing."""
        cases, d = len(self.drives), self.chain.law.size // 2
        at_nodes: dict[int, Array] = {}
        along, ground = np.zeros((len(self.chain.length), cases)), np.zeros(cases)
        for case, drive in enumerate(self.drives):
            if drive.family != family:
                continue
            if isinstance(drive, Base):
                ground[case] = 1.0
            elif drive.to is not None:
                along[self.node(drive.x) : self.node(drive.to), case] = 1.0
            else:
                force = at_nodes.setdefault(self.node(drive.x), np.zeros((d, cases)))
                force[family_of(drive.direction).directions.index(drive.direction), case] = 1.0
        return Loads(at_nodes, along, ground)

    def at(self, omega: Array) -> Numbers:
        """Return outputs over drives, (outputs, drives, k), at frequencies above 0 [rad/s]."""
        lanes, sides = self._sides(omega)
        return self._rated(self._outputs(sides, lanes), omega)

    def at_with_noise(self, omega: Array) -> tuple[Numbers, Array]:
        """Return the same, and what is nothing but rounding beside the states there, (..., k).

        An output that is exactly zero, such as the moment at a hinge, knows nothing smaller.
        """
        lanes, sides = self._sides(omega)
        units = self.chain.law.state_units(self.chain.units(np.abs(lanes.omega2)))
        least = _EPS * self._cancelled(np.abs(lanes.omega2), units)
        noise = np.empty((len(self.outputs), len(self.drives), len(omega)))
        least_size = self._driven_by(units)
        for row, (output, (_, place)) in enumerate(zip(self.outputs, self._found, strict=True)):
            scaled = [np.abs(side[place]) / units[:, :, None] for side in sides]
            size = np.sqrt(np.sum(np.maximum(*scaled) ** 2, axis=1)) + least_size
            component = output.component
            component = component if component >= 0 else len(units[0]) + component
            noise[row] = least * (units[:, component, None] * size).T
        H = self._rated(self._outputs(sides, lanes), omega)
        return H, np.abs(self._rated(noise.astype(complex), omega))

    def _driven_by(self, units: Array) -> Array:
        """Return how large the jumps are that each case's forces make, in units, (k, cases).

        A force on a support moves nothing: what is left there is rounding beside the force.
        """
        law, size = self.chain.law, np.zeros((len(units), len(self.drives)))
        jumps = np.array([unit_jump(law, i) for i in range(law.size // 2)])
        for forces in self.loads.at_nodes.values():
            size += np.sqrt(np.sum((np.abs(jumps.T @ forces) / units[:, :, None]) ** 2, axis=1))
        return size

    def _cancelled(self, omega2: Array, units: Array) -> Array:
        """Return how much larger terms are than what they leave of each other, (k,).

        Beside a heavy mass off its node this turns about its centre. Where end forces follow, a
        slow body is in balance with them, and only its small inertia answers.
        """
        most = np.ones(len(omega2))
        if any(self.chain.following):
            stiffness, mass = self.chain.reference
            most += stiffness / (mass * omega2 * units[:, 0] ** 4)
        for point in self.chain.points:
            if point.mass and point.offset:
                arm = np.maximum(1.0, (point.offset / units[:, 0]) ** 2)
                most += point.mass * omega2 * units[:, 0] / units[:, -1] * arm
            if point.pedestal is not None:
                most += np.abs(point.pedestal.stiffness(omega2)) / point.pedestal.upper
        return most

    def _sides(self, omega: Array) -> tuple[Lanes, Sides]:
        """Return the states at the places of outputs, as they are damped."""
        lanes, softer = self.damping.lanes(omega)
        sides = self.driven.states(lanes)
        if self.damping.rayleigh is None:
            return lanes, sides
        return lanes, Sides(
            *([self._proportioned(z, omega, softer) for z in side] for side in sides)
        )

    def _rated(self, H: Numbers, omega: Array) -> Numbers:
        """Return rates of what is asked for over what is given of the ground."""
        for row, output in enumerate(self.outputs):
            if output.rate:
                H[row] *= (1j * omega) ** output.rate
        for case, drive in enumerate(self.drives):
            if isinstance(drive, Base) and drive.rate:
                H[:, case] /= (1j * omega) ** drive.rate
        return H

    def on(self, lanes: Lanes) -> Numbers:
        """Return components of states, not their rates, over forces and displacements."""
        return self._outputs(self.driven.states(lanes), lanes)

    def _outputs(self, sides: Sides, lanes: Lanes) -> Numbers:
        H = np.empty((len(self.outputs), len(self.drives), len(lanes.omega2)), dtype=complex)
        for row, (output, found) in enumerate(zip(self.outputs, self._found, strict=True)):
            H[row] = self._output(output, *found, sides, lanes).T
        return H

    def _proportioned(self, z: Numbers, omega: Array, softer: Numbers) -> Numbers:
        """Return states with Rayleigh damping, (k, s, cases), from those of `Damping.lanes`.

        Damping by mass acts on motion relative to the ground, as that of modes does.
        """
        rayleigh, d = self.damping.rayleigh, self.chain.law.size // 2
        assert rayleigh is not None
        z = z.copy()
        moving = np.array([isinstance(drive, Base) for drive in self.drives])
        ground, drag = self.loads.ground, 1 / (1 - 1j * rayleigh.alpha / omega)
        z[:, 0] -= ground
        z[:, :d] *= np.where(moving, drag[:, None], softer[:, None])[:, None]
        z[:, d:] *= np.where(moving, (drag / softer)[:, None], 1.0)[:, None]
        z[:, 0] += ground
        return z

    def _output(self, output: Output, node: int, place: int, sides: Sides, lanes: Lanes) -> Numbers:
        """Return an output of every case at a node, which is a place of `sides`, (k, cases)."""
        component = output.component
        if component < 0:
            return self._reaction(-1 - component, node, place, sides, lanes)
        left = node == len(self.chain.length) or (output.side == "left" and node > 0)
        z = (sides.left if left else sides.right)[place][:, component]
        if output.relative and output.moves:
            z = z - self.loads.ground
        return z

    def _reaction(self, freedom: int, node: int, place: int, sides: Sides, lanes: Lanes) -> Numbers:
        """Return what the ground does to the beam along a displacement of a node, (k, cases)."""
        law, last = self.chain.law, len(self.chain.length)
        left, right = sides.left[place], sides.right[place]
        jump = right - left
        point = next((p for p in self.chain.points if p.node == node), Point(node))
        jump = jump - (law.load(point.off_ground, lanes.omega2) - np.eye(law.size)) @ left
        if node in self.loads.at_nodes:
            jumps = np.array([unit_jump(law, i) for i in range(law.size // 2)])
            jump = jump - jumps.T @ self.loads.at_nodes[node]
        jump = jump + (left if node == 0 else 0) - (right if node == last else 0)
        unit = unit_jump(law, freedom)
        force = int(np.flatnonzero(unit)[0])
        return np.asarray(jump[:, force] / unit[force])


def refined(
    beam: Beam,
    family: FamilyName,
    compute: Callable[[int], Array | Numbers],
    first: int,
    tolerance: float,
    units: Sequence[str],
    noise: float = NOISE,
    needed: int | None = None,
) -> tuple[Numbers, Array]:
    """Return numbers of a beam, and how wrong they may be, from chains whose steps are halved.

    Parameters
    ----------
    compute : callable
        Numbers by the refinement of the chain, any shape.
    first : int
        Refinement to start from.
    tolerance : float
        Of the largest number of the last axis.
    units : sequence of str
        Of the first axis: what is nothing but rounding beside others of its unit is let pass.
    noise : float
        How small that is, over the largest of a unit.
    needed : int, optional
        How many of the last axis must meet the tolerance; the others by `_WISHED` levels more, or
        they keep the errors that they have.

    Returns
    -------
    numbers, error : array
        The error is of the representation alone, absolute, number by number; 0 where nothing
        varies.

    Raises
    ------
    ComputationError
        If no chain of reasonable length meets the tolerance.
    """

    def on(levels: dict[FamilyName, int]) -> Array | Numbers:
        return compute(levels[family])

    return refined_all(beam, {family: first}, on, tolerance, units, noise, needed)


def refined_all(
    beam: Beam,
    first: dict[FamilyName, int],
    compute: Callable[[dict[FamilyName, int]], Array | Numbers],
    tolerance: float,
    units: Sequence[str],
    noise: float = NOISE,
    needed: int | None = None,
) -> tuple[Numbers, Array]:
    """Return numbers that several families make together, as `refined` does.

    Parameters
    ----------
    first : dict
        Refinement to start from, by family.
    compute : callable
        Numbers by the refinements.
    """
    refinement = dict(first)
    varying = [family for family in first if np.any(beam.varies(family))]
    if not varying:
        values = np.asarray(compute(refinement))
        return values, np.zeros(values.shape)
    levels: list[Numbers] = []
    wished = 0
    while True:
        chains = [beam.chain(family, refinement[family]) for family in varying]
        levels.append(np.asarray(compute(refinement)))
        if len(levels) > 2:
            layer = max(layer_length(c, varying_segments(beam, c)) for c in chains)
            better, error = _judged(levels[-4:], layer)
            if _met(better[..., :needed], error[..., :needed], tolerance, units, noise):
                long = max(len(chain.length) for chain in chains) > _MOST_SEGMENTS // 10
                whole = needed is None or _met(better, error, tolerance, units, noise)
                if whole or long or wished == _WISHED:
                    return better, error
                wished += 1
        longest = max(len(chain.length) for chain in chains)
        if 2 * longest > _MOST_SEGMENTS:
            raise ComputationError(
                f"{longest} segments do not reach the tolerance {tolerance:g} of the response; "
                "give a larger tolerance, a lower frequency, or more damping"
            )
        refinement = {f: r * (2 if f in varying else 1) for f, r in refinement.items()}


def _met(
    values: Numbers, error: Array, tolerance: float, units: Sequence[str], noise: float
) -> bool:
    """Tell whether errors are small beside the largest of the last axis."""
    size = np.max(np.abs(values), axis=-1)
    most = np.max(error, axis=-1)
    return bool(np.all(most <= tolerance * size + noise * largest_of_unit(size, units)))


def largest_of_unit(size: Array, units: Sequence[str]) -> Array:
    """Return, for each number, the largest among those of the same unit, along the first axis."""
    largest, names = np.array(size), np.array(units)
    for unit in set(units):
        rows = names == unit
        largest[rows] = np.max(size[rows], axis=0)
    return largest


def judged(beam: Beam, chains: list[Forced], omega: Array) -> tuple[Numbers, Array]:
    """Return the responses of ever finer chains, extrapolated, and the error of each number."""
    values = [forced.at(omega) for forced in chains]
    if len(values) == 1:
        return values[0], np.zeros(values[0].shape)
    finest = chains[-1].chain
    return _judged(values, layer_length(finest, varying_segments(beam, finest)))


def _judged(levels: list[Numbers], layer: float) -> tuple[Numbers, Array]:
    """Extrapolate by `riccati.convergence`, number by number."""
    shape = levels[-1].shape
    rows = np.array([level.reshape(-1, shape[-1]) for level in levels])
    better = np.empty(rows.shape[1:], dtype=rows.dtype)
    error = np.empty(better.shape)
    for k in range(len(better)):
        extrapolate(rows[:, k], len(rows) - 1, 1e-13, layer, better[k], error[k])
    return better.reshape(shape), error.reshape(shape)


def with_stations(beam: Beam, places: list[float]) -> Beam:
    """Return a beam with breakpoints at stations [m]."""
    known = set(beam.x.tolist())
    new = [on_beam(x, beam.x) for x in places if x not in known]
    return beam.with_breakpoints(new) if new else beam
