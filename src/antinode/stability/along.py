"""Changes of stability along any number that a beam depends on, up to the first flutter.

The number need not be a factor on the axial force: nothing is known of how the beam depends on it.
All modes are solved at even values. Between neighbours with another number of modes that grow, the
change is halved until it is alone, and closed in on by what is smooth there: omega^2 of a mode
that diverges, the squared distance of two that meet, or the growth of one that is damped. Either
side of its bracket is solved by itself.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from antinode.arrays import Array
from antinode.beam.attachments import feeds_back, is_damped
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.errors import AntinodeError, ComputationError
from antinode.modes.backends import Backend, choose, for_one
from antinode.modes.damped.family import on_refinement
from antinode.modes.damped.modes import kind_of as mode_kind
from antinode.modes.damped.modes import names_in
from antinode.modes.refinement import Refinement, layer_length, varying_segments

from .crossing import Change, Kind, Root, States, Told, kind_of, measure, names_of
from .states import Watcher

BeamOf = Callable[[float], Beam]
"""A beam for each value of a number."""

_MODES = 6
_REFINEMENT = 2
_EVALUATIONS = 60
_MOST_SEGMENTS = 20_000
_TOLERANCE = 1e-8
_WIDTH = 1e-9  # of the bracket, over the range
_WIDEST = 1e-5
_TOGETHER = 1e-7  # width at which changes that were not told apart stay together


@dataclass(frozen=True)
class CriticalValue:
    """A value at which the stability of a beam changes.

    Attributes
    ----------
    kind : {"flutter", "divergence"}
    value : float
        In SI.
    bracket : tuple of float
        On its two sides the numbers of unstable modes differ.
    frequency_hz : float
        With which it begins to oscillate [Hz]; 0 where it diverges.
    modes : tuple of str
        Which, as they are named before the change.
    change : {"lost", "regained"}
        By a rising value.
    unstable : tuple of int
        Modes that diverge or flutter on both sides.
    proven : bool
        Whether the lists of modes on both sides are proven complete.
    """

    kind: Kind
    value: float
    bracket: tuple[float, float]
    frequency_hz: float
    modes: tuple[str, ...]
    change: Told
    unstable: tuple[int, int]
    proven: bool

    def to_dict(self) -> dict[str, object]:
        """Return it as plain numbers for JSON."""
        return {
            "kind": self.kind,
            "value": self.value,
            "bracket": list(self.bracket),
            "frequency_hz": self.frequency_hz,
            "modes": list(self.modes),
            "change": self.change,
            "unstable": list(self.unstable),
            "proven": self.proven,
        }


@dataclass(frozen=True)
class Followed:
    """What was found along a number.

    Attributes
    ----------
    critical : tuple of CriticalValue
    reach : float
        How far it was looked: to the first flutter, where there is one.
    unstable : int
        Modes that are unstable where it begins.
    values : array, shape (values,)
        All at which modes were solved: dense beside each change.
    roots : tuple of tuple of Root
        At each of them.
    solved : int
        How often all modes were solved.
    warnings : tuple of str
    """

    critical: tuple[CriticalValue, ...]
    reach: float
    unstable: int
    values: Array
    roots: tuple[tuple[Root, ...], ...] = field(repr=False)
    solved: int
    warnings: tuple[str, ...]


def follow(
    beam_of: BeamOf, low: float, high: float, *, points: int = 33, dampers: bool = True
) -> Followed:
    """Find every change of stability from one value to another, up to the first flutter.

    Parameters
    ----------
    beam_of : callable
    low, high : float
        Finite, low < high.
    points : int
        Even values at which modes are solved first; changes that undo each other in between are
        not seen.
    dampers : bool
        Whether dashpots and loss factors count.

    Raises
    ------
    AntinodeError
        If there is no beam, or no modes of it, at the first value.
    """
    solver = _Solver(beam_of, low, high - low, dampers)
    values = np.linspace(low, high, points).tolist()
    first = solver.at(values[0])
    critical: list[CriticalValue] = []
    reach, told = values[0], list[str]()
    for a, b in pairwise(values):
        try:
            found = [*_between(solver, a, b, told)]
        except AntinodeError as error:
            told.append(f"no further than {a:g}: {error}")
            break
        critical += found
        reach = b
        flutter = [each.kind == "flutter" and each.change == "lost" for each in critical]
        if any(flutter):
            critical = critical[: 1 + flutter.index(True)]
            reach = critical[-1].bracket[1]
            break
    seen = sorted(value for value in solver.solved if value <= reach)
    unproven = sum(not state.proven for state in solver.solved.values())
    if unproven:
        told.append(
            f"at {unproven} of {len(solver.solved)} values it is not proven that all modes were "
            "found"
        )
    roots = tuple(solver.solved[value].roots for value in seen)
    return Followed(
        tuple(critical),
        reach,
        first.unstable,
        np.array(seen),
        roots,
        len(solver.solved),
        tuple(told),
    )


class _Solver:
    """The eigenvalues of a beam at any value, on chains of one refinement, each solved once."""

    def __init__(
        self, beam_of: BeamOf, low: float, span: float, dampers: bool, refinement: int = _REFINEMENT
    ) -> None:
        self.beam_of, self.low, self.span = beam_of, low, span
        self.dampers, self.refinement = dampers, refinement
        self.solved: dict[float, States] = {}

    @property
    def finer(self) -> _Solver:
        """The same on chains of half the steps."""
        return _Solver(self.beam_of, self.low, self.span, self.dampers, 2 * self.refinement)

    def at(self, value: float) -> States:
        """Return the eigenvalues at a value."""
        if value not in self.solved:
            beam = self.beam_of(value)
            segments = len(beam.chain(BENDING, self.refinement).length)
            backend = choose(for_one(segments, _EVALUATIONS))
            damped = feeds_back(beam.attachments, BENDING) or (self.dampers and is_lossy(beam))
            of = _complex if damped else _conservative
            self.solved[value] = of(beam, value, self.refinement, backend, self.dampers)
        return self.solved[value]


def is_lossy(beam: Beam) -> bool:
    """Tell whether dashpots or loss factors act on a beam in bending."""
    lossy = beam.loss_factor is not None and bool(np.any(beam.loss_factor))
    return lossy or is_damped(beam.attachments, BENDING)


def _complex(beam: Beam, value: float, refinement: int, backend: Backend, dampers: bool) -> States:
    """Return eigenvalues s with all that damps and feeds back."""
    found = on_refinement(beam, refinement, _MODES, backend, dampers=dampers)
    names = [name for name, _ in names_in(beam, found)]
    rows = zip(names, found.eigenvalues, strict=True)
    roots = tuple(Root(n, v.s, v.error, mode_kind(v.s, v.error)) for n, v in rows)
    return States(value, roots, found.certificate["kind"] != "none")


def _conservative(
    beam: Beam, value: float, refinement: int, backend: Backend, dampers: bool
) -> States:
    """Return eigenvalues s from those of omega^2: no energy is lost but by what follows."""
    watcher = Watcher(beam, backend, refinement, _MODES)
    state, roots = watcher.at(1.0), list[Root]()
    for name, omega2 in zip(watcher.names, state.real.tolist(), strict=False):
        s = complex(0, math.sqrt(omega2)) if omega2 > 0 else complex(math.sqrt(-omega2))
        roots.append(Root(name, s, 0.0, "elastic" if omega2 > 0 else "divergent"))
    for k, omega2 in enumerate(state.pairs.tolist()):
        s, name = cmath.sqrt(-omega2), watcher.names[len(state.real) + k]
        grown = complex(abs(s.real), abs(s.imag))
        roots.append(Root(name, grown, 0.0, "flutter"))
        roots.append(Root(name, complex(-grown.real, grown.imag), 0.0, "elastic"))
    return States(value, tuple(roots), state.proven)


def _between(solver: _Solver, a: float, b: float, told: list[str]) -> list[CriticalValue]:
    """Return the changes between two values, one by one."""
    before, after = solver.at(a), solver.at(b)
    if before.status == after.status:
        return []
    change = kind_of(before, after)
    root = None if change is None else _root(solver, change)
    if change is not None and root is not None:
        return [_sharpened(solver, change, root, told)]
    middle = (a + b) / 2
    if b - a < _TOGETHER * solver.span or not a < middle < b:
        kind: Kind = "flutter" if before.status[1] != after.status[1] else "divergence"
        return [_critical(Change(before, after, kind), before, after)]
    return [*_between(solver, a, middle, told), *_between(solver, middle, b, told)]


def _root(solver: _Solver, change: Change) -> float | None:
    """Return where a change happens on chains of one refinement; None if others are beside it."""
    from scipy.optimize import brentq

    known = change.before.status, change.after.status

    def smooth(value: float) -> float:
        state = solver.at(value)
        if state.status not in known:
            raise ComputationError("another change beside it")
        return measure(change, state)

    a, b = change.before.value, change.after.value
    try:
        return float(brentq(smooth, a, b, xtol=0.1 * _WIDTH * solver.span, rtol=1e-14))
    except (ComputationError, ValueError):
        return None


def _sharpened(solver: _Solver, change: Change, root: float, told: list[str]) -> CriticalValue:
    """Return a change on ever finer chains, extrapolated, in a bracket that is proven."""
    beam, finest = solver.beam_of(root), solver
    levels = Refinement(_TOLERANCE / 2, coarse=1e-13)
    value, error = root, 0.0
    while np.any(beam.varies(BENDING)):
        chain = beam.chain(BENDING, finest.refinement)
        layer = layer_length(chain, varying_segments(beam, chain))
        levels.add(np.array([1 + (root - solver.low) / solver.span]), layer)
        value = solver.low + solver.span * (float(levels.better[0]) - 1)
        error = solver.span * float(levels.error[0])
        if levels.met(levels.error):
            break
        if 2 * len(chain.length) > _MOST_SEGMENTS:
            told.append(
                f"{len(chain.length)} segments do not reach the tolerance {_TOLERANCE:g} at "
                f"{root:g}; see the bracket"
            )
            break
        finest = finest.finer
        again = _again(finest, change, root)
        if again is None:
            told.append(f"finer chains tell the change at {root:g} otherwise; see the bracket")
            return _critical(change, change.before, change.after)
        root = again
    return _proven(finest, change, root, value, error)


def _again(finer: _Solver, change: Change, root: float) -> float | None:
    """Return the root on finer chains, near to that of coarser ones."""
    a, b = change.before.value, change.after.value
    half = 1e-4 * finer.span
    while half < b - a:
        low, high = max(root - half, a), min(root + half, b)
        near = Change(finer.at(low), finer.at(high), change.kind)
        if near.before.status == change.before.status and near.after.status == change.after.status:
            return _root(finer, near)
        half *= 10
    return None


def _proven(
    finest: _Solver, change: Change, root: float, value: float, error: float
) -> CriticalValue:
    """Return a change in a bracket that reaches over its error, solved on both sides."""
    half = _WIDTH * finest.span / 2
    while half <= _WIDEST * finest.span:
        low, high = min(root, value - error) - half, max(root, value + error) + half
        before, after = finest.at(low), finest.at(high)
        if before.status == change.before.status and after.status == change.after.status:
            return _critical(Change(before, after, change.kind), before, after, value)
        half *= 4
    return _critical(change, change.before, change.after)


def _critical(
    change: Change, before: States, after: States, value: float | None = None
) -> CriticalValue:
    flutter = change.kind == "flutter" and bool(change.more.fluttering)
    return CriticalValue(
        kind=change.kind,
        value=(before.value + after.value) / 2 if value is None else value,
        bracket=(before.value, after.value),
        frequency_hz=change.more.fluttering[0].s.imag / (2 * math.pi) if flutter else 0.0,
        modes=names_of(change),
        change="lost" if change.more is change.after else "regained",
        unstable=(before.unstable, after.unstable),
        proven=before.proven and after.proven,
    )
