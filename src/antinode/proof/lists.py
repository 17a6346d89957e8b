"""Whether a list of eigenvalues is all that a circle holds, each where it is said to be."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from antinode.extras import import_extra

from .disc import Disc, UndecidedError
from .function import Characteristic

Verdict = Literal["proven", "refuted", "undecided"]

_BITS = 160, 320, 640, 1280
_ZERO = 1e-3  # of the smallest other eigenvalue: the circle about z = 0


@dataclass(frozen=True)
class Listed:
    """An eigenvalue as it is listed: its name, and a circle that is said to hold it."""

    name: str
    z: complex
    radius: float


@dataclass(frozen=True)
class Outcome:
    """What balls say about a list.

    Attributes
    ----------
    verdict : {"proven", "refuted", "undecided"}
    reason : str
        Why it is not proven; empty where it is.
    eigenvalues : int
        That the circle holds; -1 where it is not known.
    precision_bits, arcs : int
    """

    verdict: Verdict
    reason: str
    eigenvalues: int
    precision_bits: int
    arcs: int


def prove_list(
    make: Callable[[], Characteristic],
    centre: float,
    radius: float,
    listed: Sequence[Listed],
    zeros: int = 0,
) -> Outcome:
    """Prove that a circle holds the eigenvalues of a list, in the circles that it states.

    Parameters
    ----------
    make : callable
        Makes D(z) at the precision that holds.
    centre, radius : float
        Of the circle; its centre is real.
    listed : sequence of Listed
        Conjugates too. Those whose circles overlap are proven together.
    zeros : int
        How often z = 0 is an eigenvalue.
    """
    groups = _groups([*listed, *_at_zero(listed, zeros, radius)])
    outside = [g for g in groups if abs(g[1] - centre) + g[2] >= radius]
    if outside:
        return Outcome("undecided", f"{outside[0][0]} is not within the region", -1, 0, 0)
    flint = import_extra("flint", "prove")
    bits = 0
    for accuracy in _BITS:
        try:
            disc = Disc(make, flint, centre, radius, accuracy)
            bits = disc.bits
            return _compared(disc, groups)
        except UndecidedError:
            continue
    reason = "balls stay too wide to tell: an eigenvalue is too close to the edge of a circle"
    return Outcome("undecided", reason, -1, bits, 0)


_Group = tuple[str, complex, float, int]


def _compared(disc: Disc, groups: list[_Group]) -> Outcome:
    """Count within every circle, and within all."""
    edge = disc.zeros()
    arcs, wanted = edge.arcs, sum(g[3] for g in groups)

    def no(reason: str) -> Outcome:
        return Outcome("refuted", reason, edge.zeros, disc.bits, arcs)

    for name, z, radius, number in groups:
        own = disc.zeros(z, radius)
        arcs += own.arcs
        if own.zeros != number:
            return no(
                f"the circle of radius {radius:.3g} about {_number(z)} that is stated for {name} "
                f"holds {own.zeros} of them, not {number}"
            )
    if edge.zeros != wanted:
        return no(f"the region holds {edge.zeros} of them, and the list has {wanted}")
    return Outcome("proven", "", edge.zeros, disc.bits, arcs)


def _number(z: complex) -> str:
    return f"{z:.10g}" if z.imag else f"{z.real:.10g}"


def _at_zero(listed: Sequence[Listed], zeros: int, radius: float) -> list[Listed]:
    """Return z = 0 as often as it is one, with a circle that is small beside all others."""
    least = min([radius, *(abs(v.z) - v.radius for v in listed)])
    return [Listed("s = 0", 0j, _ZERO * max(least, 0.0))] * zeros


def _groups(listed: Sequence[Listed]) -> list[_Group]:
    """Return circles that do not overlap, and how many eigenvalues each is to hold."""
    groups: list[_Group] = []
    for value in listed:
        new: _Group = value.name, complex(value.z), value.radius, 1
        while True:
            met = next((g for g in groups if abs(g[1] - new[1]) <= 1.01 * (g[2] + new[2])), None)
            if met is None:
                break
            groups.remove(met)
            new = _joined(met, new)
        groups.append(new)
    return groups


def _joined(a: _Group, b: _Group) -> _Group:
    """Return a circle around two, with what both hold."""
    name = a[0] if b[0] in a[0].split(" and ") else f"{a[0]} and {b[0]}"
    middle: Any = (a[1] + b[1]) / 2
    reach = max(abs(a[1] - middle) + a[2], abs(b[1] - middle) + b[2])
    return name, middle, 1.000001 * reach, a[3] + b[3]
