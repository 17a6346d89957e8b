"""The JSON schema of any input file, by its name."""

from __future__ import annotations

from typing import Any

from antinode.show.schema import input_schema


def schema(of: str = "case") -> dict[str, Any]:
    """Return the JSON schema of an input file, every key with its unit and range.

    Parameters
    ----------
    of : {"case", "beam", "response", "study", "identify"}

    Raises
    ------
    InputError
        If there is no such input file.
    """
    if of == "study":
        from .design.schema import study_schema

        return study_schema()
    if of == "identify":
        from .identify.schema import identification_schema

        return identification_schema()
    return input_schema(of)
