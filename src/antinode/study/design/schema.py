"""The JSON schema of the study file, every key with its unit and range."""

from __future__ import annotations

from typing import Any

from antinode.show.schema import as_in_toml

from .file import StudyFile


def study_schema() -> dict[str, Any]:
    """Return the JSON schema of a study file as it stands in TOML."""
    return as_in_toml(StudyFile.model_json_schema())
