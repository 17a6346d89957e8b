"""Supports between the ends of a driven chain: what they hold, and the basis behind them."""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from antinode.riccati.lanes.compiling import compiled
from antinode.riccati.lanes.workspace import LANES

from .layout import FACTOR, FIRST, GROWN, PAIR, SECOND, UNIT
from .segments import conjugate, get, over, put, square, times

_PSI, _ROW = PAIR, 2 * PAIR


@compiled
def hold(chain, rows, w, room, basis):
    """Pass a support of the displacement (1), of the turn (2) or of both (3)."""
    for lane in range(LANES):
        if rows == 3:
            _hold_both(chain, lane, w, room, basis)
        else:
            _hold_one(chain, rows - 1, lane, w, room, basis)


@compiled
def _hold_both(chain, lane, w, room, basis):
    """Start anew: only the forces are free behind it."""
    a, b = get(w, FIRST + lane), get(w, SECOND + lane)
    c, d = get(w, FIRST + _PSI + lane), get(w, SECOND + _PSI + lane)
    whole, back = a * d - b * c, room.back[basis]
    put(w, FACTOR + lane, whole * get(w, FACTOR + lane))
    for part in range(4):
        put(back, part * PAIR + lane, complex(0.0, 0.0))
    for case in range(len(chain.ground)):
        z, shift = room.cases[case], room.shift[basis, case]
        moved = chain.ground[case] / w[UNIT + lane]
        Y, psi = moved - get(z, lane), -get(z, _PSI + lane)
        put(shift, lane, over(d * Y - b * psi, whole))
        put(shift, PAIR + lane, over(a * psi - c * Y, whole))
        for row in range(4):
            put(z, row * PAIR + lane, complex(moved if row == 0 else 0.0, 0.0))
    for row in range(4):
        put(w, FIRST + row * PAIR + lane, complex(1.0 if row == 2 else 0.0, 0.0))
        put(w, SECOND + row * PAIR + lane, complex(1.0 if row == 3 else 0.0, 0.0))


@compiled
def _hold_one(chain, row, lane, w, room, basis):
    """Hold one displacement: its force is free behind, and one state of the frame is left."""
    held, force, back = row * PAIR + lane, (3 - row) * PAIR + lane, room.back[basis]
    a, b = get(w, FIRST + held), get(w, SECOND + held)
    size = 1.0 / math.sqrt(square(a) + square(b))
    a, b, length = times(size, a), times(size, b), 0.0
    for other in range(4):
        place = other * PAIR + lane
        if other != row and other != 3 - row:
            length += square(b * get(w, FIRST + place) - a * get(w, SECOND + place))
    length = 1.0 / math.sqrt(length)
    w[GROWN + lane] *= 1.0 / (size * length)
    for case in range(len(chain.ground)):
        z, shift = room.cases[case], room.shift[basis, case]
        ground = chain.ground[case] / w[UNIT + lane] if row == 0 else 0.0
        missing = times(size, ground - get(z, held))
        m0, m1, q = conjugate(a) * missing, conjugate(b) * missing, complex(0.0, 0.0)
        put(z, held, complex(ground, 0.0))
        put(z, force, complex(0.0, 0.0))
        for other in range(4):
            place = other * PAIR + lane
            if other != row and other != 3 - row:
                wall = get(z, place) + get(w, FIRST + place) * m0 + get(w, SECOND + place) * m1
                left = times(length, b * get(w, FIRST + place) - a * get(w, SECOND + place))
                q += conjugate(left) * wall
                put(z, place, wall)
        for other in range(4):
            place = other * PAIR + lane
            if other != row and other != 3 - row:
                left = times(length, b * get(w, FIRST + place) - a * get(w, SECOND + place))
                put(z, place, get(z, place) - left * q)
        put(shift, lane, m0 - times(length, b * q))
        put(shift, PAIR + lane, m1 + times(length, a * q))
    for other in range(4):
        place = other * PAIR + lane
        left = times(length, b * get(w, FIRST + place) - a * get(w, SECOND + place))
        free = other == row or other == 3 - row
        put(w, FIRST + place, complex(0.0, 0.0) if free else left)
        put(w, SECOND + place, complex(1.0 if other == 3 - row else 0.0, 0.0))
    put(back, lane, times(length, b))
    put(back, PAIR + lane, complex(0.0, 0.0))
    put(back, _ROW + lane, times(-length, a))
    put(back, _ROW + PAIR + lane, complex(0.0, 0.0))
