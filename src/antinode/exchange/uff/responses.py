"""Responses as a universal file: a dataset 58 for each curve.

Frequency responses (type 4) of each output over each force, power spectral densities (type 9),
time responses (type 1), shock spectra (type 0). SI; frequencies have the format's six digits.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from antinode.arrays import Numbers
from antinode.beam.families import FAMILIES
from antinode.response.quantities import Base, Drive, Output

from .writer import _dataset, _line, _units

_TYPES = {"harmonic": 4, "transient": 1, "random": 9, "shock": 0}
_MOTION = {0: 8, 1: 11, 2: 12}  # displacement, velocity, acceleration
_FORCE, _TIME, _FREQUENCY, _ANY = 13, 17, 18, 0
_NODES = "node 1 is the first station of all forces and outputs"


class Curve(NamedTuple):
    """One function of time or frequency."""

    output: Output
    drive: Drive | None
    x: Numbers
    y: Numbers
    unit: str


def response_uff(result: Any) -> str:
    """Return a response as text of a universal file."""
    curves = [Curve(*row) for row in result.curves()]
    places = sorted(
        {c.output.x for c in curves}
        | {c.drive.x for c in curves if c.drive is not None and not isinstance(c.drive, Base)}
    )
    nodes = {x: k for k, x in enumerate(places, 1)}
    parts = [_dataset(164, _units()), _dataset(15, (_node(k, x) for x, k in nodes.items()))]
    parts += [_dataset(58, _curve(result, curve, nodes)) for curve in curves]
    return "".join(parts)


def _node(number: int, x: float) -> str:
    return f"{number:10d}{0:10d}{0:10d}{8:10d}{x:13.5E}{0.0:13.5E}{0.0:13.5E}"


def _direction(family: str, component: int) -> int:
    """Return X, Y, ... as 1 to 6, of a displacement or of the force that goes with it."""
    freedoms = FAMILIES[family].freedoms  # type: ignore[index]
    size = 2 * len(freedoms)
    at = component % size
    return 1 + freedoms[at if at < len(freedoms) else size - 1 - at]


def _curve(result: Any, curve: Curve, nodes: dict[float, int]) -> Iterable[str]:
    output, drive = curve.output, curve.drive
    complex_, timed = result.kind == "harmonic", result.kind == "transient"
    yield _line(output.name)
    yield _line(f"{result.title}: {result.kind}, damping: {result.damping.describe()}")
    yield "NONE"
    yield _line(f"SI: {curve.unit}; time exp(+i omega t)")
    yield _line(_NODES)
    reference = (0, 0)
    if drive is not None:
        node = 0 if isinstance(drive, Base) else nodes[drive.x]
        turned = drive.direction == "moment"
        reference = node, _direction(drive.family, 1 if turned else 0)
    response = nodes[output.x], _direction(output.family, output.component)
    yield (
        f"{_TYPES[result.kind]:5d}{0:10d}{0:5d}{0:10d}"
        f" {'NONE':<10}{response[0]:10d}{response[1]:4d} {'NONE':<10}"
        f"{reference[0]:10d}{reference[1]:4d}"
    )
    yield f"{6 if complex_ else 4:10d}{len(curve.x):10d}{0:10d}{0.0:13.5E}{0.0:13.5E}{0.0:13.5E}"
    yield _axis(_TIME, "Time", "s") if timed else _axis(_FREQUENCY, "Frequency", "Hz")
    yield _axis(_kind(output), output.quantity[:20], curve.unit[:20])
    over = _axis(_FORCE, "Force", drive.unit) if complex_ and drive is not None else None
    if isinstance(drive, Base):
        over = _axis(_MOTION[drive.rate], drive.motion, drive.unit)
    yield over or _axis(_ANY, "NONE", "NONE")
    yield _axis(_ANY, "NONE", "NONE")
    for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True):
        yield f"{x:13.5E}{y.real:20.12E}" + (f"{y.imag:20.12E}" if complex_ else "")


def _kind(output: Output) -> int:
    if output.component == 0:
        return _MOTION[output.rate]
    return 9 if output.component < 0 else _ANY


def _axis(kind: int, label: str, unit: str) -> str:
    return f"{kind:10d}{0:5d}{0:5d}{0:5d} {label:<20} {unit:<20}"
