"""The report on a vehicle in a condition."""

from __future__ import annotations

from collections.abc import Sequence

from antinode.modes.result import ModalResult
from antinode.show.figures import case_title, plot_loads, plot_shapes
from antinode.study.sensitivity.influence import case_influences
from antinode.vehicle.case import Case
from antinode.vehicle.statics import deflection_warnings, static_shape

from .blocks import Block, Document, Section, paragraph, runs, warnings
from .end_forces_section import end_forces_section
from .influence_section import influence_section
from .inputs import case_inputs
from .load_sections import load_sections
from .modal_sections import axial_section, drawn, frequency_section, result_in_brief
from .numbers import number, small
from .provenance import Source, provenance_section, today
from .water_section import water_section
from .words import method_section

_MOST_DRAWN = 6


def vehicle_warnings(case: Case, result: ModalResult) -> list[str]:
    """Return what is doubtful about a case: its loads, its static deflection, its modes."""
    bent = deflection_warnings(case, static_shape(case))
    return [*case.loads.warnings, *bent, *result.warnings]


def vehicle_report(case: Case, result: ModalResult, source: Source, command: str) -> Document:
    """Return the document on a case and its modes, solved with `unloaded=True`."""
    told = vehicle_warnings(case, result)
    sections = [
        method_section(result.families, vehicle=True, sheared=result.beam.has_shear),
        *case_inputs(case),
        *load_sections(case, _loads_figure(case)),
        frequency_section(result),
        axial_section(result),
        *end_forces_section(case, result),
        *water_section(case, result),
        shapes_section(result, "the nose"),
        influence_section(case_influences(case, result, _MOST_DRAWN)),
        warnings_section(told),
        provenance_section(source, solver_facts(result), command),
    ]
    return Document(
        title=f"Natural vibration of {case.vehicle.name}",
        subtitle=case_title(case).partition(": ")[2],
        facts=facts(source),
        brief=tuple(map(runs, _brief(case, result, told))),
        sections=tuple(sections),
        date=today(),
    )


def facts(source: Source) -> tuple[tuple[str, str], ...]:
    """Return what stands under the title."""
    from antinode.version import __version__

    return (
        ("Program", f"antinode {__version__}"),
        ("Input", source.path.name),
        ("Inputs, SHA-256", source.short_hash),
        ("Date", today()),
    )


def _brief(case: Case, result: ModalResult, told: Sequence[str]) -> list[str]:
    loads = case.loads
    N = loads.axial_force([0.0, case.vehicle.length]) / 1e3
    outside = sum(not row.inside for row in loads.validity)
    return [
        result_in_brief(result),
        f"Axial force from {number(float(N[0]), 4)} kN at the nose to {number(float(N[1]), 4)} kN "
        f"at the tail, compression positive; the balance closes to {small(loads.checks.worst)}.",
        f"{len(loads.validity) - outside} of {len(loads.validity)} correlations are used inside "
        f"their ranges. {warned(told)}",
    ]


def warned(told: Sequence[str]) -> str:
    """Return how many warnings there are."""
    if not told:
        return "There are no warnings."
    return "There is 1 warning." if len(told) == 1 else f"There are {len(told)} warnings."


def _loads_figure(case: Case) -> Block:
    return drawn(
        "loads",
        plot_loads(case, title=False),
        "The vehicle in its cavity, to scale, seen from the side; axial force N, static shear "
        "force Q and bending moment M along it.",
    )


def shapes_section(result: ModalResult, origin: str) -> Section:
    """Return the figure of shapes."""
    drawing = drawn(
        "shapes",
        plot_shapes(result, _MOST_DRAWN, origin),
        "Bending modes, their bending moments, and longitudinal modes where there are any, each "
        "over its largest value. The first extremum from the left is positive.",
    )
    return Section("Mode shapes", (drawing,))


def warnings_section(told: Sequence[str]) -> Section:
    """Return all warnings."""
    return Section("Warnings", (warnings(told) if told else paragraph("There are none."),))


def solver_facts(result: ModalResult) -> dict[str, str]:
    """Return how the modes were found."""
    pieces = ", ".join(f"{n} {family}" for family, n in result.segments.items())
    certified = all(mode.counts[0] >= 0 for mode in result.modes)
    return {
        "method": "Riccati transfer matrices" if result.method == "riccati" else "TMM scan",
        "tolerance": f"{number(result.tolerance)} of a frequency, by what varies inside segments",
        "segments": pieces,
        "certificate": "every mode by counts" if certified else "not for every mode",
    }
