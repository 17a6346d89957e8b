"""Where the numbers of a driven chain stand: rows of arrays, kinds of steps, structures.

Complex numbers are pairs: a row of eight real parts, and behind it a row of eight imaginary ones.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Integers
from antinode.riccati.lanes.workspace import LANES

PAIR = 2 * LANES
"""One complex number in each lane."""

SIZE = 4
"""Components of a state."""

COLUMN = SIZE * PAIR
"""A column of states."""

# One array holds all that a pass over the lanes needs, so that nothing can overlap. The lanes
# themselves: omega^2 and i omega, complex; l and 1/l.
OMEGA2, DASHPOT, UNIT, PER_UNIT = 0, PAIR, 2 * PAIR, 2 * PAIR + LANES
LANE = 3 * PAIR

# What one segment does: ten entries of U as `modal.segments` orders them, four of what a unit force
# per length leaves behind it; and what the series leave for them.
U00, U01, U02, U03, U10, U11, U12, U20, U21, U30 = (LANE + k * PAIR for k in range(10))
D0, D1, D2, D3 = (LANE + k * PAIR for k in range(10, 14))
G0, G1, G2, G3, GI, KAPPA, TURN, MU = (LANE + k * PAIR for k in range(14, 22))

FIRST = LANE + 22 * PAIR
SECOND = FIRST + COLUMN
"""The two columns of the frame."""
CASE = SECOND + COLUMN
"""The particular state of one load case."""
BACK = CASE + COLUMN
"""Coefficients before a basis over those after it, 2 x 2."""
SHIFT = BACK + 4 * PAIR
"""What is added, of the same load case."""
FACTOR, GROWN, LOGS = SHIFT + 2 * PAIR, SHIFT + 3 * PAIR, SHIFT + 3 * PAIR + LANES
"""Of the determinant of the frame: what supports cut off, growth since the last logarithm, and the
logarithms before."""
WORK = SHIFT + 4 * PAIR

# Constants of one piece of a segment: those of a law that is linear in omega^2, in units of its
# length and stiffness, then K0/EI and EI/K0, complex; its length, its phase, and where there is
# nothing but N: N h^2/K0 and m h^4/K0.
TURN_0, TURN_1, MU_0, MU_1, SIGMA, ALPHA, SOFT, STIFF = range(0, 16, 2)
LENGTH, PHASE, FORCE, INERT = range(16, 20)
CONSTANTS = 20

POWERS = 4
"""Of m omega^2 h^4/EI, complex, in each of the four series where there is nothing but N."""

# What a search keeps of three places - s, D, the logarithm of its size - and the last value; the
# length of the last step, and whether it is done.
X0, X1, X2 = (k * (2 * PAIR + LANES) for k in range(3))
VALUE_AT = X2 + 2 * PAIR + LANES
SIZE_AT = VALUE_AT + PAIR
STEP = SIZE_AT + LANES
SEARCH = STEP + 2 * LANES

# Kinds of steps, each with two numbers.
SEGMENTS, LOADS, JOINT, HOLD, KEEP, EVERY = range(6)
"""The last are segments with a mark at every node between them."""

# Columns of a point.
MASS, OFFSET, INERTIA, SPRING, TURNING, COUPLING, OWN_LOAD, DAMPER, TURN_DAMPER, COMPLIANCE = range(
    10
)
FEEDBACK, RATES = 10, 14
"""K and C of a feedback, rows Y and psi."""
POINT = 18

BESIDE = 1e-3
"""Of the distance to the next pole: nearer to the axis S is taken from beside."""

LONGEST = 0.6
"""Wave number times length of a piece: eight terms of the series reach rounding."""

TERMS = 8
BASIS = 1.25
"""Of a wave, in radians, that is passed without a new basis."""


class Driven(NamedTuple):
    """A chain and what drives it."""

    steps: Integers
    """Kind and two numbers of every step, shape (steps, 3)."""
    constants: Array
    """Shape (n, CONSTANTS)."""
    pieces: Integers
    """In how many every segment is passed, shape (n,)."""
    series: Array
    """Of g_3 ... g_0 in powers, shape (n, 8 POWERS); (0, 8 POWERS) where segments have more."""
    along: Array
    """Force per length of every segment and load case, shape (n, cases)."""
    points: Array
    """Shape (points, POINT)."""
    forces: Array
    """Force and moment at nodes, shape (nodes, 2, cases)."""
    ground: Array
    """Motion of the ground, shape (cases,)."""
    stiffness: float
    """EI0."""


class Ends(NamedTuple):
    """What the ends admit, and whether they move with the ground."""

    start: Array
    """Frame at the left end, shape (groups, 2 SIZE LANES), column after column; one for all, or
    one for each."""
    wanted: Array
    """Conditions at the right end, shape (groups, 2 SIZE LANES), row after row."""
    left_moves: bool
    right_moves: bool


class Free(NamedTuple):
    """A chain by itself, whose points feed back, at complex s."""

    chain: Driven
    """Without load cases, or with one that is none."""
    ends: Ends
    inertia: float
    rest: float
    """``l^-4 = inertia abs(s)^2 + rest``: the unit of length."""
    power: float
    constant: float
    """The logarithm of D has ``power log(l) + constant`` for its units."""


class Zeros(NamedTuple):
    """What is asked of a search."""

    zeros: int
    """At s = 0, divided out."""
    unit: float
    floor: float
    most: float
    """Modulus of s beyond which no search goes."""
    mirrored: bool


class Acting(NamedTuple):
    """Where something acts on a base chain, driven there by unit forces, and its matrices."""

    free: Free
    """With a load case for each displacement."""
    mark: Integers
    """Of each displacement, shape (r,)."""
    freedom: Integers
    K: Array
    C: Array


class Sampled(NamedTuple):
    """Samples of g, as `riccati.damped.ratio.RatioSamples` has them."""

    value: Array
    """Shape (k, 2)."""
    reach: Array
    matrix: Array
    """Shape (k, r, r)."""
    inverse: Array
    receptance: Array
    stiffness: Array
    damping: Array
    acting: Array
    """Shape (k, r, r, 2)."""
    size: Array
    """Shape (k, r)."""


class RatioWork(NamedTuple):
    """What samples of g write into, of matrices one for all."""

    places: Array
    """Shape (2 k, 2)."""
    beside: Integers
    out: Array
    """Shape (marks, SIZE, r, 2 k, 2)."""
    G: Array
    """Shape (2 k, r, r, 2)."""
    g: Array
    z: Array
    m: Array
    inverse: Array


class Rule(NamedTuple):
    """How products are integrated over segments."""

    weights: Array
    """Of the Gauss points of a segment."""
    constants: Array
    """Of a piece of what lies left of each point, shape (points, n, CONSTANTS)."""
    length: Array
    force: Array
    """N."""


class Room(NamedTuple):
    """What one group of lanes writes into."""

    work: Array
    """Shape (WORK,)."""
    cases: Array
    """Particular states, shape (cases, COLUMN)."""
    back: Array
    """Of every basis, shape (bases, 4 PAIR)."""
    shift: Array
    """Of every basis and case, shape (bases, cases, 2 PAIR)."""
    frames: Array
    """At the marks, shape (marks, 2 COLUMN)."""
    kept: Array
    """Particular states there, shape (marks, cases, COLUMN)."""
    basis: Integers
    """Which basis each belongs to, shape (marks,)."""
    coefficients: Array
    """Of every case, shape (cases, 2 PAIR)."""


def new_room(cases: int, bases: int, marks: int) -> Room:
    """Return room for one group of lanes."""
    return Room(
        np.zeros(WORK),
        np.zeros((cases, COLUMN)),
        np.zeros((bases, 4 * PAIR)),
        np.zeros((bases, cases, 2 * PAIR)),
        np.zeros((marks, 2 * COLUMN)),
        np.zeros((marks, cases, COLUMN)),
        np.zeros(marks, np.int64),
        np.zeros((cases, 2 * PAIR)),
    )
