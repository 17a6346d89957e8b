"""Objects in one line, as a prompt of Python shows them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from antinode.modes.solve import beam_of
from antinode.text import counted

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.modes.result import ModalResult, Mode
    from antinode.modes.solve import HasBeam
    from antinode.vehicle.case import Case
    from antinode.vehicle.loads import Loads


def about_beam(beam: Beam) -> str:
    """Return what a beam is: length, mass, intervals, ends, and how much is attached."""
    ends = f"{beam.ends.left} - {beam.ends.right}"
    parts = [
        f"{beam.length:.5g} m",
        f"{beam.mass:.5g} kg",
        f"{counted(len(beam.x) - 1, 'interval')} ({beam.interpolation})",
        ends,
        "Timoshenko" if beam.is_timoshenko else "Euler-Bernoulli",
    ]
    if beam.attachments:
        parts.append(f"{len(beam.attachments)} attached")
    return ", ".join(parts)


def beam_line(problem: Beam | HasBeam) -> str:
    """Return a beam, or a beam file, in one line."""
    beam = beam_of(problem)
    return f"<{type(problem).__name__} '{beam.name}': {about_beam(beam)}>"


def case_line(case: Case) -> str:
    """Return a vehicle in its condition in one line."""
    c = case.condition
    return (
        f"<Case '{case.vehicle.name}': {case.vehicle.length:.5g} m, {case.loads.mass:.5g} kg, "
        f"{c.speed:g} m/s, sigma {case.loads.sigma:.4g}, thrust {c.thrust / 1e3:g} kN>"
    )


def loads_line(loads: Loads) -> str:
    """Return loads in one line."""
    N = loads.axial_force([0.0, loads.length]) / 1e3
    return (
        f"<Loads: N from {N[0]:.4g} to {N[1]:.4g} kN, drag {loads.drag / 1e3:.4g} kN, thrust "
        f"{loads.thrust / 1e3:.4g} kN, {loads.a_X:.3g} m/s^2 forward>"
    )


def frequency(mode: Mode) -> str:
    """Return the frequency of a mode, or that it grows, with its unit."""
    if mode.omega2 < 0:
        return f"grows at {mode.growth_rate_per_s:.4g} /s"
    return f"{mode.frequency_hz:.6g} Hz"


def mode_line(mode: Mode) -> str:
    """Return a mode in one line."""
    error = "" if math.isnan(mode.error_hz) else f" +- {mode.error_hz:.1e}"
    return f"<Mode {mode.name} ({mode.kind}): {frequency(mode)}{error}>"


def modes_line(result: ModalResult) -> str:
    """Return modes in one line: the first frequency of each family."""
    parts = []
    for family in result.families:
        own = [mode for mode in result.family(family) if mode.number]
        first = f" from {frequency(own[0])}" if own else ""
        parts.append(f"{len(own)} {family}{first}")
    warned = f", {counted(len(result.warnings), 'warning')}" if result.warnings else ""
    return f"<ModalResult '{result.beam.name}': {', '.join(parts)}{warned}>"


def response_line(result: Any) -> str:
    """Return a response in one line."""
    outputs = counted(len(result.outputs), "output")
    verdicts = getattr(result, "verdicts", ())
    judged = ""
    if verdicts:
        judged = ", equipment " + ("within its limits" if result.passed else "EXCEEDED")
    return (
        f"<{type(result).__name__} '{result.title}': {outputs}, {span_of(result)}, damping "
        f"{result.damping.describe()}{judged}>"
    )


def span_of(result: Any) -> str:
    """Return the range of frequency, or of time, of a response."""
    if hasattr(result, "frequency_hz"):
        return f"{result.frequency_hz[0]:g} to {result.frequency_hz[-1]:g} Hz"
    return f"{result.time_s[0]:g} to {result.time_s[-1]:g} s"
