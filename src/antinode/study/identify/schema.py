"""The JSON schema of the identification file, every key with its unit and range."""

from __future__ import annotations

from typing import Any

from antinode.show.schema import as_in_toml

from .file import IdentificationFile


def identification_schema() -> dict[str, Any]:
    """Return the JSON schema of an identification file as it stands in TOML."""
    schema = IdentificationFile.model_json_schema()
    rows = schema["properties"]["observations"]
    description = rows.pop("description")
    file = {
        "type": "string",
        "minLength": 1,
        "description": "name of a CSV file with a header such as 'speed [m/s], bending:1 [Hz]'",
    }
    schema["properties"]["observations"] = {"description": description, "anyOf": [file, rows]}
    return as_in_toml(schema)
