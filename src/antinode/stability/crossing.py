"""One change of stability between two lists of eigenvalues: its kind, what is smooth, and who."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, NamedTuple

Kind = Literal["flutter", "divergence"]
Told = Literal["lost", "regained"]


class Root(NamedTuple):
    """An eigenvalue with Im s >= 0.

    Attributes
    ----------
    name : str
    s : complex
        [1/s].
    error : float
    kind : str
        As of a `Mode`.
    """

    name: str
    s: complex
    error: float
    kind: str

    @property
    def omega2(self) -> float:
        """(Im s)^2, or -s^2 of what does not oscillate [rad^2/s^2]."""
        return self.s.imag**2 if self.s.imag else -(self.s.real**2)


@dataclass(frozen=True)
class States:
    """All eigenvalues at one value.

    Attributes
    ----------
    value : float
    roots : tuple of Root
    proven : bool
        Whether they are proven to be all.
    """

    value: float
    roots: tuple[Root, ...]
    proven: bool

    @property
    def status(self) -> tuple[int, int]:
        """How many diverge, and how many flutter."""
        kinds = [root.kind for root in self.roots]
        return kinds.count("divergent"), kinds.count("flutter")

    @property
    def unstable(self) -> int:
        """Motions that grow."""
        return sum(self.status)

    @property
    def steady(self) -> list[Root]:
        """Those that neither grow nor decay: they stand on the imaginary axis."""
        return [r for r in self.roots if r.s.imag and abs(r.s.real) <= r.error]

    @property
    def fluttering(self) -> list[Root]:
        """Those that oscillate and grow, the slowest first."""
        return sorted((r for r in self.roots if r.kind == "flutter"), key=lambda r: r.s.real)


@dataclass(frozen=True)
class Change:
    """A change of one eigenvalue, or of two that meet, between two lists."""

    before: States
    after: States
    kind: Kind

    @property
    def more(self) -> States:
        """The side on which more grows."""
        return max(self.before, self.after, key=lambda s: (s.unstable, s.status[1]))

    @property
    def less(self) -> States:
        """The other side."""
        return self.before if self.more is self.after else self.after

    @property
    def conserves(self) -> bool:
        """Whether what begins to flutter has a twin that decays as fast: two that have met."""
        return any(
            any(abs(r.s + root.s.conjugate()) <= r.error + root.error for r in self.more.roots)
            for root in self.more.fluttering[:1]
        )


def kind_of(before: States, after: States) -> Change | None:
    """Return the change if it is one alone."""
    diverging = after.status[0] - before.status[0]
    fluttering = after.status[1] - before.status[1]
    if fluttering == 0 and abs(diverging) == 1:
        return Change(before, after, "divergence")
    if abs(fluttering) == 1 and diverging in (0, -2 * fluttering):
        return Change(before, after, "flutter")
    return None


def measure(change: Change, state: States) -> float:
    """Return what changes its sign with the status: positive before, negative after.

    Of a divergence omega^2, or s times the next real one; of two modes that meet the square of the
    distance of their s^2; of a mode that is damped its growth.
    """
    grown = state.status == change.more.status
    sign = 1.0 if state.status == change.before.status else -1.0
    if change.kind == "divergence":
        return sign * _near_zero(change, state, grown)
    if not change.conserves:
        return sign * _growth(change, state)
    if grown:
        return sign * min(4 * (r.s * r.s).imag ** 2 for r in state.fluttering)
    low, high = _meeting(change, state)
    return sign * (high.omega2 - low.omega2) ** 2


def _near_zero(change: Change, state: States, grown: bool) -> float:
    """Return what vanishes with the motion that has just begun to diverge, or is about to.

    ``s^2`` where it comes from two that oscillate; where it is damped, its s times that of the
    real one that it has met: the two together move smoothly, before they meet as a pair as well.
    """
    rows = [r for r in state.roots if (r.kind == "divergent") == grown]
    if not rows:
        return 1.0
    own = min(rows, key=lambda r: abs(r.s))
    if own.s.imag:
        return abs(own.s) ** 2
    others = [abs(r.s) for r in state.roots if r is not own and r.s.imag == 0]
    damped = any(r.kind == "overdamped" for r in (*change.before.roots, *change.after.roots))
    return abs(own.s) * (min(others, default=1.0) if damped else abs(own.s))


def _growth(change: Change, state: States) -> float:
    """Return abs(Re s) of what is nearest to that which grows least."""
    target = change.more.fluttering[0].s
    rows = [r for r in state.roots if r.s.imag]
    near = min(rows, key=lambda r: abs(r.s - target), default=None)
    return 1.0 if near is None else abs(near.s.real)


def _meeting(change: Change, state: States) -> tuple[Root, Root]:
    """Return the two neighbours, among all that neither grow nor decay, that are about to meet."""
    s = min((r.s for r in change.more.fluttering), key=lambda s: abs((s * s).imag))
    steady = sorted(state.steady, key=lambda r: r.omega2)
    if change.more.status[0] < change.less.status[0]:  # two that diverge
        steady = sorted((r for r in state.roots if r.kind == "divergent"), key=lambda r: r.omega2)
    pairs = pairwise(steady)
    return min(pairs, key=lambda two: abs(two[0].omega2 + two[1].omega2 + 2 * (s * s).real))


def names_of(change: Change) -> tuple[str, ...]:
    """Return which modes change, as the stable side names them."""
    if change.kind == "divergence":
        least = min((r for r in change.more.roots if r.kind == "divergent"), key=lambda r: r.s.real)
        return (least.name,)
    if not change.conserves:
        return (change.more.fluttering[0].name,)
    try:
        return tuple(root.name for root in _meeting(change, change.less))
    except ValueError:
        return (change.more.fluttering[0].name,)
