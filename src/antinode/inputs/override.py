"""Overrides of a file's keys from the command line: ``--set condition.speed=100m/s``."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from antinode.errors import InputError
from antinode.text import short

from .toml_reading import parse_toml

_DEEPEST = 20


def override(tables: dict[str, Any], assignments: Iterable[str]) -> None:
    """Apply ``key.subkey=value`` assignments to the tables of a file, in place.

    A list's entry is named by its index from 0, as in ``vehicle.fins.0.thickness=20mm`` (or
    ``vehicle.fins[0].thickness``). A value that is not TOML by itself is taken as text.

    Raises
    ------
    InputError
        If an assignment cannot be read, or leads nowhere.
    """
    for assignment in assignments:
        path, equals, text = assignment.partition("=")
        keys = [key.strip() for key in path.replace("[", ".").replace("]", "").split(".")]
        if not equals or not all(keys) or len(keys) > _DEEPEST:
            raise InputError(
                f"--set: received {short(assignment)}; write it as table.key=value, "
                "e.g. condition.speed=100m/s"
            )
        _assign(tables, keys, _toml_value(text.strip()), assignment)


def _toml_value(text: str) -> object:
    """Read a value as TOML has it, or else as bare text."""
    try:
        tables = parse_toml(f"value = {text}")
    except ValueError:
        return text
    return tables["value"] if len(tables) == 1 else text


def _assign(tables: dict[str, Any], keys: list[str], value: object, assignment: str) -> None:
    here: Any = tables
    for position, key in enumerate(keys):
        index = _index(here, key, ".".join(keys[:position]), assignment)
        if position == len(keys) - 1:
            here[index] = value
            return
        if isinstance(here, dict):
            here.setdefault(key, {})
        here = here[index]


def _index(here: Any, key: str, path: str, assignment: str) -> Any:
    """Return a key of a table or an index of a list, after checking that it can be one."""
    if isinstance(here, dict):
        return key
    wrong = f"--set {short(assignment)}: {path}"
    if not isinstance(here, list):
        raise InputError(f"{wrong} holds a value, not a table; check the key")
    if not (key.isascii() and key.isdigit() and len(key) < 10 and int(key) < len(here)):
        allowed = f"give an index from 0 to {len(here) - 1}" if here else "write its entries first"
        raise InputError(f"{wrong} is a list of {len(here)}, without '{key[:20]}'; {allowed}")
    return int(key)
