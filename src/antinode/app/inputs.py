"""The numbers of a case or a beam file that the page can move: where they stand, units, ranges."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple, get_args

from pydantic import BaseModel

from antinode.beam.file import BeamFile
from antinode.inputs.units import Unit
from antinode.vehicle.case import Case

from .display import Shown, System, shown_unit

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

    def shown(self, system: System) -> Shown:
        """Return its unit on the screen; a material's stiffness has a larger one than pressures."""
        stiff = self.unit == "Pa" and self.path.endswith("modulus")
        return shown_unit("stiff Pa" if stiff else self.unit, system)


def sliders(problem: Problem, original: Problem, more: tuple[str, ...] = ()) -> tuple[Input, ...]:
    """Return the inputs that have sliders; their ranges follow from the original values.

    Parameters
    ----------
    problem, original : Case or BeamFile
        With the present values, and as it was opened.
    more : tuple of str
        Paths of further numbers.
    """
    paths = _vehicle_paths(problem) if isinstance(problem, Case) else _beam_paths(problem, original)
    paths += [path for path in dict.fromkeys(more) if path not in paths]
    chosen = [find_input(problem, original, path) for path in paths]
    return tuple(item for item in chosen if item is not None)


def find_input(problem: Problem, original: Problem, path: str) -> Input | None:
    """Return an input with its present value and the range of its slider; None without a value."""
    value = _value(problem, path)
    if value is None:
        return None
    before = _value(original, path)
    label, unit = _place(type(problem), path)
    item = Input(path, label, unit, value, value, value)
    return _with_range(item, item._replace(value=value if before is None else before), problem)


def _value(problem: Problem, path: str) -> float | None:
    """Return the number that a path leads to, None where there is none."""
    node: Any = problem
    for key in path.split("."):
        if isinstance(node, tuple):
            node = node[int(key)] if key.isdigit() and int(key) < len(node) else None
        else:
            node = getattr(node, "table" if key == "beam" else key, None)
    return float(node) if isinstance(node, float) and math.isfinite(node) else None


@lru_cache(maxsize=1000)
def _place(model: type[BaseModel], path: str) -> tuple[str, str]:
    """Return the label and the SI unit of a number by its path."""
    keys, unit = path.split("."), ""
    here: Any = model
    for key in keys:
        inner = _model_in(here)
        if inner is None or key.isdigit():
            continue
        fields = {field.alias or name: field for name, field in inner.model_fields.items()}
        if key not in fields:
            break
        marks = [*fields[key].metadata, *_marks(fields[key].annotation)]
        unit = next((mark.symbol for mark in marks if isinstance(mark, Unit)), "")
        here = fields[key].annotation
    return _label(tuple(keys)), unit


def _model_in(annotation: Any) -> type[BaseModel] | None:
    """Return the first model inside an annotation such as ``tuple[FinSet, ...]``."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    found = (_model_in(a) for a in get_args(annotation) if not isinstance(a, str))
    return next((model for model in found if model is not None), None)


def _vehicle_paths(case: Case) -> list[str]:
    condition = case.condition
    cavitation = "depth" if condition.cavitation_number is None else "cavitation_number"
    names = ["speed", cavitation, "cavitator_angle", "thrust"]
    paths = [f"condition.{name}" for name in names]
    if case.vehicle.fins:
        own = case.vehicle.fins[0].position is not None
        paths.append("vehicle.fins.0.position" if own else "condition.fin_position")
    return [*paths, "condition.burn_fraction"]


def _beam_paths(file: BeamFile, original: Problem) -> list[str]:
    """Return loads first, then what is attached; what was not zero at first stays."""
    first = {item.path for item in numbers(original) if item.value != 0}
    every = [
        item.path
        for item in numbers(file)
        if item.value != 0 or "gravity" in item.path or item.path in first
    ]
    loads = [p for p in every if p.startswith("beam.loads")]
    attached = [p for p in every if not p.startswith("beam.loads")]
    return [*loads, *attached][:_MOST_SLIDERS] or _shares(file)


def _shares(file: BeamFile) -> list[str]:
    """Return the shares of forces at free ends that turn with them, where a force may be."""
    forced = file.table.stations.axial_force is not None
    sides = [side for side in ("left", "right") if getattr(file.table.ends, side) == "free"]
    return [f"beam.ends.{side}_follower" for side in sides if forced]


def numbers(problem: Problem) -> tuple[Input, ...]:
    """Return every single number of a problem that can be moved, tables of stations aside."""
    skipped = ("solve.", "vehicle.stations", "beam.stations", "vehicle.masses", "beam.masses")
    paths = (path for path in _walk(problem, ()) if not path.startswith(skipped))
    found = (find_input(problem, problem, path) for path in paths)
    return tuple(item for item in found if item is not None)


def _walk(node: Any, keys: tuple[str, ...]) -> Iterator[str]:
    """Yield the paths of all numbers."""
    if isinstance(node, BaseModel):
        for name, field in type(node).model_fields.items():
            yield from _walk(getattr(node, name), (*keys, field.alias or name))
    elif isinstance(node, tuple):
        for k, entry in enumerate(node):
            yield from _walk(entry, (*keys, str(k)))
    elif isinstance(node, float) and math.isfinite(node):
        yield ".".join(keys)


def _marks(annotation: Any) -> Iterator[Any]:
    """Yield the marks inside an annotation such as ``Annotated[float, ...] | None``."""
    for mark in getattr(annotation, "__metadata__", ()):
        yield mark
        yield from getattr(mark, "metadata", ())
    for argument in get_args(annotation):
        if not isinstance(argument, str):
            yield from _marks(argument)


_WORDS = {
    "point_masses": "mass",
    "springs": "spring",
    "pedestals": "pedestal",
    "joints": "joint",
    "dashpots": "dashpot",
    "point_feedbacks": "feedback",
    "point_forces": "force",
    "roll_angles": "roll angle",
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "left_follower": "left force follows",
    "right_follower": "right force follows",
}


def _label(keys: tuple[str, ...]) -> str:
    """Write a path in words: ``vehicle.fins.0.tip_radius`` is "fins 1: tip radius"."""
    words = [str(int(k) + 1) if k.isdigit() else _WORDS.get(k, k.replace("_", " ")) for k in keys]
    outer = words[1:-1] if words[0] in ("vehicle", "beam", "condition") else words[:-1]
    outer = [word for word in outer if word != "loads"]
    text = words[-1]
    if keys[-1].endswith("_follower"):
        return text
    return f"{' '.join(outer)}: {text}" if outer else text


_RANGES: dict[str, tuple[float, float]] = {
    "condition.cavitation_number": (0.005, 0.06),
    "condition.burn_fraction": (0.0, 1.0),
    "condition.cavitator_angle": (math.radians(-25), math.radians(25)),
    "condition.body_angle": (math.radians(-10), math.radians(10)),
    "beam.ends.left_follower": (0.0, 1.0),
    "beam.ends.right_follower": (0.0, 1.0),
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
    if name.endswith(".x") and not isinstance(problem, Case):
        x = problem.table.stations.x
        return float(x[0]), float(x[-1])
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
    if name.startswith("beam.loads"):
        return min(0.0, 2 * item.value), max(0.0, 2 * item.value)
    ends = sorted((item.value / 2, item.value * 1.5))
    return ends[0], ends[1]


def _nice(value: float) -> float:
    """Round a positive number to two digits."""
    return float(f"{value:.1e}")
