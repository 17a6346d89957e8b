"""`antinode report`: a document for a reviewer."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.options import (
    Json,
    ReportAuthor,
    ReportChecked,
    ReportFile,
    ReportModes,
    ReportResponses,
    ReportRevision,
    ReportTolerance,
    Set,
)


def report(
    file: Path,
    /,
    *,
    output: ReportFile,
    set_: Set = (),
    modes: ReportModes = None,
    tolerance: ReportTolerance = None,
    response: ReportResponses = (),
    author: ReportAuthor = "",
    revision: ReportRevision = "",
    checked_by: ReportChecked = "",
    json: Json = False,
) -> None:
    """Write a report on a case, a beam or a study that can be handed to a reviewer.

    The ending says what: .pdf or .html.

    Assumptions first, then inputs, loads with their checks, the ranges of the correlations,
    frequencies with errors and brackets, the effect of the axial force, shapes, sensitivities,
    warnings, and where it all comes from. The page loads nothing.

    - Example: **antinode report case.toml -o report.pdf**
    - Example: **antinode report beam.toml -o report.html --modes 4**
    - Example: **antinode report beam.toml -o report.pdf --response random.toml**
    - Example: **antinode report beam.toml -o report.pdf --author "A. Smith" --revision B**

    Parameters
    ----------
    file
        A case, a beam or a study file in TOML.
    """
    from antinode.report.command import run_report

    run_report(
        file,
        set_,
        output,
        modes=modes,
        tolerance=tolerance,
        responses=response,
        people=(author, revision, checked_by),
        json=json,
    )
