"""What stability along an input, and a map over two, come to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.methods import AlongMethods
from antinode.modes.result import null
from antinode.stability.along import CriticalValue, Followed
from antinode.stability.result import CriticalLoad

from .inputs import Line

Critical = CriticalValue | CriticalLoad
FACTOR = {"input": "load_factor", "name": "factor on all axial forces", "unit": "1"}


@dataclass(frozen=True)
class Along(AlongMethods):
    """Every change of stability along an input, up to the first flutter.

    Attributes
    ----------
    name : str
        Of the beam or the vehicle.
    line : Line
        The input and its range.
    found : Followed
        Changes, modes along the input, and warnings.
    not_modelled : tuple of str
        What the model leaves out.
    """

    name: str
    line: Line
    found: Followed
    not_modelled: tuple[str, ...]

    @property
    def critical(self) -> tuple[CriticalValue, ...]:
        """Every change of stability."""
        return self.found.critical

    @property
    def flutter(self) -> CriticalValue | None:
        """The first flutter, if the range reaches to one."""
        return next((each for each in self.critical if each.kind == "flutter"), None)

    @property
    def first(self) -> CriticalValue | None:
        """The first loss of stability, if there is one."""
        return next((each for each in self.critical if each.change == "lost"), None)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be warned of."""
        unproven = sum(not each.proven for each in self.critical)
        said = (f"{unproven} of the brackets are not proven",) if unproven else ()
        return (*said, *self.found.warnings)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "schema_version": 1,
            "name": self.name,
            "along": self.line.to_dict(),
            "range": [self.line.low, self.found.reach],
            "unstable_at_start": self.found.unstable,
            "critical": [each.to_dict() for each in self.critical],
            "between": {"kind": "followed", "steps": self.found.solved},
            "not_modelled": list(self.not_modelled),
            "warnings": list(self.warnings),
        }

    def __repr__(self) -> str:
        low, reach = self.line.low, self.found.reach
        rows = [f"Stability of {self.name} along {self.line}: {low:g} to {reach:.6g}"]
        rows += [
            f"  {each.value:<15.10g} {each.kind:<10} {' with '.join(each.modes)}, {each.change}"
            for each in self.critical
        ]
        return "\n".join(rows if self.critical else [*rows, "  no change"])


@dataclass(frozen=True)
class StabilityMap:
    """Critical values of one input over another.

    Attributes
    ----------
    name : str
    line : Line or None
        The first input; None for the factor on all axial forces.
    over : Line
        The second one.
    values : array, shape (rows,)
        Of the second one.
    critical : tuple of tuple
        At each of them, every change of stability along the first.
    reasons : tuple of str
        Why a value has no answer; empty where it has.
    not_modelled : tuple of str
        What the model leaves out.
    """

    name: str
    line: Line | None
    over: Line
    values: Array
    critical: tuple[tuple[Critical, ...], ...]
    reasons: tuple[str, ...]
    not_modelled: tuple[str, ...]

    def boundary(self, kind: str) -> Array:
        """Return where stability is first lost by a kind; NaN where it is not."""
        rows = [_first(row, kind) for row in self.critical]
        return np.array([np.nan if each is None else place_of(each) for each in rows])

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        flutters = [_first(row, "flutter") for row in self.critical]
        return {
            "schema_version": 1,
            "name": self.name,
            "along": FACTOR if self.line is None else self.line.to_dict(),
            "over": {**self.over.to_dict(), "values": self.values.tolist()},
            "flutter": [null(v) for v in self.boundary("flutter").tolist()],
            "flutter_frequency_hz": [None if f is None else f.frequency_hz for f in flutters],
            "divergence": [null(v) for v in self.boundary("divergence").tolist()],
            "critical": [[each.to_dict() for each in row] for row in self.critical],
            "reasons": list(self.reasons),
            "not_modelled": list(self.not_modelled),
        }

    def __repr__(self) -> str:
        along = "the load factor" if self.line is None else str(self.line)
        return f"<StabilityMap '{self.name}': {along} over {self.over}, {len(self.values)} values>"


def place_of(each: Critical) -> float:
    """Return the critical value, or factor."""
    return each.load_factor if isinstance(each, CriticalLoad) else each.value


def _first(row: tuple[Critical, ...], kind: str) -> Critical | None:
    lost = (each for each in row if each.kind == kind and each.change != "regained")
    return next(lost, None)
