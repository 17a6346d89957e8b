"""One pass of eight omega^2 from the left end of a chain to its right one."""

# mypy: disable-error-code="no-untyped-def"

from __future__ import annotations

import math

from . import laws
from .compiling import compiled
from .workspace import CARRIED, COUNT, LANES, OMEGA2, POWER, A

_RESCALE = 128  # pieces after which the lanes are scaled
_SMALL = 1e-60  # of what is carried, or 1 over it: what lies between is not scaled


@compiled
def _rescale(state):
    """Take a power of two out of a lane that grows large or small."""
    for lane in range(LANES):
        size = 0.0
        for row in range(CARRIED):
            size = max(size, abs(state[LANES * row + lane]))
        if _SMALL < size < 1.0 / _SMALL:
            continue
        power = math.frexp(size)[1]
        for row in range(CARRIED):
            state[LANES * row + lane] = math.ldexp(state[LANES * row + lane], -power)
        state[POWER + lane] += power


@compiled
def _stretch(law, table, lanes, first, last):
    """Carry the lanes from one point to the next; behind a held node signs are compared."""
    state, sign, held = lanes.state, lanes.sign, False
    if first == last:
        return
    for lane in range(LANES):
        held = held or sign[lane] != 0.0
    if held:
        laws.advance(law, table, state, first, first + 1)
        for lane in range(LANES):
            state[COUNT + lane] += 1.0 if sign[lane] * state[A + lane] < 0.0 else 0.0
            sign[lane] = 0.0
        first += 1
    while last - first > _RESCALE:
        laws.advance(law, table, state, first, first + _RESCALE)
        _rescale(state)
        first += _RESCALE
    laws.advance(law, table, state, first, last)
    laws.to_chain_units(law, table, last - 1, state)


@compiled
def pass_chain(chain, table, lanes):
    """Pass a chain from left to right."""
    starts, marks = chain.starts, chain.marks
    laws.start(chain, lanes)
    first, n = 0, len(chain.length)
    for node in range(n if len(chain.points) == 0 else 0, n + 1):
        if marks[node] < 0 and node < n:
            continue
        _stretch(chain.law, table, lanes, first, starts[node])
        first = starts[node]
        if marks[node] >= 0:
            laws.pass_point(chain.law, chain.points[marks[node]], lanes)
            _rescale(lanes.state)
    _rescale(lanes.state)
    laws.finish(chain, lanes)


@compiled
def evaluate(chain, omega2, table, lanes, count, value):
    """Evaluate a chain at any number of omega^2."""
    for first in range(0, len(omega2), LANES):
        for lane in range(LANES):
            lanes.state[OMEGA2 + lane] = omega2[min(first + lane, len(omega2) - 1)]
        pass_chain(chain, table, lanes)
        for lane in range(min(LANES, len(omega2) - first)):
            count[first + lane] = int(lanes.state[COUNT + lane])
            value[first + lane] = lanes.value[lane]


@compiled
def repeat(chain, table, lanes, last, times):
    """Pass the pieces of a chain a number of times: to be timed."""
    for _ in range(times):
        laws.start(chain, lanes)
        laws.advance(chain.law, table, lanes.state, 0, last)
