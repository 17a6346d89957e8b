"""What compiled code takes and writes into: structures of arrays, their rows and columns, by name.

Numbers of chains are dimensionless by the chain's length, mean stiffness and mean m.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from antinode.riccati.arrays import Array, Integers

LANES = 8
"""omega^2 that are passed side by side."""

# Rows of the table of pieces, one column a piece. All laws:
INERTIA, LENGTH, FLEXIBILITY = 17, 22, 23
"""2c/omega^2 of bending (c/omega^2 of a wave), h, and 1/EI (or 1 over what stands for it)."""
RATIO = 18
"""Of the units of this piece to those of the one before: of b, or of a wave's force."""
# Bending alone:
SERIES_0, SERIES_1, SERIES_2, SERIES_3 = 0, 4, 8, 12
"""Four coefficients each, of the powers of 2c in G0 ... G3."""
FORCE = 16
"""n = N h^2/EI."""
RATIO_E, RATIO_D, RATIO_F = 19, 20, 21
# Lateral motion with more columns, in place of the series:
TURN_FORCE, TURN_INERTIA, FOUNDATION, HALF_SHEAR, COUPLING, KAPPA, KAPPA_INERTIA = range(7)
"""(N + sN^2) h^2/EI; rho I h^2/EI; 2k h^4/EI; s EI/(2 h^2); alpha; kappa, and how it falls with
omega^2."""
ROWS = 24

# Rows of what lateral segments may have besides: s, sN, sN^2, rho I, k.
SHEAR, SHEAR_TURN, SHEAR_WORK, ROTARY_INERTIA, GROUND = range(5)
MORE = 5

# The state: lanes side by side, row after row. What a frame of bending has as minors a, b, 2e, 2d,
# 2f in the units of the last piece; a wave has u where a stands, and its force where b stands.
A, B, E, D, F = (row * LANES for row in range(5))
U, Q = A, B
COUNT, OMEGA2, POWER = (row * LANES for row in range(5, 8))
"""Eigenvalues below, omega^2 itself, and the power of two that was taken out."""
CARRIED = 5
"""Rows that are carried along."""
STATE = 8 * LANES

# Columns of the points, dimensionless.
MASS, FIRST_MOMENT, ROTARY, SPRING, TURNING, HOLDS_Y, HOLDS_THETA, COMPLIANCE = range(8)
CENTRAL, COUPLING = range(8, 10)
"""Among them m d, the inertia about the node, and that about the mass's own centre."""
SPRUNG, UPPER, LOWER = range(10, 13)
"""Mass of a pedestal, 0 without one, and its springs to the node and to the ground."""
POINT = 13

# Shapes: what stands flat, rows of lanes after rows, for every segment or node.
SHEAR_OF, TURNING_OF, INERTIA_OF = (row * LANES for row in range(3))
"""s, beta and mu of a segment."""
COLUMNS, ENTRIES, STATES, BACK, SQUARES = (rows * LANES for rows in (3, 10, 4, 3, 5))
"""Of a segment, its transfer matrix, a state, a change of basis, and squares."""

# Rows of lanes that shapes are computed with.
OLD, NEW, BETA, GAMMA, SUMS = (row * LANES for row in range(5))
"""Terms of the series, its two factors, and four sums."""
INVERSE, SCALE, PER_MODE, UNIT = (row * LANES for row in (8, 9, 10, 11))
"""One over the unit of length, it, omega^2 of the mode, and four units of states."""
NODE, LEAST, X_OF, Y_OF, STARTS = (row * LANES for row in range(15, 20))
"""Where frames meet, how nearly, coefficients in a frame, and two to start with."""
FORMS_OF, PER_UNIT = 21 * LANES, 29 * LANES
"""Sums over a mode, by `riccati.lanes.modal.integrals`; and one over the units of states."""
WORK = 33 * LANES

# Columns of the samples of a search.
AT, BELOW, VALUE, SHIFT, CARRIED_FROM = range(5)
"""omega^2, count, characteristic function and its power of two; from there on what was carried."""
SAMPLE = CARRIED_FROM + CARRIED

# Columns of what a root asks for next.
FIRST, SECOND, BESIDE = range(3)
"""Two samples, and how far from the first another may stand (0: none)."""

# Rows of the steps of a beam.
START, SIZE, PHASE, STEEP = range(4)
"""Start and size as shares of the interval; and what is compared where they are halved."""

MOST_SAMPLES = 256, 64
"""Of a search, and more for every root."""

MOST_LEVELS = 7
"""How often a beam is solved, with steps halved each time."""

MOST_STEPS = 4096
"""Coarsest ones of a beam, and one for every interval."""

NO_POINTS, NO_MORE = np.empty((0, POINT)), np.empty((MORE, 0))


class Chain(NamedTuple):
    """One chain."""

    law: int
    """As `left` and `right`, by number (`riccati.lanes.laws`)."""
    left: int
    right: int
    length: Array
    """Of every segment, as are mass, stiffness and force (0 where a law has none), shape (n,)."""
    mass: Array
    stiffness: Array
    force: Array
    starts: Integers
    """First piece of every segment, shape (n + 1,); set when the table is filled."""
    marks: Integers
    """Which point stands at every node, -1 for none, shape (n + 1,)."""
    points: Array
    """Shape (points, POINT)."""
    more: Array
    """What segments have besides, shape (5, n); (5, 0) where they have nothing."""
    following: Array
    """What turns with the left and the right end, shape (2,): kappa (`riccati.following.ratio`)."""


class Scaled(NamedTuple):
    """Columns of a chain in the units of eight modes."""

    stiffness: Array
    """EI, as is alpha shape (n,)."""
    coupling: Array
    columns: Array
    """s, beta and mu: rows of lanes for every segment, as all below."""


class Room(NamedTuple):
    """What shapes of eight modes are computed in, with room for more segments than are used.

    By segment or node, each a flat row of lanes after another.
    """

    own: Scaled
    U: Array
    """Transfer matrices."""
    left: Array
    """Frames, as `right`, of every node; and what their changes of basis are undone by."""
    right: Array
    back_left: Array
    back_right: Array
    z: Array
    """States of every node."""
    squares: Array
    here: Array
    """States before and after a step through a matrix, and a frame."""
    there: Array
    step: Array
    frame: Array
    work: Array
    """By the rows above."""
    peaks: Array
    """Heights, places and segments of the highest ones of each lane."""
    largest: Array
    """Displacement of each lane at nodes."""
    factor: Array
    """That normalises each lane."""


class Rules(NamedTuple):
    """Rules of Gauss: shares of a segment and weights, and phases up to which each does."""

    limits: Array
    numbers: Integers
    shares: Array
    weights: Array


class Asked(NamedTuple):
    """What normalised modes are asked for."""

    beside: Array
    """rho I and 1/kGA that the columns leave out, shape (2, n)."""
    places: Array
    """Ascending, from the left end."""
    by_mass: bool
    """Whether their modal mass is one, or else their largest displacement."""


class Lanes(NamedTuple):
    """What one pass of eight omega^2 carries."""

    state: Array
    sign: Array
    """Of a where a node is held, to be compared behind it; 0 elsewhere."""
    value: Array
    """The characteristic function, when the pass is done."""


class Task(NamedTuple):
    """What is wanted of a search: eigenvalues below + 1 and on."""

    below: int
    width: float
    """Relative, of the brackets in omega^2."""
    certify: bool
    """Or else each is only enclosed, and predicted to a tenth of the width."""


class Roots(NamedTuple):
    """Consecutive eigenvalues that are searched."""

    omega2: Array
    """Guesses before, roots after."""
    slope: Array
    """Of the divided function, kept for the next chain; 0 where none is known."""
    low: Array
    high: Array
    counts: Integers
    """Eigenvalues below either end of the bracket, shape (roots, 2)."""
    rounding: Array


class Search(NamedTuple):
    """What a search keeps: its samples, what it asks for, and what each root knows."""

    samples: Array
    asked: Array
    owner: Integers
    """Of every sample asked for: the root that did, or -1."""
    before: Array
    """Width of the bracket at the last turn."""
    stuck: Integers
    """Turns since it halved."""
    at: Integers
    """Samples at the two ends of the bracket, shape (roots, 2)."""
    guess: Array
    """Where the roots were expected, ascending: it tells them apart where ends follow."""
    own: Integers
    """Samples the root asked for last, newest first, -1 for none, shape (roots, 4)."""
    wanted: Array
    requests: Integers
    certifies: Array
    near: Integers
    x: Array
    y: Array
    proof: Array
    """Where ends follow: where the line of the proof crosses the axis, what is left of g there, and
    its samples, shape (3,)."""


class Warmth(NamedTuple):
    """What one chain of a batch leaves to the next."""

    neighbour: Integers
    """The row solved before, or -1."""
    omega2: Array
    slope: Array
    weights: Array
    """Integrals of Y''^2, Y'^2 and Y^2 of given shapes over the segments, (3, shapes, n)."""
    quotient: Array
    """Rayleigh's quotients of these shapes: of this row, and of the one before."""


class Levels(NamedTuple):
    """A beam, its steps, its chain on each level, and its results."""

    x: Array
    mass: Array
    """As are stiffness and force: at both ends of every interval, shape (n, 2)."""
    stiffness: Array
    force: Array
    mass_left: Array
    varies: Integers
    """Whether anything does, for every interval."""
    first: Integers
    """First segment of every interval, shape (n + 1,)."""
    interval: Integers
    """Of every step."""
    steps: Array
    chain: Chain
    """With room for more segments than are used."""
    levels: Array
    """Roots, level by level."""
    roots: Roots
    better: Array
    """Extrapolated roots, and their errors."""
    error: Array
    omega2: Array
    """In SI, as are the errors and the brackets."""
    error_omega2: Array
    bracket: Array
    table: Array
    lanes: Lanes
    search: Search


class Interior(NamedTuple):
    """How a beam is held, and what it is like inside its intervals."""

    left: int
    right: int
    acceleration: float
    kappa_left: float
    """What turns with the ends [N]."""
    kappa_right: float
    logarithmic: bool
    steepest: float
    longest: float
    halvings: int


class Nodes(NamedTuple):
    """Points of a beam: their breakpoints, their numbers in SI, and room for dimensionless ones."""

    at: Integers
    points: Array
    scaled: Array


def _aligned(*shape: int) -> Array:
    """Return room that starts with a line of the processor's cache: as lanes do then."""
    size = math.prod(shape)
    room = np.zeros(size + LANES)
    start = -room.ctypes.data // 8 % LANES
    return room[start : start + size].reshape(shape)


def _side_by_side(**shapes: tuple[int, ...]) -> dict[str, Array]:
    """Return arrays of these shapes in one block, each aligned; nothing is set in them.

    A single block is given back, and had again, as a whole: pages of many that are given back one
    by one are new every time.
    """
    sizes = {name: -(-math.prod(shape) // LANES) * LANES for name, shape in shapes.items()}
    room = np.empty(sum(sizes.values()) + LANES)
    start, arrays = -room.ctypes.data // 8 % LANES, dict[str, Array]()
    for name, shape in shapes.items():
        arrays[name] = room[start : start + math.prod(shape)].reshape(shape)
        start += sizes[name]
    return arrays


def new_room(segments: int) -> Room:
    """Return room for shapes along so many segments.

    States and squares stand where the transfer matrices did: these are needed before alone.
    """
    n, nodes = segments, segments + 1
    of_chain = _side_by_side(stiffness=(n,), coupling=(n,), columns=(n, COLUMNS))
    arrays = _side_by_side(
        U=(n, ENTRIES),
        left=(nodes, 2, STATES),
        right=(nodes, 2, STATES),
        back_left=(nodes, BACK),
        back_right=(nodes, BACK),
        here=(STATES,),
        there=(STATES,),
        step=(ENTRIES,),
        frame=(2, STATES),
        work=(WORK,),
        peaks=(LANES, 4, 3),
        largest=(LANES,),
        factor=(LANES,),
    )
    later = arrays["U"].ravel()
    z = later[: nodes * STATES].reshape(nodes, STATES)
    squares = later[: n * SQUARES].reshape(n, SQUARES)
    return Room(own=Scaled(**of_chain), z=z, squares=squares, **arrays)


def new_lanes() -> Lanes:
    """Return room for a pass."""
    return Lanes(_aligned(STATE), _aligned(LANES), _aligned(LANES))


def new_roots(roots: int) -> Roots:
    """Return room for the roots of one chain."""
    omega2, slope, low, high, rounding = np.zeros((5, roots))
    return Roots(omega2, slope, low, high, np.zeros((roots, 2), np.int64), rounding)


def new_search(roots: int) -> Search:
    """Return room for a search."""
    most = MOST_SAMPLES[0] + MOST_SAMPLES[1] * roots
    return Search(
        samples=np.empty((most, SAMPLE)),
        asked=np.empty(most),
        owner=np.zeros(most, np.int64),
        before=np.zeros(roots),
        stuck=np.zeros(roots, np.int64),
        at=np.zeros((roots, 2), np.int64),
        guess=np.zeros(roots),
        own=np.zeros((roots, 4), np.int64),
        wanted=np.zeros((roots, 3)),
        requests=np.zeros(roots, np.int64),
        certifies=np.zeros(roots, np.bool_),
        near=np.zeros(4, np.int64),
        x=np.zeros(4),
        y=np.zeros(4),
        proof=np.zeros(3),
    )


def new_chain(law: int, left: int, right: int, segments: int, more: bool = False) -> Chain:
    """Return room for a chain without points."""
    marks = np.full(segments + 1, -1)
    starts = np.empty(segments + 1, np.int64)
    length, mass, stiffness, force = np.zeros((4, segments))
    besides = np.zeros((MORE, segments if more else 0))
    own = length, mass, stiffness, force, starts, marks, NO_POINTS, besides, np.zeros(2)
    return Chain(law, left, right, *own)


def new_levels(law: int, intervals: int, segments: int, table: Array, roots: int) -> Levels:
    """Return room for a beam of so many intervals, and for chains of up to so many segments."""
    steps, (mass, stiffness, force) = MOST_STEPS + intervals, np.empty((3, intervals, 2))
    return Levels(
        x=np.empty(intervals + 1),
        mass=mass,
        stiffness=stiffness,
        force=force,
        mass_left=np.zeros(intervals + 1),
        varies=np.empty(intervals, np.int64),
        first=np.empty(intervals + 1, np.int64),
        interval=np.empty(steps, np.int64),
        steps=np.empty((4, steps)),
        chain=new_chain(law, 0, 0, segments),
        levels=np.empty((MOST_LEVELS, roots)),
        roots=new_roots(roots),
        better=np.empty(roots),
        error=np.empty(roots),
        omega2=np.empty(roots),
        error_omega2=np.empty(roots),
        bracket=np.empty((roots, 2)),
        table=table,
        lanes=new_lanes(),
        search=new_search(roots),
    )
