"""What `antinode report` does: read, solve, write a document."""

from __future__ import annotations

import shlex
import time
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from antinode.beam.file import TABLES, BeamFile, load_beam
from antinode.errors import InputError
from antinode.inputs.reading import read_toml
from antinode.modes.result import ModalResult
from antinode.modes.solve import solve_one
from antinode.show.outcome import print_json, say_written
from antinode.show.writing import check_output, write_whole
from antinode.vehicle.case import Case, load_case

from .beam_report import beam_report
from .blocks import Document
from .formats import ENDINGS, check_libraries
from .html import to_html
from .pdf import to_pdf
from .provenance import source_of
from .response_section import with_responses
from .vehicle_report import vehicle_report, vehicle_warnings

People = tuple[str, str, str]
"""Author, revision, and who checked it."""
NOBODY: People = ("", "", "")
_BY_HAND = ". " * 12


def signed(document: Document, people: People) -> Document:
    """Return a document with author, revision and checker under its title."""
    names = ("Author", "Revision", "Checked by")
    told = tuple((n, each.strip() or _BY_HAND) for n, each in zip(names, people, strict=True))
    return replace(document, facts=(*document.facts, *told))


def run_report(
    file: Path,
    assignments: tuple[str, ...],
    output: Path,
    *,
    modes: int | None = None,
    tolerance: float | None = None,
    responses: tuple[Path, ...] = (),
    people: People = NOBODY,
    json: bool = False,
) -> None:
    """Write the report on a case, a beam or a study, and say so."""
    started = time.monotonic()
    check_output(output, ENDINGS)
    check_libraries(output)
    document, told = make_report(file, assignments, modes, tolerance, responses)
    write_report(signed(document, people), output)
    if json:
        data = {
            "schema_version": 1,
            "report": str(output),
            "hash": dict(document.facts)["Inputs, SHA-256"],
            "title": document.title,
            "seconds": round(time.monotonic() - started, 3),
            "warnings": told,
        }
        print_json(data)
    else:
        say_written(output)


def report_file(
    file: str | Path,
    output: str | Path,
    assignments: Iterable[str] = (),
    *,
    modes: int | None = None,
    tolerance: float | None = None,
    responses: Iterable[str | Path] = (),
    author: str = "",
    revision: str = "",
    checked_by: str = "",
) -> list[str]:
    """Write the report on the case, beam or study of a file, as `antinode report` does.

    Parameters
    ----------
    file : str or Path
    output : str or Path
        .html or .pdf.
    assignments : iterable of str
        Overrides such as ``"condition.speed=100m/s"``.
    modes, tolerance
        By default the file's.
    responses : iterable of str or Path
        Response files of that case or beam: a chapter for each.
    author, revision, checked_by : str
        What stands under the title; empty ones are left to be filled in by hand.

    Returns
    -------
    list of str
        What the report warns of.

    Raises
    ------
    InputError
        If anything in the file is wrong, or the report cannot be written.
    """
    check_output(Path(output), ENDINGS)
    check_libraries(Path(output))
    more = tuple(map(Path, responses))
    document, told = make_report(Path(file), tuple(assignments), modes, tolerance, more)
    write_report(signed(document, (author, revision, checked_by)), Path(output))
    return told


def make_report(
    file: Path,
    assignments: tuple[str, ...] = (),
    modes: int | None = None,
    tolerance: float | None = None,
    responses: tuple[Path, ...] = (),
) -> tuple[Document, list[str]]:
    """Return the report on whatever a file holds, and its warnings."""
    tables = {"beam": {}} if file.suffix.lower() in TABLES else read_toml(file)
    if not {"vehicle", "beam", "case"} & set(tables):
        raise InputError(
            f"{file}: there is neither a table [vehicle] nor [beam], nor the case of a study in "
            "it; name a case, a beam or a study file, e.g. one that 'antinode init' writes"
        )
    overrides = "".join(f" --set {shlex.quote(each)}" for each in assignments)
    if "case" in tables:
        if responses:
            raise InputError(
                f"{file}: a study has no chapter on responses, only a case or a beam; name its "
                "case in place of it, or leave --response out"
            )
        return _of_study(file, assignments, modes, tolerance, f"antinode sweep {file.name}")
    if "vehicle" in tables:
        case = load_case(file, assignments)
        result = _solved(case, modes, tolerance)
        command = f"antinode modes {file.name}{overrides}"
        document = vehicle_report(case, result, source_of(file, assignments, case), command)
        told = vehicle_warnings(case, result)
        return with_responses(document, told, file, case.beam(), responses)
    beam = load_beam(file, assignments)
    result = _solved(beam, modes, tolerance)
    command = f"antinode beam {file.name}{overrides}"
    document = beam_report(beam, result, source_of(file, assignments, beam), command)
    return with_responses(document, list(result.warnings), file, beam.beam(), responses)


def _of_study(
    file: Path,
    assignments: tuple[str, ...],
    modes: int | None,
    tolerance: float | None,
    command: str,
) -> tuple[Document, list[str]]:
    from antinode.study.design.loading import load_study
    from antinode.study.sweep.folder import import_store

    from .study_report import study_report

    import_store()
    given = {"solve.modes": modes, "solve.tolerance": tolerance}
    more = tuple(f"{key}={value}" for key, value in given.items() if value is not None)
    study = load_study(file, (*assignments, *more))
    overrides = "".join(f" --set {shlex.quote(each)}" for each in (*assignments, *more))
    return study_report(study, source_of(file, assignments, study), command + overrides)


def _solved(problem: Case | BeamFile, modes: int | None, tolerance: float | None) -> ModalResult:
    settings = problem.solve.overridden(modes=modes, tolerance=tolerance)
    return solve_one(problem, settings.modes, tolerance=settings.tolerance, unloaded=True)


def write_report(document: Document, path: Path) -> None:
    """Write a document as HTML or PDF, by the ending, whole or not at all."""
    page = to_html(document).encode() if path.suffix.lower() == ".html" else to_pdf(document)
    write_whole(path, lambda partial: partial.write_bytes(page))
