"""The numbers of a case or a beam file that the page can move: where they stand, units, ranges."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple, get_args

from pydantic import BaseModel

from antinode.beam_file import BeamFile
from antinode.case import Case
from antinode.units import Unit

Problem = Case | BeamFile
_MOST_SLIDERS = 6


class Input(NamedTuple):
    """A number that can be moved.

    Attributes
    ----------
    path : str
        As `--set` takes it.
    label : str
        In words.
    unit : str
        SI unit.
    value : float
        Present value [unit].
    low, high : float
        Ends of its slider [unit].
    """

    path: str
    label: str
    unit: str
    value: float
    low: float
    high: float

    @property
    def step(self) -> float:
        """Step of the slider [unit]: a two-hundredth of its range."""
        return (self.high - self.low) / 200


def sliders(problem: Problem, original: Problem) -> tuple[Input, ...]:
    """Return the inputs that have sliders; their ranges follow from the original values.

    Parameters
    ----------
    problem, original : Case or BeamFile
        With the present values, and as it was opened.
    """
    paths = _vehicle_paths(problem) if isinstance(problem, Case) else _beam_paths(problem)
    before = {item.path: item for item in numbers(original)}
    now = {item.path: item for item in numbers(problem)}
    chosen = [now[path] for path in paths if path in now]
    return tuple(_with_range(item, before.get(item.path, item), problem) for item in chosen)


def _vehicle_paths(case: Case) -> list[str]:
    condition = case.condition
    cavitation = "depth" if condition.cavitation_number is None else "cavitation_number"
    names = ["speed", cavitation, "cavitator_angle", "thrust"]
    paths = [f"condition.{name}" for name in names]
    if case.vehicle.fins:
        own = case.vehicle.fins[0].position is not None
        paths.append("vehicle.fins.0.position" if own else "condition.fin_position")
    return [*paths, "condition.burn_fraction"]


def _beam_paths(file: BeamFile) -> list[str]:
    """Return loads first, then what is attached."""
    every = [item.path for item in numbers(file) if item.value != 0 or "gravity" in item.path]
    loads = [p for p in every if p.startswith("beam.loads")]
    attached = [p for p in every if not p.startswith("beam.loads")]
    return [*loads, *attached][:_MOST_SLIDERS]


def numbers(problem: Problem) -> tuple[Input, ...]:
    """Return every single number of a problem that can be moved, tables of stations aside."""
    found = (_with_range(item, item, problem) for item in _walk(problem, (), ""))
    skipped = ("solve.", "vehicle.stations", "beam.stations", "vehicle.masses", "beam.masses")
    return tuple(item for item in found if not item.path.startswith(skipped))


def _walk(node: Any, keys: tuple[str, ...], unit: str) -> Iterator[Input]:
    if isinstance(node, BaseModel):
        for name, field in type(node).model_fields.items():
            marks = [*field.metadata, *_marks(field.annotation)]
            inner = next((m.symbol for m in marks if isinstance(m, Unit)), None)
            yield from _walk(getattr(node, name), (*keys, field.alias or name), inner or "")
    elif isinstance(node, tuple):
        for k, entry in enumerate(node):
            yield from _walk(entry, (*keys, str(k)), unit)
    elif isinstance(node, float) and math.isfinite(node):
        yield Input(".".join(keys), _label(keys), unit, node, node, node)


def _marks(annotation: Any) -> Iterator[Any]:
    """Yield the marks inside an annotation such as ``Annotated[float, ...] | None``."""
    for mark in getattr(annotation, "__metadata__", ()):
        yield mark
        yield from getattr(mark, "metadata", ())
    for argument in get_args(annotation):
        if not isinstance(argument, str):
            yield from _marks(argument)


def _label(keys: tuple[str, ...]) -> str:
    """Write a path in words: ``vehicle.fins.0.tip_radius`` is "fins 1: tip radius"."""
    words = [str(int(k) + 1) if k.isdigit() else k.replace("_", " ") for k in keys]
    outer = words[1:-1] if words[0] in ("vehicle", "beam", "condition") else words[:-1]
    text = words[-1]
    return f"{' '.join(outer)}: {text}" if outer else text


_RANGES: dict[str, tuple[float, float]] = {
    "condition.cavitation_number": (0.005, 0.06),
    "condition.burn_fraction": (0.0, 1.0),
    "condition.cavitator_angle": (math.radians(-25), math.radians(25)),
    "condition.body_angle": (math.radians(-10), math.radians(10)),
}


def _with_range(item: Input, original: Input, problem: Problem) -> Input:
    """Give an input the range of its slider, wide enough for its present value."""
    low, high = _range(original, problem)
    return item._replace(low=min(low, item.value), high=max(high, item.value))


def _range(item: Input, problem: Problem) -> tuple[float, float]:
    name, size = item.path, abs(item.value)
    if name in _RANGES:
        return _RANGES[name]
    if isinstance(problem, Case) and name.endswith("position"):
        return 0.0, problem.vehicle.length
    if name == "condition.depth":
        return 0.0, max(50.0, _nice(2 * size))
    if name == "condition.thrust":
        return 0.0, _nice(2.5 * size) if size else 100e3
    if name == "condition.speed":
        return _nice(size / 2), _nice(1.75 * size)
    if item.unit == "rad":
        return item.value - math.radians(10), item.value + math.radians(10)
    if size == 0:
        return (0.0, 1.0) if name != "beam.loads.gravity" else (-9.80665, 9.80665)
    ends = sorted((item.value / 2, item.value * 1.5))
    return ends[0], ends[1]


def _nice(value: float) -> float:
    """Round a positive number to two digits."""
    return float(f"{value:.1e}")
