"""Responses as files: JSON, a table (CSV), universal files (dataset 58)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from antinode.show.writing import check_output, to_json, write_text, write_whole

ENDINGS = (".json", ".csv", ".uff")


def check_response_output(path: Path) -> None:
    """Raise InputError if a response cannot be written to a file of this name."""
    check_output(path, ENDINGS)


def write_response(path: Path, result: Any) -> None:
    """Write a response by the ending of the file, whole or not at all.

    Raises
    ------
    InputError
        If the ending is another, or the file cannot be written.
    """
    check_response_output(path)
    kind = path.suffix.lower()
    if kind == ".json":
        text = to_json(result.to_dict()) + "\n"
    elif kind == ".csv":
        text = response_csv(result)
    else:
        from .uff.responses import response_uff

        text = response_uff(result)
    write_whole(path, lambda partial: write_text(partial, text))


def response_csv(result: Any) -> str:
    """Return a response as a table: frequency or time, then the columns of each output."""
    columns = result.columns()
    heads = [f'"{head}"' if "," in head else head for head, _ in columns]
    rows = zip(*(values for _, values in columns), strict=True)
    lines = [",".join(heads), *(",".join(f"{v:.12g}" for v in row) for row in rows)]
    return "\n".join(lines) + "\n"
