"""What follows from the condition, warnings and ranges of validity, as on the command line."""

from __future__ import annotations

import math
from typing import Any

from antinode.app.compute import Answer
from antinode.app.display import System, number_text, shown_unit
from antinode.vehicle.case import Case
from antinode.vehicle.hydrodynamics.validity import Validity


def notes_data(answer: Answer, system: System) -> dict[str, Any]:
    """Return facts, warnings and checked ranges."""
    case = answer.case
    return {
        "facts": _facts(case, system) if case else _beam_facts(answer, system),
        "warnings": answer.warnings,
        "quick": answer.full is None,
        "left_out": list(answer.left_out),
        "ranges": [_range(row) for row in case.loads.validity] if case else [],
    }


def _facts(case: Case, system: System) -> list[list[str]]:
    loads = case.loads
    values = (
        ("mass", loads.mass, "kg"),
        ("acceleration forward", loads.a_X, "m/s^2"),
        ("N at the nose", float(loads.axial_force(0.0)), "N"),
    )
    unit = shown_unit("m", system)
    size = [number_text(unit.of(v), 4) for v in (loads.cavity.L_c, loads.cavity.D_c)]
    cavity = ["cavity, length × diameter", f"{' × '.join(size)} {unit.name}"]
    given = case.condition.cavitation_number is None
    sigma = [["cavitation number σ", number_text(loads.sigma, 4)]] if given else []
    return [cavity, *sigma] + [[name, _text(value, si, system)] for name, value, si in values]


def _beam_facts(answer: Answer, system: System) -> list[list[str]]:
    beam = answer.beam
    values = (("length", beam.length, "m"), ("mass", beam.mass, "kg"))
    ends = [["ends", f"{beam.ends.left} – {beam.ends.right}"]]
    return [[name, _text(value, si, system)] for name, value, si in values] + ends


def _text(value: float, si: str, system: System) -> str:
    unit = shown_unit(si, system)
    return f"{number_text(unit.of(value), 4)} {unit.name}".strip()


def _range(row: Validity) -> dict[str, Any]:
    allowed = f"{row.low:g} to {row.high:g}" if math.isfinite(row.high) else f"from {row.low:g} on"
    return {
        "name": row.correlation,
        "text": f"{row.quantity} = {row.value:.4g}",
        "allowed": allowed,
        "inside": bool(row.inside),
    }
