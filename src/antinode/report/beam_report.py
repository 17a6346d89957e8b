"""The report on any beam."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING
from antinode.beam.file import BeamFile
from antinode.modes.result import ModalResult
from antinode.show.figures import plot_beam
from antinode.study.sensitivity.influence import beam_influences
from antinode.text import counted

from .blocks import Block, Document, Section, paragraph, runs, table
from .influence_section import influence_section
from .inputs import beam_inputs
from .modal_sections import axial_section, drawn, frequency_section, result_in_brief
from .numbers import number
from .provenance import Source, provenance_section, today
from .vehicle_report import facts, shapes_section, solver_facts, warned, warnings_section
from .words import method_section

_MOST_MODES = 6
_STATIONS = 11


def beam_report(file: BeamFile, result: ModalResult, source: Source, command: str) -> Document:
    """Return the document on a beam and its modes, solved with `unloaded=True`."""
    beam = result.beam
    modes = sum(mode.number > 0 for mode in result.family(BENDING))
    moved = beam_influences(file, min(modes, _MOST_MODES), result.tolerance)
    sections = [
        method_section(result.families, vehicle=False, sheared=result.beam.has_shear),
        *beam_inputs(file, beam),
        Section("Beam and axial force", tuple(_axial_force(beam))),
        frequency_section(result),
        axial_section(result),
        shapes_section(result, "the left end"),
        influence_section(moved),
        warnings_section(result.warnings),
        provenance_section(source, solver_facts(result), command),
    ]
    return Document(
        title=f"Natural vibration of {beam.name}",
        subtitle=f"{number(beam.length)} m, {number(beam.mass)} kg, "
        f"{beam.ends.left} – {beam.ends.right}",
        facts=facts(source),
        brief=tuple(map(runs, _brief(result, result.warnings))),
        sections=tuple(sections),
        date=today(),
    )


def _brief(result: ModalResult, told: Sequence[str]) -> list[str]:
    beam = result.beam
    N = _force_at(beam, np.linspace(beam.x[0], beam.x[-1], 201)) / 1e3
    force = (
        f"Axial force from {number(N.min(), 4)} to {number(N.max(), 4)} kN, compression positive."
    )
    attached = counted(len(beam.attachments), "attachment")
    return [
        result_in_brief(result),
        "There is no axial force." if beam.is_unloaded else force,
        f"{attached[0].upper()}{attached[1:]}. {warned(told)}",
    ]


def _force_at(beam: Beam, x: np.ndarray) -> np.ndarray:
    """Return N at places, ahead of a step [N]."""
    k = np.clip(np.searchsorted(beam.x, x, side="left") - 1, 0, len(beam.x) - 2)
    return beam.axial_force_at(k, (x - beam.x[k]) / np.diff(beam.x)[k])


def _axial_force(beam: Beam) -> Iterator[Block]:
    yield drawn(
        "beam",
        plot_beam(beam),
        "The beam, its ends and what is attached to it; thickness follows EI, not to scale. "
        + ("" if beam.is_unloaded else "Below, the axial force, positive in compression."),
    )
    if beam.is_unloaded:
        yield paragraph("The beam carries no axial force.")
        return
    x = np.linspace(beam.x[0], beam.x[-1], _STATIONS)
    rows = [(number(a, 6), number(n / 1e3, 6)) for a, n in zip(x, _force_at(beam, x), strict=True)]
    yield table("Axial force, ahead of a step.", ("x [m]", "N [kN]"), rows, left=())
