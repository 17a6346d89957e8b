"""The JSON schema of the input files, every key with its unit and range."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel

from antinode.beam.file import BeamFile
from antinode.errors import InputError
from antinode.response.file import ResponseFile
from antinode.text import short
from antinode.vehicle.case import Case

MODELS: dict[str, tuple[type[BaseModel], str]] = {
    "case": (Case, "Stations"),
    "beam": (BeamFile, "BeamStations"),
    "response": (ResponseFile, ""),
}
"""Each input file with the name of its table of stations, if it has one."""


def input_schema(name: str) -> dict[str, Any]:
    """Return the JSON schema of an input file as it stands in TOML.

    Parameters
    ----------
    name : {"case", "beam", "response"}

    Raises
    ------
    InputError
        If there is no such input file.
    """
    if name not in MODELS:
        names = ", ".join([*MODELS, "study", "identify"])
        raise InputError(f"there is no schema {short(name)}; allowed are {names}")
    model, stations = MODELS[name]
    schema = model.model_json_schema()
    if stations:
        _name_mass_states(schema["$defs"][stations])
    for definition in schema["$defs"].values():
        if "stations" in definition.get("properties", {}):
            _allow_file(definition["properties"])
    return as_in_toml(schema)


def as_in_toml(schema: dict[str, Any]) -> dict[str, Any]:
    """Return a schema with its dialect, and without the choice of null, which TOML lacks."""
    plain: dict[str, Any] = _without_null(schema)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **plain}


def _allow_file(properties: dict[str, Any]) -> None:
    """Allow the name of a CSV file in place of a table of stations."""
    table = properties["stations"]
    file = {
        "type": "string",
        "minLength": 1,
        "description": "name of a CSV file with a header such as 'x [m], mass_per_length [kg/m]'",
    }
    properties["stations"] = {
        "description": table.get("description", "the table, or the name of a CSV file"),
        "anyOf": [file, {"$ref": table["$ref"]}],
    }


def _name_mass_states(stations: dict[str, Any]) -> None:
    """Write mass states as a file has them: as columns mass_per_length and mass_per_length:NAME."""
    column = stations["properties"]["mass_per_length"]
    if "additionalProperties" not in column:
        return
    column = {**column["additionalProperties"], "description": column["description"]}
    stations["properties"]["mass_per_length"] = column
    stations["patternProperties"] = {"^mass_per_length:": column}
    stations["required"].remove("mass_per_length")


def _without_null(schema: Any) -> Any:
    """Leave out the choice of null, which TOML does not have."""
    if isinstance(schema, list):
        return [_without_null(item) for item in schema if item != {"type": "null"}]
    if not isinstance(schema, dict):
        return schema
    kept = {k: _without_null(v) for k, v in schema.items() if (k, v) != ("default", None)}
    choices = kept.get("anyOf", [])
    if len(choices) == 1:
        kept.pop("anyOf")
        kept = {**choices[0], **kept}
    return kept
