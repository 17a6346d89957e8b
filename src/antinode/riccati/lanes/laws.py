"""The laws in compiled form: the only file here that tells one from another.

`FORMS` says how the arrays of each law are made; the functions below it send a chain to the code of
its law, by number.
"""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from antinode.riccati.laws import BAR, BENDING, SHAFT, Law
from antinode.riccati.points import Pedestal, Point

from . import bending, pieces, sheared, wave
from .compiling import compiled
from .workspace import HOLDS_THETA, HOLDS_Y, LANES, OMEGA2, POWER, SHEAR_TURN, SHEAR_WORK

_BENDING, _WAVE, _SHEARED = 0, 1, 2
_NO_PEDESTAL = Pedestal(0.0, 0.0, 0.0)


class Form(NamedTuple):
    """The compiled form of a law."""

    number: int
    with_more: int
    """Its number where segments have more columns than they must."""
    ends: dict[str, int]
    point: Callable[[Point, float, float, float], tuple[float, ...]]
    """Columns of a point, dimensionless by length, mean stiffness and mean m."""
    supports: bool
    """Whether supports between the ends are known."""
    shapes: bool
    """Whether `riccati.lanes.modal` knows its modes."""
    force_sign: float = 1.0
    """Of the law's own force in what is carried."""

    def sign(self, left: str, right: str) -> float:
        """Return the sign of the law's characteristic function in the one that is computed.

        A force stands at the start of a held end, and at the end of a free one.
        """
        return self.force_sign if left == right else 1.0


def _bending_point(p: Point, L: float, EI0: float, m0: float) -> tuple[float, ...]:
    own = p.pedestal or _NO_PEDESTAL
    inertia = p.mass * p.offset**2 + p.inertia
    turning = p.rotational_spring + p.own_load * p.offset if p.loads else 0.0
    return (
        *(p.mass / (m0 * L), p.mass * p.offset / (m0 * L**2), inertia / (m0 * L**3)),
        *(p.spring * L**3 / EI0, turning * L / EI0),
        *(float(0 in p.holds), float(1 in p.holds), p.compliance * EI0 / L),
        *(p.inertia / (m0 * L**3), p.coupling * L**2 / EI0),
        *(own.mass / (m0 * L), own.upper * L**3 / EI0, own.lower * L**3 / EI0),
    )


def _wave_point(p: Point, L: float, K0: float, m0: float) -> tuple[float, ...]:
    mass, spring = p.mass / (m0 * L), p.spring * L / K0
    return mass, 0.0, 0.0, spring, 0.0, 0.0, 0.0, p.compliance * K0 / L, *(0.0,) * 5


_OF_WAVES = Form(_WAVE, _WAVE, wave.ENDS, _wave_point, supports=False, shapes=False)
FORMS: dict[Law, Form] = {
    BENDING: Form(_BENDING, _SHEARED, bending.ENDS, _bending_point, supports=True, shapes=True),
    BAR: _OF_WAVES,
    SHAFT: _OF_WAVES._replace(force_sign=-1.0),
}


@compiled
def omega2_unit(law, L, m0, K0):
    """Return omega^2 [rad^2/s^2] that is 1 without units."""
    return K0 / (m0 * L * L * L * L) if law != _WAVE else K0 / (m0 * L * L)


@compiled
def count_pieces(chain, force, omega2):
    """Set the first piece of every segment; return how many reach abs(omega2) under a force."""
    h, m, K, starts = chain.length, chain.mass, chain.stiffness, chain.starts
    if chain.law == _BENDING:
        return pieces.count_pieces(h, m, K, force, omega2, starts)
    if chain.law == _SHEARED:
        return sheared.count_pieces(h, m, K, force, chain.more, omega2, starts)
    return wave.count_pieces(h, m, K, omega2, starts)


@compiled
def fill_table(chain, table):
    """Fill the table of pieces: as many as were counted."""
    h, m, K, starts, marks = chain.length, chain.mass, chain.stiffness, chain.starts, chain.marks
    if chain.law == _BENDING:
        pieces.fill_table(h, m, K, chain.force, starts, marks, table)
    elif chain.law == _SHEARED:
        sheared.fill_table(h, m, K, chain.force, chain.more, starts, marks, table)
    else:
        wave.fill_table(h, m, K, starts, marks, table)


@compiled
def prepare(chain, omega2, table):
    """Fill the table for all up to abs(omega2); return the pieces, which may be more than fit."""
    number = count_pieces(chain, chain.force, omega2)
    if 0 <= number <= table.shape[1]:
        fill_table(chain, table)
    return number


@compiled
def start(chain, lanes):
    """Set what the left end admits."""
    for k in range(OMEGA2):
        lanes.state[k] = 0.0
    for lane in range(LANES):
        lanes.state[POWER + lane] = 0.0
    if chain.law != _WAVE:
        bending.start(chain.left, lanes.state, lanes.sign)
        bending.follow_start(chain.following[0], lanes.state)
    else:
        wave.start(chain.left, lanes.state, lanes.sign)


@compiled
def advance(law, table, state, first, last):
    """Carry the lanes through pieces, and count."""
    if law == _BENDING:
        bending.advance(table, state, first, last)
    elif law == _SHEARED:
        sheared.advance(table, state, first, last)
    else:
        wave.advance(table, state, first, last)


@compiled
def to_chain_units(law, table, piece, state):
    """Take the lanes out of the units of a piece."""
    if law != _WAVE:
        bending.to_chain_units(table, piece, state)
    else:
        wave.to_chain_units(table, piece, state)


@compiled
def pass_point(law, point, lanes):
    """Apply what stands at a node."""
    if law != _WAVE:
        bending.pass_point(point, lanes.state, lanes.sign)
    else:
        wave.pass_point(point, lanes.state)


@compiled
def finish(chain, lanes):
    """Count what the right end leaves free, and set the characteristic function."""
    if chain.law != _WAVE:
        bending.finish(chain.right, lanes.state, lanes.value)
        if chain.following[1] != 0.0:
            sigma = chain.following[0] if keeps_sigma(chain) else 0.0
            bending.follow_finish(sigma, chain.following[1], lanes.state, lanes.value)
    else:
        wave.finish(chain.right, lanes.state, lanes.value)


@compiled
def beyond(chain, omega2):
    """Return omega^2 of bending one root farther up, mostly."""
    place = math.sqrt(math.sqrt(omega2)) + root_spacing(chain)
    return place * place * place * place


@compiled
def keeps_sigma(chain):
    """Tell whether no support makes every plane Lagrangian (`riccati.lanes.following`)."""
    held = False
    for k in range(len(chain.points)):
        held = held or chain.points[k, HOLDS_Y] != 0.0 or chain.points[k, HOLDS_THETA] != 0.0
    return not held


@compiled
def root_spacing(chain):
    """Return how far the fourth roots of neighbouring omega^2 in bending are apart, mostly."""
    phase = 0.0
    for k in range(len(chain.length)):
        phase += chain.length[k] * math.sqrt(math.sqrt(chain.mass[k] / chain.stiffness[k]))
    return math.pi / phase


@compiled
def first_samples(chain, number, samples):
    """Set samples between the roots that a slowly varying chain would have, and one below 0."""
    h, m, K = chain.length, chain.mass, chain.stiffness
    if chain.law == _BENDING:
        bending.first_samples(h, m, K, chain.force, number, samples)
    elif chain.law == _SHEARED:
        sheared.first_samples(h, m, K, chain.force, chain.more, number, samples)
    else:
        wave.first_samples(h, m, K, number, samples)
    samples[number] = -1.0
    return number + 1


@compiled
def scale_force(chain, times):
    """Multiply the axial force, and what shear makes of it."""
    force, more = chain.force, chain.more
    for k in range(len(force)):
        force[k] *= times
    for k in range(more.shape[1]):
        more[SHEAR_TURN, k] *= times
        more[SHEAR_WORK, k] *= times * times


@compiled
def size_and_unit(chain, omega2, force, carried):
    """Return the size of what is carried, and the unit of the characteristic function in it."""
    if chain.law != _WAVE:
        return bending.size_and_unit(omega2, force, chain.right, carried)
    return wave.size_and_unit(omega2, chain.right, carried)
