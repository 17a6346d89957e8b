"""The water's stiffness: what each device does as the body vibrates, in words and as numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.modes.result import ModalResult, Mode, null
from antinode.modes.solve import solve_modes
from antinode.response.units import STANDARD_GRAVITY
from antinode.vehicle.case import Case, vehicle_beam
from antinode.vehicle.hydrodynamics.added_mass import AddedMass
from antinode.vehicle.tangent import QUASI_STEADY, Tangent


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
    without, off = bending_without(case, result), bending_off_contact(case, result)
    return {
        "hydrodynamic_stiffness": case.model.hydrodynamic_stiffness,
        "tangents": [_tangent_dict(t) for t in case.tangents],
        "reduced_frequency": {m.name: reduced_frequency(m, case) for m in modes},
        "without": {
            "frequencies_hz": [null(m.frequency_hz) for m in without],
            "error_hz": [null(m.error_hz) for m in without],
        },
        "contact_off": {
            "frequencies_hz": [null(m.frequency_hz) for m in off],
            "error_hz": [null(m.error_hz) for m in off],
        },
        "contact_ends": [end.to_dict() for end in contact_ends(case, result)],
        **more,
    }


def bending_without(case: Case, result: ModalResult) -> list[Mode]:
    """Return the bending modes of the same case that oscillate without the water's stiffness."""
    model = case.model.model_copy(update={"hydrodynamic_stiffness": "none"})
    return _oscillating(case.model_copy(update={"model": model}), result)


def bending_off_contact(case: Case, result: ModalResult) -> list[Mode]:
    """Return the bending modes that oscillate with one-sided contacts off, all else as it is.

    As long as the body vibrates off the cavity's wall these are its frequencies; none where there
    is no such contact.
    """
    acting = tuple(t for t in case.tangents if not math.isfinite(t.room))
    if len(acting) == len(case.tangents):
        return []
    return _oscillating(vehicle_beam(case, acting), result)


def side_by_side(case: Case, result: ModalResult) -> dict[str, list[Mode]]:
    """Return the bending modes that oscillate by what of the water acts, as the file says first."""
    own = [m for m in result.family(BENDING) if m.number and m.frequency_hz > 0]
    off = bending_off_contact(case, result)
    rows = {"with the water (this file)": own}
    if off:
        rows = {"with the water, contact on (this file)": own, "contact off": off}
    return rows | {"without": bending_without(case, result)}


def _oscillating(problem: Beam | Case, result: ModalResult) -> list[Mode]:
    """Return as many bending modes of a problem as a result has, those that oscillate."""
    number = sum(m.number > 0 for m in result.family(BENDING))
    found = solve_modes(problem, number, tolerance=result.tolerance, families=[BENDING])
    return [m for m in found.family(BENDING) if m.number and m.frequency_hz > 0][:number]


@dataclass(frozen=True)
class ContactEnd:
    """Amplitudes at which a mode takes the body off a one-sided contact.

    Attributes
    ----------
    name : str
        Of the mode.
    frequency_hz : float
    amplitude : float
        Where the body touches [m].
    acceleration : float
        There, omega^2 times it [m/s^2].
    largest : float
        The largest amplitude along the body then [m]; infinite at a node.
    """

    name: str
    frequency_hz: float
    amplitude: float
    acceleration: float
    largest: float

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "mode": self.name,
            "frequency_hz": self.frequency_hz,
            "amplitude_m": self.amplitude,
            "acceleration_m_per_s2": self.acceleration,
            "acceleration_g": self.acceleration / STANDARD_GRAVITY,
            "largest_amplitude_m": null(self.largest),
        }


def contact_ends(case: Case, result: ModalResult) -> list[ContactEnd]:
    """Return by mode the amplitudes at which the nearest one-sided contact ends; none without."""
    touching = [t for t in case.tangents if math.isfinite(t.room)]
    if not touching:
        return []
    contact = min(touching, key=lambda t: t.room)
    modes = [m for m in result.family(BENDING) if m.number and m.frequency_hz > 0]
    return [_contact_end(contact, mode, result.x) for mode in modes]


def _contact_end(contact: Tangent, mode: Mode, x: Array) -> ContactEnd:
    Y = mode.states[:, 0] if mode.phasors is None else mode.phasors[:, 0]
    there = abs(np.interp(contact.touches, x, Y.real) + 1j * np.interp(contact.touches, x, Y.imag))
    omega = 2 * math.pi * mode.frequency_hz
    largest = float(np.max(np.abs(Y)) / there) * contact.room if there else math.inf
    acceleration = omega**2 * contact.room
    return ContactEnd(mode.name, mode.frequency_hz, contact.room, acceleration, largest)


def _added_dict(part: AddedMass[float]) -> dict[str, Any]:
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
        "contact_x_m": null(tangent.touches),
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
        f"mm at x = {t.touches:.4g} m."
        for t in case.tangents
        if math.isfinite(t.room)
    ]
    return lines
