"""The chapter on a response: what drives the body, what it does, what its equipment bears."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from antinode.beam.beam import Beam
from antinode.errors import InputError
from antinode.response.equipment import Verdict
from antinode.response.file import Problem, load_response, with_equipment
from antinode.response.solve import solve_one_response
from antinode.show.response_figures import plot_response
from antinode.show.response_table import response_band, response_rows, verdict_rows

from .blocks import Block, Document, Section, bullets, paragraph, table, warnings
from .modal_sections import drawn_on_pages
from .provenance import hash_of

_BEFORE = "Sensitivities"
"""The section ahead of which responses stand."""
_METHODS = {
    "harmonic": "Every frequency is one pass through the whole chain with complex stiffness; no "
    "mode is left out. Peaks are bracketed, not sampled.",
    "random": "Spectra are those of the whole chain; no mode is left out. Their integrals are "
    "taken in each resonance at its own scale, whatever frequencies the file lists. The largest "
    "value is that of a Gaussian process in the exposure (Davenport, 1964).",
    "transient": "Modes move exactly under a force that runs straight between its points; modes "
    "left out rest under the force as it is.",
    "shock": "The largest of an oscillator on the output, during the record and after it "
    "(Smallwood, 1981), under the exact motion of the modes.",
}
_LEFT_OUT = (
    "how uncertain damping, forces and what equipment bears are: the errors are those of the "
    "computation",
    "motion of equipment in itself: each unit is a rigid mass at its station",
    "forces along the body that depend on its motion, but for what the case says of them",
    "non-linear behaviour of joints and supports, and fatigue",
)
_NO_LOSS = (
    "loss factors as such: over time they act as the viscous ratio that loses as much at each "
    "mode's resonance"
)


def with_responses(
    document: Document, told: list[str], file: Path, beam: Beam, responses: tuple[Path, ...]
) -> tuple[Document, list[str]]:
    """Return a document with a chapter for each response file, and its warnings with theirs.

    Parameters
    ----------
    document : Document
    told : list of str
        What it warns of.
    file : Path
        That it is about: each response must be of it.
    beam : Beam
        With what overrides the file.
    responses : tuple of Path

    Raises
    ------
    AntinodeError
        If one is of another file, or has no answer.
    """
    chapters = []
    for path in responses:
        problem = _of(file, load_response(path), path)
        own = problem._replace(beam=with_equipment(beam, problem.file))
        result = solve_one_response(own)
        chapters.append(_chapter(own, path, result))
        told = [*told, *result.warnings]
    names = [section.title for section in document.sections]
    at = names.index(_BEFORE) if _BEFORE in names else len(names)
    sections = (*document.sections[:at], *chapters, *document.sections[at:])
    return replace(document, sections=sections), told


def _failures(verdicts: Sequence[Verdict]) -> str:
    """Say how many units feel more than they may, and of how many it is not known."""
    said = [verdict.verdict for verdict in verdicts]
    words = {"no": "EXCEEDED", "not decided": "not decided within the error"}
    counted = [f"{said.count(key)} {word}" for key, word in words.items() if key in said]
    return ", ".join(counted) + "." if counted else ""


def _of(file: Path, problem: Problem, path: Path) -> Problem:
    """Return a response, or raise InputError where it is of another file."""
    named = path.parent / problem.file.response.of
    if named.resolve() != file.resolve():
        raise InputError(
            f"{path}: it is a response of '{problem.file.response.of}', not of {file}; name the "
            "file that [response] of names, or another response file"
        )
    return problem


def _chapter(problem: Problem, path: Path, result: Any) -> Section:
    return Section(
        f"Response: {problem.title}, {result.kind}", tuple(_blocks(problem, path, result))
    )


def _blocks(problem: Problem, path: Path, result: Any) -> Iterator[Block]:
    drives = ", ".join(problem.file.drive_names)
    band = response_band(result)
    yield paragraph(
        f"Driven by: {drives}. Damping: {problem.damping.describe()}; dashpots count besides. "
        f"{band[0].upper()}{band[1:]}. {_METHODS[result.kind]}"
    )
    if result.outputs:
        own = response_rows(result)
        caption = "What the outputs come to, with the error of the computation (+-)."
        yield table(caption, own.heads, own.rows, left=own.left)
    verdicts = getattr(result, "verdicts", ())
    if verdicts:
        own = verdict_rows(verdicts)
        failed = [k for k, verdict in enumerate(verdicts) if not verdict.passed]
        caption = (
            "Equipment: the smallest distance below what each unit may feel, with the error of the "
            "computation (+-), where it is smallest, "
            "the mode nearest to it and the force that makes most of it. "
            + (_failures(verdicts) or "All are within.")
        )
        yield table(caption, own.heads, own.rows, left=own.left, marked=failed)
    yield from drawn_on_pages(
        f"response_{path.stem}",
        plot_response(result),
        "The response; thin lines are natural frequencies, points the peaks; of equipment what "
        "it feels under what it may feel.",
    )
    if result.warnings:
        yield warnings(list(result.warnings))
    yield paragraph("Not in these numbers:")
    over_time = result.kind in ("transient", "shock") and bool(problem.damping.loss_factor)
    yield bullets([*_LEFT_OUT, *([_NO_LOSS] if over_time else [])])
    yield paragraph(
        f"From `{path.name}`, SHA-256 of its inputs {hash_of(problem.file)}; the same numbers come "
        f"from `antinode response {path.name}`."
    )
