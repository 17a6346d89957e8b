"""Modes as a basis of responses: what they weigh, lose, and show of forces and outputs.

With modal coordinates q of unit-mass modes and the motion of the ground u_g,

    q'' + C q' + omega_n^2 q = b f,   y = c q + (static rest) f,   C = 2 zeta_n omega_n

In relative motion the ground drives by inertia: ``b = -int m phi``. Dashpots couple the modes:
``C_jk += sum c phi_j phi_k``. A loss factor eta becomes, mode by mode, the viscous ratio
``zeta_n = eta/2 * (strain energy of the beam) / (energy of all stiffness)``, which loses the same
at resonance.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from antinode.arrays import Array, Integers
from antinode.beam.attachments import Dashpot, PointFeedback, Spring
from antinode.beam.beam import Beam
from antinode.beam.families import FamilyName
from antinode.beam.representation import own_loss
from antinode.errors import InputError
from antinode.modes.backends import BackendName, choose
from antinode.modes.hertz import hertz
from antinode.modes.result import ModalResult
from antinode.modes.solve import solve_modes
from antinode.riccati.chain import Chain, largest_wave_number
from antinode.riccati.points import Point
from antinode.riccati.shapes import gauss_rule, integrate_squares, moved_masses, propagate

from .damping import Damping
from .quantities import Base, Drive, Output, family_of

MOST_MODES = 500


@dataclass(frozen=True)
class Basis:
    """Modes of one family, scaled to unit modal mass.

    Attributes
    ----------
    names : tuple of str
    omega2 : array, shape (n,)
        [rad^2/s^2].
    damping : array, shape (n, n)
        C [1/s]; diagonal but for dashpots.
    drives : array, shape (n, drives)
        b: work of each unit drive on each mode; of the ground's acceleration, in relative motion.
    outputs : array, shape (outputs, n)
        c: each output's component of the state of each mode, relative to the ground.
    drag : array, shape (outputs, n)
        What each output takes of the rate of each mode: a reaction, by the dashpots there.
    doubts : array, shape (n,)
        Of omega2 [rad^2/s^2].
    coupling : array, shape (n, n), optional
        What modes pull each other with besides, where forces depend on motion [rad^2/s^2].
    doubt : float
        How far a frequency may be from its resonance, in half-widths of it, at most.
    loss : array, shape (n, n), optional
        What loss factors take of the stiffness between modes: imaginary part [rad^2/s^2].
    """

    names: tuple[str, ...]
    omega2: Array
    damping: Array
    drives: Array
    outputs: Array
    drag: Array
    doubts: Array
    coupling: Array | None = None
    doubt: float = 0.0
    loss: Array | None = None

    def chosen(self, which: Integers) -> Basis:
        """Return some of its modes."""
        return Basis(
            tuple(self.names[k] for k in which.tolist()),
            self.omega2[which],
            self.damping[np.ix_(which, which)],
            self.drives[which],
            self.outputs[:, which],
            self.drag[:, which],
            self.doubts[which],
            loss=None if self.loss is None else self.loss[np.ix_(which, which)],
        )

    @property
    def frequency_hz(self) -> Array:
        """Natural frequencies [Hz]; 0 for modes that do not vibrate."""
        return hertz(np.maximum(self.omega2, 0.0))

    @property
    def ratio(self) -> Array:
        """Viscous damping ratios; 0 for modes that do not vibrate."""
        omega = np.sqrt(np.maximum(self.omega2, 0.0))
        safe = np.where(omega > 0, omega, 1.0)
        return np.asarray(np.where(omega > 0, np.diag(self.damping) / (2 * safe), 0.0))


def modes_below(
    beam: Beam, family: FamilyName, frequency_hz: float, backend: BackendName = "auto"
) -> int:
    """Return how many modes lie below a frequency, about: by the count of a coarse chain."""
    omega2 = (2 * np.pi * frequency_hz) ** 2
    beam = orthogonal(beam)
    chain = beam.chain(family)
    if np.any(beam.varies(family)):
        waves = float(np.sum(chain.law.oscillation(chain, omega2) * chain.length)) / np.pi
        chain = beam.chain(family, max(1, int(waves / 4)))
    return int(choose(backend).evaluate(chain, [omega2]).below[0])


def without_orthogonality(beam: Beam) -> str:
    """Say why the modes of a beam are not orthogonal; nothing where they are."""
    reasons = []
    if any(beam.ends.follow):
        reasons.append("the force of an end turns with it")
    if any(isinstance(item, PointFeedback) for item in beam.attachments):
        reasons.append("a feedback acts, as the water's stiffness does")
    return ", and ".join(reasons)


def orthogonal(beam: Beam) -> Beam:
    """Return a beam near by whose modes are orthogonal.

    End forces keep their direction; of a feedback what holds and damps each freedom by itself
    stays, as a spring and a dashpot.
    """
    if not without_orthogonality(beam):
        return beam
    ends = replace(beam.ends, left_follower=0.0, right_follower=0.0)
    feedback = [item for item in beam.attachments if isinstance(item, PointFeedback)]
    others = tuple(item for item in beam.attachments if not isinstance(item, PointFeedback))
    parts = [part for item in feedback for part in _held_by(item)]
    return replace(beam, ends=ends, attachments=others).with_attachments(*parts)


def _held_by(item: PointFeedback) -> tuple[Spring, Dashpot]:
    """Return what a feedback does to each freedom by itself, where it holds and damps it."""
    (held, turned), (drag, turning) = (
        np.maximum(np.diag(matrix), 0.0).tolist() for matrix in (item.stiffness, item.damping)
    )
    return (
        Spring(item.x, translational=held, rotational=turned),
        Dashpot(item.x, translational=drag, rotational=turning),
    )


def solved_modes(
    beam: Beam, family: FamilyName, modes: int, backend: BackendName = "auto"
) -> ModalResult:
    """Return modes of unit modal mass.

    Raises
    ------
    InputError
        If there are more than `MOST_MODES`.
    """
    if modes > MOST_MODES:
        raise InputError(
            f"{modes} modes lie in the range of frequencies; at most {MOST_MODES} are computed: "
            "lower its end"
        )
    return solve_modes(
        beam,
        max(modes, 1),
        families=[family],
        normalisation="mass",
        tolerance=1e-8,
        damping="none",
        backend=backend,
    )


def basis(
    beam: Beam,
    family: FamilyName,
    modes: int,
    drives: tuple[Drive, ...],
    outputs: tuple[Output, ...],
    damping: Damping,
    backend: BackendName = "auto",
) -> Basis:
    """Return the modes of one family as a basis; drives and outputs of other families are zero.

    Parameters
    ----------
    beam : Beam
        With a breakpoint at every station.
    modes : int
        Elastic modes, besides rigid ones.

    Raises
    ------
    InputError
        If the force of an end turns with it, or something feeds back: such modes are no basis.
    """
    why = without_orthogonality(beam)
    if why:
        raise InputError(
            f"{why}: the modes are not orthogonal, and no plain sum of them is a response or a "
            "state space; give a loss factor in place of ratios of modes, or leave that out: "
            "left_follower and right_follower 0, point feedback; of a vehicle "
            'end_force = "fixed_direction", '
            'hydrodynamic_stiffness = "none"'
        )
    result = solved_modes(beam, family, modes, backend)
    found = result.family(family)
    solution = result.solutions[family]
    chain, omega2, states = solution.chain, solution.omega2, solution.states
    shown = _Shown(chain, omega2, states, float(beam.x[0]))
    omega2 = np.array([mode.omega2 for mode in found])
    b = np.array([shown.driven(d) if d.family == family else 0 * omega2 for d in drives])
    c = np.array([shown.seen(o) if o.family == family else 0 * omega2 for o in outputs])
    middle = beam.x[0] + (chain.nodes[1:] + chain.nodes[:-1]) / 2
    interval = np.clip(np.searchsorted(beam.x, middle) - 1, 0, len(beam.x) - 2)
    fraction = (middle - beam.x[interval]) / np.diff(beam.x)[interval]
    loss = damping.loss_factor + own_loss(beam, interval, fraction) + np.zeros(len(middle))
    C = shown.dashpots() + np.diag(_own_damping(shown, omega2, found, damping, loss))
    return Basis(
        tuple(mode.name for mode in found),
        omega2,
        C,
        b.reshape(len(drives), len(found)).T,
        c.reshape(len(outputs), len(found)),
        np.array([shown.dragged(o) if o.family == family else 0 * omega2 for o in outputs]),
        np.array([mode.error_omega2 for mode in found]),
        loss=shown.losses(loss) if np.any(loss) and chain.law.has_axial_force else None,
    )


def _own_damping(
    shown: _Shown, omega2: Array, found: tuple[object, ...], given: Damping, loss: Array
) -> Array:
    """Return 2 zeta_n omega_n of every mode [1/s], without dashpots."""
    omega = np.sqrt(np.maximum(omega2, 0.0))
    if given.rayleigh is not None:
        return np.asarray(given.rayleigh.alpha + given.rayleigh.beta * np.maximum(omega2, 0.0))
    if given.modal:
        numbers = [getattr(mode, "number", 0) for mode in found]
        ratios = np.array([given.ratio(number) if number else 0.0 for number in numbers])
        return np.asarray(2 * ratios * omega)
    share = shown.strain(loss) / np.where(omega2 > 0, omega2, 1.0)
    return np.asarray(np.where(omega2 > 0, share * omega, 0.0))


class _Shown:
    """What modes show at stations, and what forces do to them."""

    def __init__(self, chain: Chain, omega2: Array, states: Array, origin: float) -> None:
        self.chain, self.omega2, self.states, self.origin = chain, omega2, states, origin

    def node(self, x: float) -> int:
        return int(np.argmin(np.abs(self.chain.nodes - (x - self.origin))))

    def left(self, node: int) -> Array:
        """Return the states on the left side of a node, shape (n, s)."""
        before = np.array([node - 1])
        length = self.chain.length[before]
        z = propagate(self.chain, self.states[before], self.omega2, length, before)
        return np.asarray(z[0])

    def before_joint(self, node: int) -> Array:
        """Return the states that masses, springs and forces at a node feel: left of its joint."""
        return self.states[0] if node == 0 else self.left(node)

    def seen(self, output: Output) -> Array:
        """Return an output's component of all modes."""
        node, last = self.node(output.x), len(self.chain.length)
        if output.component < 0:
            return self._reaction(-1 - output.component, node)
        on_left = node == last or (output.side == "left" and node > 0)
        return np.asarray((self.left(node) if on_left else self.states[node])[:, output.component])

    def dragged(self, output: Output) -> Array:
        """Return what an output takes of the rates of all modes."""
        node, freedom = self.node(output.x), -1 - output.component
        point = next((p for p in self.chain.points if p.node == node), Point(node))
        if freedom < 0 or not point.damps:
            return np.zeros(len(self.omega2))
        drag = (point.dashpot, point.rotational_dashpot)[freedom]
        return np.asarray(-drag * self.before_joint(node)[:, freedom])

    def _reaction(self, freedom: int, node: int) -> Array:
        """Return what the ground does to the beam at a node, by the jump there and at an end."""
        law, last = self.chain.law, len(self.chain.length)
        point = next((p for p in self.chain.points if p.node == node), Point(node))
        zero = np.zeros_like(self.states[0])
        left = self.left(node) if node else zero
        right = self.states[node] if node < last else zero
        felt = left if node else right
        inertia = np.einsum(
            "nij,nj->ni", law.load(point.off_ground, self.omega2) - np.eye(law.size), felt
        )
        one = Point(0, mass=1.0) if freedom == 0 else Point(0, inertia=1.0)
        unit = (law.load(one, np.ones(1))[0] - np.eye(law.size))[:, freedom]
        force = int(np.flatnonzero(unit)[0])
        return np.asarray((right - left - inertia)[:, force] / unit[force])

    def driven(self, drive: Drive) -> Array:
        """Return the work of a unit drive on every mode."""
        if isinstance(drive, Base):
            return -self._moved()
        freedom = family_of(drive.direction).directions.index(drive.direction)
        node = self.node(drive.x)
        if drive.to is None:
            return np.asarray(self.before_joint(node)[:, freedom])
        some = slice(node, self.node(drive.to))
        return np.asarray(np.sum(self._integrals()[some], axis=0))

    def _integrals(self) -> Array:
        """Return the integrals of the displacement over all segments, shape (segments, n)."""
        chain, total = self.chain, np.zeros((len(self.chain.length), len(self.omega2)))
        phase = largest_wave_number(chain, float(np.max(np.abs(self.omega2)))) * chain.length
        for point, weight in zip(*gauss_rule(float(np.max(phase))), strict=True):
            z = propagate(chain, self.states[:-1], self.omega2, point * chain.length)
            total += weight * chain.length[:, None] * z[..., 0]
        return total

    def _moved(self) -> Array:
        """Return int m phi: the inertia of a unit acceleration of all places alike."""
        law, chain = self.chain.law, self.chain
        total = chain.mass @ self._integrals()
        one = np.eye(law.size)[:1]
        for point in chain.points:
            z = self.before_joint(point.node)
            free = replace(point.off_ground, compliance=0.0)
            for row, sign in ((z + one, 0.25), (z - one, -0.25)):
                total = total + sign * law.point_energies(free, row, False)[0]
        for node, moved in moved_masses(chain, self.states, self.omega2).items():
            total = total + self._sprung(node) * moved
        return np.asarray(total)

    def _sprung(self, node: int) -> float:
        """Return the mass of the pedestal at a node [kg]."""
        return next(p.pedestal.mass for p in self.chain.points if p.node == node and p.pedestal)

    def strain(self, loss: Array) -> Array:
        """Return the strain energy of each mode weighted by loss factors, times two [1/s^2]."""
        squares = integrate_squares(self.chain, self.states, self.omega2)
        columns = self.chain.columns
        shear = np.broadcast_to(columns.get("shear", np.zeros(())), loss.shape)
        return np.asarray(
            (loss / columns["stiffness"]) @ squares.moment + (loss * shear) @ squares.shear
        )

    def losses(self, loss: Array) -> Array:
        """Return the strain energy between modes weighted by loss factors, times two, (n, n)."""
        chain, columns = self.chain, self.chain.columns
        shear = np.broadcast_to(columns.get("shear", np.zeros(())), loss.shape)
        phase = largest_wave_number(chain, float(np.max(np.abs(self.omega2)))) * chain.length
        total = np.zeros((len(self.omega2), len(self.omega2)))
        for point, weight in zip(*gauss_rule(float(np.max(phase))), strict=True):
            z = propagate(chain, self.states[:-1], self.omega2, point * chain.length)
            V = z[..., 3] - columns["axial_force"][:, None] * z[..., 1]
            share = weight * chain.length * loss
            total += (z[..., 2].T * (share / columns["stiffness"])) @ z[..., 2]
            total += (V.T * (share * shear)) @ V
        return total

    def dashpots(self) -> Array:
        """Return the damping by dashpots, shape (n, n)."""
        C = np.zeros((len(self.omega2), len(self.omega2)))
        for point in self.chain.points:
            if point.damps:
                z = self.before_joint(point.node)
                C += point.dashpot * np.outer(z[:, 0], z[:, 0])
                if self.chain.law.size > 2:
                    C += point.rotational_dashpot * np.outer(z[:, 1], z[:, 1])
        return C
