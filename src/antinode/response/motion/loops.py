"""Forces that depend on motion, closed over modes that know nothing of them.

An end whose force turns with it, and a feedback, are forces g that the motion u at their place
makes: ``g = -K u - D u'``. The modes of the beam without them, which are orthogonal, move under f
and g alike; u is a sum of these modes and of what the others do at rest:

    q'' + C q' + omega_n^2 q = b f + b_g g,   u = c_u q + r f + r_g g

Put into each other these are equations in q alone, with a matrix in place of omega_n^2. Its zeros
are the complex modes of the body, rigid ones however defective; the static rest makes them as good
as the sum of modes is for forces from outside.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Numbers
from antinode.beam.attachments import PointFeedback
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FAMILIES, FamilyName
from antinode.errors import InputError
from antinode.response.frequency import Model
from antinode.response.modal import Basis, orthogonal, without_orthogonality
from antinode.response.modal_sum import Summed
from antinode.response.quantities import Base, Force, Output

from .recurrence import companion


class Loops(NamedTuple):
    """Forces that depend on motion: ``g = -stiffness u - damping u'``.

    Attributes
    ----------
    drives : tuple of Force
        Unit forces g.
    outputs : tuple of Output
        Motions u.
    stiffness, damping : array, shape (drives, outputs)
    """

    drives: tuple[Force, ...]
    outputs: tuple[Output, ...]
    stiffness: Array
    damping: Array


def loops_of(beam: Beam) -> Loops:
    """Return what `orthogonal` leaves out of a beam."""
    drives: list[Force] = []
    outputs: list[Output] = []
    blocks: list[tuple[Array, Array]] = []
    for x, force, sign in zip(beam.x[[0, -1]], beam.following(BENDING), (-1.0, 1.0), strict=True):
        if force:
            drives.append(Force(float(x)))
            outputs.append(Output(float(x), "slope"))
            blocks.append((np.array([[sign * force]]), np.zeros((1, 1))))
    for item in beam.attachments:
        if isinstance(item, PointFeedback):
            drives += [Force(item.x), Force(item.x, "moment")]
            outputs += [Output(item.x, "displacement"), Output(item.x, "slope")]
            K, C = (m - np.diag(np.maximum(np.diag(m), 0)) for m in (item.stiffness, item.damping))
            blocks.append((K, C))
    stiffness, damping = np.zeros((2, len(drives), len(outputs)))
    row = 0
    for K, C in blocks:
        some = slice(row, row + len(K))
        stiffness[some, some], damping[some, some] = K, C
        row += len(K)
    return Loops(tuple(drives), tuple(outputs), stiffness, damping)


class Closed:
    """The bending modes of a beam near by with the loops of this one, in place of `Summed`.

    Attributes
    ----------
    model : Model
        That is asked.
    basis : Basis
        With `coupling`.
    rest : array, shape (outputs, drives)
    shift : float
    half : Closed
        The same with half of the modes.
    """

    def __init__(self, model: Model, summed: Summed, loops: Loops, half: bool = False) -> None:
        self.model, self.family, self.shift = model, summed.family, summed.shift
        own, rest = summed.basis, summed.rest
        self._make_half: Callable[[], Closed] = lambda: Closed(model, summed, loops, True)
        if half:
            order = np.argsort(own.omega2, kind="stable")
            kept = order[: (len(order) + 1) // 2]
            own, rest = own.chosen(kept), summed.rest_of(kept)
        self.basis, self.rest = _closed(own, rest, model, loops)

    @property
    def half(self) -> Closed:
        """The same with half of the modes."""
        return self._make_half()

    @property
    def poles(self) -> Numbers:
        """Complex eigenvalues s of what oscillates, Im s > 0, by rising |s| [1/s]."""
        own = self.basis
        assert own.coupling is not None
        roots = np.linalg.eigvals(companion(np.diag(own.omega2) + own.coupling, own.damping)[0])
        least = 1e-3 * np.sqrt(np.min(own.omega2[own.omega2 > 0], initial=np.inf))
        found = roots[(roots.imag > 0) & (np.abs(roots) > least)]
        return np.asarray(found[np.argsort(np.abs(found))])


def _closed(own: Basis, rest: Array, model: Model, loops: Loops) -> tuple[Basis, Array]:
    """Return a basis and a static rest with the loops closed."""
    d, o = len(model.drives), len(model.outputs)
    own_out, seen, b = own.outputs[:o], own.outputs[o:], own.drives[:, :d]
    into, K, D = own.drives[:, d:], loops.stiffness, loops.damping
    # g = -W K (c_u q + r f) - W D c_u q': the rest of a rate is left out
    W = np.linalg.inv(np.eye(len(K)) + K @ rest[o:, d:])
    pull, brake, by_force = W @ K @ seen, W @ D @ seen, W @ K @ rest[o:, :d]
    out = rest[:o, d:]
    damping = own.damping + into @ brake + _of_stiffness(own, into @ pull, model)
    closed = Basis(
        own.names,
        own.omega2,
        damping,
        b - into @ by_force,
        own_out - out @ pull,
        own.drag[:o] - out @ brake,
        own.doubts,
        into @ pull,
    )
    return closed, rest[:o, :d] - out @ by_force


def _of_stiffness(own: Basis, pulled: Array, model: Model) -> Array:
    """Return what damping by stiffness becomes where modes pull each other, beyond that of each.

    Losses take ``i G`` of the stiffness; ``C = G A^(-1/2)``, A the matrix of the closed modes, is
    as much at each of their resonances: ``i omega C x = i G x`` where ``A x = omega^2 x``.
    """
    if model.damping.rayleigh is not None:
        buckled = np.diag(np.minimum(own.omega2, 0.0))  # which by themselves lose nothing so
        return np.asarray(model.damping.rayleigh.beta * (pulled + buckled))
    if own.loss is None:
        return np.zeros_like(pulled)
    squares, X = np.linalg.eig(np.diag(own.omega2) + pulled)
    still = (np.abs(squares) <= _still(own.omega2)) | ((squares.imag == 0) & (squares.real < 0))
    slowness = np.where(still, 0.0, 1 / np.sqrt(np.where(still, 1.0, squares.astype(complex))))
    together = own.loss @ np.real((X * slowness) @ np.linalg.inv(X))
    moves = own.omega2 > 0
    each = np.where(moves, np.diag(own.loss) / np.sqrt(np.where(moves, own.omega2, 1.0)), 0.0)
    return np.asarray(together - np.diag(each))


def summed(model: Model, family: FamilyName, modes: int) -> Summed | Closed:
    """Return a sum of modes of a family, whatever makes forces depend on motion.

    Raises
    ------
    InputError
        If something feeds back and the supports move.
    """
    if not without_orthogonality(model.beam):
        return Summed(model, family, modes)
    bends = FAMILIES[family].law.has_axial_force
    loops = loops_of(model.beam) if bends else Loops((), (), *np.zeros((2, 0, 0)))
    feeds = any(isinstance(item, PointFeedback) for item in model.beam.attachments)
    if bends and feeds and any(isinstance(d, Base) and d.family == family for d in model.drives):
        raise InputError(
            "the supports move and something feeds back: whether it feels the motion of the ground "
            "is not said, and a history needs it; give forces in place of [base]"
        )
    near = Model(
        orthogonal(model.beam),
        (*model.drives, *loops.drives),
        (*model.outputs, *loops.outputs),
        model.damping,
        model.highest_hz,
        model.backend,
    )
    plain = Summed(near, family, modes)
    return Closed(model, plain, loops) if loops.drives else plain


def resonant(model: Model, family: FamilyName, own: Basis) -> Basis:
    """Return modes of a family as they resonate where forces depend on motion.

    Parameters
    ----------
    model : Model
    family : str
    own : Basis
        Of the beam near by, which gives them their names.

    Returns
    -------
    Basis
        With frequencies and ratios of the complex modes, and how far half of the modes that they
        are made of would move them, over the eight that this falls by at least.
    """
    wide = summed(model, family, 2 * len(own.names) + 8)
    if not isinstance(wide, Closed):
        return own
    found, few = wide.poles, wide.half.poles
    rotation = np.array([name.endswith("rotation") for name in own.names])
    order = np.lexsort((own.omega2, rotation, own.omega2 > _still(own.omega2)))
    # the highest are the same ones; of the lowest some vibrate now, rotation first, or cease to
    more = len(found) - _vibrating(wide.basis.omega2)
    first = len(order) - _vibrating(own.omega2) - more
    count = min(len(order) - max(first, 0), len(found) - max(-first, 0), len(few))
    s, near = (p[max(-first, 0) :][:count] for p in (found, few))
    away = np.abs(near - s) / np.maximum(np.abs(s.real), 1e-9 * np.abs(s))
    return replace(
        own.chosen(order[max(first, 0) :][:count]),
        omega2=np.abs(s) ** 2,
        damping=np.diag(2 * np.abs(s.real)),
        doubt=float(np.max(away, initial=0.0) / 8),
    )


def _vibrating(omega2: Array) -> int:
    return int(np.sum(omega2 > _still(omega2)))


def _still(omega2: Array) -> float:
    """Return up to which omega^2 a motion of a beam near by does not vibrate."""
    return 1e-9 * float(np.max(np.abs(omega2)))
