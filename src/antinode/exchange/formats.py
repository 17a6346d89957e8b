"""Names of the formats and their endings."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from antinode.errors import InputError
from antinode.text import short

Format = Literal[
    "toml",
    "csv",
    "xlsx",
    "json",
    "netcdf",
    "mat",
    "nastran",
    "calculix",
    "uff",
    "vtk",
    "sections",
    "bmodes",
]

INPUTS: dict[str, Format] = {
    ".toml": "toml",
    ".csv": "csv",
    ".xlsx": "xlsx",
    ".bdf": "nastran",
    ".nas": "nastran",
    ".fem": "nastran",
    ".dat": "sections",
    ".bmi": "bmodes",
    ".uff": "uff",
    ".unv": "uff",
}
"""What is read, by ending."""

OUTPUTS: dict[str, Format] = {
    ".toml": "toml",
    ".csv": "csv",
    ".json": "json",
    ".nc": "netcdf",
    ".xlsx": "xlsx",
    ".mat": "mat",
    ".bdf": "nastran",
    ".nas": "nastran",
    ".inp": "calculix",
    ".uff": "uff",
    ".unv": "uff",
    ".vtu": "vtk",
}
"""What is written, by ending."""

MODAL_FORMATS: dict[str, Format] = {e: f for e, f in OUTPUTS.items() if f != "toml"}
"""In what modes are written, by ending."""
MODAL_ENDINGS = tuple(MODAL_FORMATS)


def format_of(path: Path, known: Mapping[str, Format]) -> Format:
    """Return the format that the ending of a file says.

    Raises
    ------
    InputError
        If there is none.
    """
    try:
        return known[path.suffix.lower()]
    except KeyError:
        endings = ", ".join(known)
        option = "--from" if known is INPUTS else "--to"
        raise InputError(
            f"{short(str(path))}: the ending says the format; allowed are {endings}: rename the "
            f"file, or name the format with {option}"
        ) from None
