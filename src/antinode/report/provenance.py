"""Where a report comes from: program, versions, files, and a hash of everything that was put in."""

from __future__ import annotations

import hashlib
import json
import platform
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

from antinode.version import __version__

from .blocks import Section, paragraph, table

_SHOWN = 16  # characters of a hash


@dataclass(frozen=True)
class Source:
    """The input of a report.

    Attributes
    ----------
    path : Path
        The file.
    assignments : tuple of str
        What overrides its keys.
    hash : str
        SHA-256 of all inputs as numbers, whatever the file looks like.
    """

    path: Path
    assignments: tuple[str, ...]
    hash: str

    @property
    def short_hash(self) -> str:
        """The first characters of the hash."""
        return self.hash[:_SHOWN]


def source_of(path: Path, assignments: tuple[str, ...], inputs: BaseModel) -> Source:
    """Return where inputs come from, with their hash."""
    return Source(path, assignments, hash_of(inputs))


def hash_of(inputs: BaseModel) -> str:
    """Return the SHA-256 of inputs: equal for equal numbers, however they were written."""
    text = json.dumps(_plain(inputs), sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def _plain(value: Any) -> Any:
    """Return lists, texts and numbers, the latter written so that they read back the same."""
    if isinstance(value, BaseModel):
        return {name: _plain(getattr(value, name)) for name in type(value).model_fields}
    if isinstance(value, np.ndarray):
        return [repr(float(each)) for each in value.ravel()]
    if isinstance(value, Mapping):
        return {str(key): _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    if isinstance(value, float | int) and not isinstance(value, bool):
        return repr(float(value))
    return value if value is None or isinstance(value, bool) else str(value)


def today() -> str:
    """Return the date as YYYY-MM-DD."""
    return date.today().isoformat()


def provenance_section(source: Source, rows: Mapping[str, str], command: str) -> Section:
    """Return the last section: what was run on what."""
    libraries = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "pydantic"))
    facts = {
        "program": f"antinode {__version__}",
        "date": today(),
        "input file": str(source.path),
        "overrides": ", ".join(source.assignments) or "none",
        "SHA-256 of the inputs": source.hash,
        **rows,
        "libraries": f"Python {platform.python_version()}, {libraries}",
        "system": f"{platform.system()} {platform.machine()}",
    }
    return Section(
        "Provenance",
        (
            table("How this report was made.", ("", ""), list(facts.items()), wide=(1,)),
            paragraph(
                "The hash covers every input as a number in SI units, defaults included; a file "
                "written another way with the same numbers has the same one. The same frequencies "
                f"come from `{command}`, and with `--json` as numbers for other programs."
            ),
        ),
    )
