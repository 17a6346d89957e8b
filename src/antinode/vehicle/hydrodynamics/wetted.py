"""The wetted surface of the afterbody: where the body's circle stands out of the cavity's.

At x the circles have the radii R and R_c and centres ``offset`` apart. The angle of the body
outside is ``2 arccos(-c)``, ``c = (R^2 - R_c^2 + offset^2) / (2 R abs(offset))`` kept within -1
and 1. Aft of the cavity's middle A_w is the integral of R times the angle, x_P its centroid, L_w
the length on which the angle is not zero; across the chord if the model says so.

Many bodies are laid out as one list of pieces, cut at their stations, at the closure, and where
wetting begins (``abs(offset) + R = R_c``) or goes all round (``abs(R - abs(offset)) = R_c``). Those
that a bound shows to be inside the cavity are left out before that; those behind the closure are
wet all round. Each other piece takes 16 Gauss points that crowd at its ends, where the angle starts
like a square root.

Source: "Analysis of the Natural Vibration Characteristics of a Supercavitating Underwater Vehicle
Considering Hydrodynamic Conditions", eq. 16, with the area as docs/theory/hydrodynamics.md has it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.beam.profile import Profile

from .cavity import Cavity
from .course import Course
from .roots import find_roots

_SAMPLES, _FEWEST = 256, 8  # places along the body, and on every piece, between which contacts lie
_ROUNDING = 1e-12  # of the radius
_BLOCK = 2**15  # numbers that are worked on at a time
_NO_DISTANCE = np.finfo(float).tiny / np.finfo(float).eps
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_S = (_NODES + 1) / 2
_T, _DT = (_S**2 * (3 - 2 * _S))[:, None], (3 * _S * (1 - _S) * _WEIGHTS)[:, None]
"""Gauss nodes and weights on 0...1, drawn to the ends."""


class WettedSurface(NamedTuple):
    """Wetted part of the body aft of the cavity's middle, of each case.

    Attributes
    ----------
    length, area : array (cases,)
        L_w [m] and A_w [m^2].
    centroid : array (cases,)
        x of the centroid x_P [m]; the tail if nothing is wet.
    """

    length: Array
    area: Array
    centroid: Array


def wet_angle(R: Any, R_c: Any, offset: Any) -> Any:
    """Angle of the body circle that stands out of the cavity circle [rad], from 0 to 2 pi.

    Parameters
    ----------
    R : array_like
        Radius of the body [m].
    R_c : array_like
        Radius of the cavity [m].
    offset : array_like
        Distance between the centres, of either sign [m].
    """
    d, most = np.maximum(np.abs(offset), _NO_DISTANCE), 2 * R
    cosine = np.asarray(R_c * R_c - R * R - d * d) / d
    cosine = np.minimum(np.maximum(cosine, -most), most)
    cosine /= most
    return 2 * np.arccos(cosine)


def wetted_width(R: Any, angle: Any, area: str) -> Any:
    """Width of the wetted surface across the body [m].

    Parameters
    ----------
    R : array_like
        Radius of the body [m].
    angle : array_like
        Angle of the body circle outside the cavity [rad], from 0 to 2 pi.
    area : {"arc", "projected"}
        Along the arc, or its chord, which from half a circle on is the diameter.
    """
    if area == "arc":
        return R * angle
    return 2 * R * np.sin(np.minimum(angle, math.pi) / 2)


@dataclass(frozen=True)
class _Pieces:
    """Pieces of many bodies in one list, those of each body from the nose aft.

    Attributes
    ----------
    case : array of int (pieces,)
        Whose they are.
    start, end : array (pieces,)
        [m].
    course : Course
        The cavity along every piece.
    line : array (2, pieces)
        The body's radius along every piece: at x = 0 [m], and its slope.
    """

    case: Integers
    start: Array
    end: Array
    course: Course
    line: Array

    def take(self, rows: Any) -> _Pieces:
        """Return some of the pieces, perhaps several times."""
        along = self.line[:, rows] if isinstance(rows, slice) else np.take(self.line, rows, axis=1)
        case, start, end = self.case[rows], self.start[rows], self.end[rows]
        return _Pieces(case, start, end, self.course.take(rows), along)

    def radius(self, x: Array) -> Array:
        """Return R at places on every piece, (..., pieces) [m]."""
        nose, slope = self.line
        found = x * slope
        found += nose
        return np.asarray(found)

    def circles(self, x: Array) -> tuple[Array, Array, Array]:
        """Return R, R_c and the distance between the centres at places ahead of closures [m]."""
        offset = self.course.axis_ahead(x)
        return self.radius(x), self.course.radius_ahead(x), np.abs(offset, out=offset)

    @property
    def width(self) -> Array:
        """Length of every piece [m]."""
        return self.end - self.start


def _outside(R: Array, R_c: Array, d: Array) -> Array:
    """Positive where some of the body's circle is outside the cavity's."""
    return d + R - R_c


def _around(R: Array, R_c: Array, d: Array) -> Array:
    """Positive where the whole of the body's circle is, or has the cavity's within it."""
    return np.abs(R - d) - R_c


def wetted_surface(cavities: Cavity, body: Profile) -> WettedSurface:
    """Integrate the wetted surfaces from the cavities' middles to the tail.

    Parameters
    ----------
    cavities : Cavity
        The cavities, their numbers arrays (cases,).
    body : Profile
        Radius of the body, the same for all cases [m]; linear on every interval.
    """
    cases, tail, form = len(cavities.L_c), float(body.x[-1]), cavities.model.planing_area
    ahead, behind = _wet_pieces(cavities, body)
    blocks = [_integrals(ahead.take(block), form) for block in _blocks(ahead, len(_T))]
    case = np.concatenate([ahead.case, behind.case])
    parts = [(ahead.width, *map(np.concatenate, zip(*blocks, strict=True)))]
    parts.append((behind.width, *_all_round(behind, form)))
    length, area, moment = (
        np.bincount(case, np.concatenate(each), minlength=cases).astype(float)
        for each in zip(*parts, strict=True)
    )
    wet = area > 0
    centroid = np.where(wet, moment / np.where(wet, area, 1.0), tail)
    return WettedSurface(np.where(wet, length, 0.0), area, centroid)


def wet_integral(cavities: Cavity, body: Profile, strip: Callable[[Array, Array], Array]) -> Array:
    """Integrate what a strip of the wetted part carries, from the cavities' middles to the tail.

    Parameters
    ----------
    cavities : Cavity
        The cavities, their numbers arrays (cases,).
    body : Profile
        Radius of the body, the same for all cases [m]; linear on every interval.
    strip : callable
        Per length, of the body's radius [m] and the angle of its circle that is wet [rad].
    """
    total = np.zeros(len(cavities.L_c))
    ahead, behind = _wet_pieces(cavities, body)
    for pieces, round_ in ((ahead, False), (behind, True)):
        for block in _blocks(pieces, len(_T)):
            some = pieces.take(block)
            x = some.start + some.width * _T
            R = some.radius(x)
            angle = np.full(x.shape, 2 * math.pi) if round_ else wet_angle(*some.circles(x))
            strips = reduce(np.add, some.width * _DT * strip(R, angle))
            total += np.bincount(some.case, strips, minlength=len(total))
    return total


def _wet_pieces(cavities: Cavity, body: Profile) -> tuple[_Pieces, _Pieces]:
    """Return the pieces of many bodies that are wet, ahead of the closures and behind them."""
    pieces = _pieces(cavities.course, body)
    is_behind = pieces.start >= pieces.course.closure
    behind = pieces.take(np.flatnonzero(is_behind))
    ahead = pieces.take(np.flatnonzero(~(is_behind | _is_dry(pieces))))
    ahead = _split_at_contacts(ahead, max(_FEWEST, -(-_SAMPLES // (len(body.x) - 1))))
    middle = ahead.start + ahead.width / 2
    return ahead.take(np.flatnonzero(_outside(*ahead.circles(middle)) > 0)), behind


def _is_dry(pieces: _Pieces) -> npt.NDArray[np.bool_]:
    """Tell which pieces are inside the cavity from end to end, by more than rounding."""
    R = pieces.radius(pieces.start), pieces.radius(pieces.end)
    bound = pieces.course.protrusion_bound(pieces.start, pieces.end, *R)
    return np.asarray(bound < -_ROUNDING * np.maximum(*R))


def _blocks(pieces: _Pieces, points: int) -> list[slice]:
    """Divide pieces with so many points each into blocks that stay near the processor."""
    size = max(1, _BLOCK // points)
    return [slice(k, k + size) for k in range(0, max(1, len(pieces.start)), size)]


def _integrals(pieces: _Pieces, form: str) -> tuple[Array, Array]:
    """Return wetted area and its first moment about the nose of every piece."""
    x = pieces.start + pieces.width * _T
    R, R_c, d = pieces.circles(x)
    angle = wet_angle(R, R_c, d)
    strips = pieces.width * _DT * wetted_width(R, angle, form)
    return reduce(np.add, strips), reduce(np.add, strips * x)


def _all_round(pieces: _Pieces, form: str) -> tuple[Array, Array]:
    """Return the same of pieces behind the closure, which are wet all round: R runs straight."""
    around = wetted_width(1.0, 2 * math.pi, form) * pieces.width
    (a, b), (R, S) = (pieces.start, pieces.end), map(pieces.radius, (pieces.start, pieces.end))
    return around * (R + S) / 2, around * (R * (2 * a + b) + S * (a + 2 * b)) / 6


def _pieces(cavities: Course, body: Profile) -> _Pieces:
    """Cut every body at its stations and at the closure, from the cavity's middle on."""
    low, high = body.x[:-1, None], body.x[1:, None]
    closure = cavities.closure
    start = np.maximum(low, closure / 2)
    interval, case = np.nonzero((start < high) & np.isfinite(closure))
    start, end, closure = start[interval, case], body.x[interval + 1], closure[case]
    slope = (body.ends[:, 1] - body.ends[:, 0]) / np.diff(body.x)
    line = np.stack([body.ends[:, 0] - slope * body.x[:-1], slope])
    closes = np.flatnonzero((closure > start) & (closure < end))
    pieces = _Pieces(case, start, end, cavities.take(case), np.take(line, interval, axis=1))
    return _cut(pieces, closes, closure[closes])


def _cut(pieces: _Pieces, which: Integers, x: Array) -> _Pieces:
    """Cut some pieces, perhaps several times, at places within them."""
    if not len(which):
        return pieces
    order = np.lexsort((x, which))
    which, x = which[order], x[order]
    start, end = np.insert(pieces.start, which + 1, x), np.insert(pieces.end, which, x)
    piece = np.insert(np.arange(len(pieces.start)), which + 1, which)
    return replace(pieces.take(piece), start=start, end=end)


def _split_at_contacts(pieces: _Pieces, count: int) -> _Pieces:
    """Cut pieces where wetting starts or ends, and where the body leaves the cavity wholly.

    Contacts are looked for between so many even places on every piece.
    """
    t = np.clip(np.linspace(0, 1, count + 1), 1e-12, 1 - 1e-12)[:, None]
    found = [_brackets(pieces, block, t) for block in _blocks(pieces, len(t))]
    which, low, high, around = (np.concatenate(each) for each in zip(*found, strict=True))
    touched = pieces.take(which)

    def gap(x: Array, rows: Integers) -> Array:
        R, R_c, d = (touched if len(rows) == len(which) else touched.take(rows)).circles(x)
        return np.where(around[rows], _around(R, R_c, d), _outside(R, R_c, d))

    return _cut(pieces, which, find_roots(gap, low, high))


def _brackets(pieces: _Pieces, block: slice, t: Array) -> tuple[Integers, Array, Array, Any]:
    """Return the pieces of a block with contacts, between where, and of which kind they are."""
    some = pieces.take(block)
    x = some.start + some.width * t
    R, R_c, d = some.circles(x)
    found = []
    for around, gap in ((False, _outside(R, R_c, d)), (True, _around(R, R_c, d))):
        positive = gap > 0
        changed = np.flatnonzero(positive[1:] != positive[:-1])
        step, piece = np.divmod(changed, max(1, x.shape[1]))
        kind = np.full(len(piece), around)
        found.append((piece + block.start, x[step, piece], x[step + 1, piece], kind))
    which, low, high, kind = (np.concatenate(each) for each in zip(*found, strict=True))
    return which, low, high, kind
