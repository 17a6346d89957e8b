"""The water's stiffness: what each device does as the body vibrates, in words and as numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from antinode.beam.families import BENDING
from antinode.modes.result import ModalResult, Mode, null
from antinode.modes.solve import solve_modes
from antinode.vehicle.case import Case
from antinode.vehicle.hydrodynamics.added_mass import AddedMass
from antinode.vehicle.tangent import Tangent

QUASI_STEADY = 0.3
"""f L/V up to which the water follows the motion without much delay [-]."""


def reduced_frequency(mode: Mode, case: Case) -> float:
    """Return f L/V: how many periods of a mode the water needs to pass the body [-]."""
    return float(mode.frequency_hz * case.vehicle.length / case.condition.speed)


def water_dict(case: Case, result: ModalResult) -> dict[str, Any]:
    """Return the water's stiffness as plain numbers for JSON, units in the keys."""
    added = [_added_dict(part) for part in case.added_masses]
    more: dict[str, Any] = {"added_mass": added} if added else {}
    if not case.tangents:
        kind = case.model.hydrodynamic_stiffness
        return {"hydrodynamic_stiffness": kind, "tangents": [], **more}
    modes = [m for m in result.family(BENDING) if m.number]
    without = bending_without(case, result)
    return {
        "hydrodynamic_stiffness": case.model.hydrodynamic_stiffness,
        "tangents": [_tangent_dict(t) for t in case.tangents],
        "reduced_frequency": {m.name: reduced_frequency(m, case) for m in modes},
        "without": {
            "frequencies_hz": [null(m.frequency_hz) for m in without],
            "error_hz": [null(m.error_hz) for m in without],
        },
        **more,
    }


def bending_without(case: Case, result: ModalResult) -> list[Mode]:
    """Return as many elastic bending modes of the same case without the water's stiffness."""
    model = case.model.model_copy(update={"hydrodynamic_stiffness": "none"})
    number = sum(m.number > 0 for m in result.family(BENDING))
    plain = case.model_copy(update={"model": model})
    found = solve_modes(plain, number, tolerance=result.tolerance, families=[BENDING])
    return [m for m in found.family(BENDING) if m.number][:number]


def _added_dict(part: AddedMass) -> dict[str, Any]:
    return {
        "name": part.name,
        "formula": part.formula,
        "from_m": part.start,
        "to_m": part.end,
        "mass_kg": part.mass,
    }


def added_mass_text(case: Case) -> str:
    """Return the size of the water that moves sideways with the body; empty if there is none."""
    parts = [
        f"{p.name} {p.mass:.4g} kg ({p.formula}; {p.start:.4g} to {p.end:.4g} m)"
        for p in case.added_masses
    ]
    return f"added mass, sideways alone: {', '.join(parts)}" if parts else ""


def _tangent_dict(tangent: Tangent) -> dict[str, Any]:
    return {
        "name": tangent.name,
        "x_m": tangent.x,
        "force_N": tangent.force,
        "spring_N_per_m": tangent.spring,
        "dashpot_N_s_per_m": tangent.dashpot,
        "following_N_per_rad": tangent.following,
        "stiffness": tangent.stiffness.tolist(),
        "damping": tangent.damping.tolist(),
        "contact_ends_at_m": null(tangent.room),
    }


def water_notes(case: Case, result: ModalResult) -> Sequence[str]:
    """Return what limits the water's stiffness: the delay of the cavity, and one-sided contacts."""
    modes = [m for m in result.family(BENDING) if m.number and math.isfinite(m.frequency_hz)]
    told = ", ".join(f"{m.number}: {reduced_frequency(m, case):.2g}" for m in modes[:6])
    slow = [m for m in modes if reduced_frequency(m, case) > QUASI_STEADY]
    beyond = f"; beyond it from {slow[0].name} on" if slow else ""
    lines = [f"f L/V of bending {told}; the tangents hold up to some {QUASI_STEADY:g}{beyond}."]
    lines += [
        f"{t.name.capitalize()}: one-sided; its tangent ends at an amplitude of {t.room * 1e3:.3g} "
        f"mm at x = {t.x:.4g} m."
        for t in case.tangents
        if math.isfinite(t.room)
    ]
    return lines
