"""Reading TOML and CSV: from a file on disk to checked, frozen inputs, or one clear sentence.

Every error names the file, the key, the value received, what is allowed and what to do next.
Nothing is ever written here.
"""

from __future__ import annotations

import csv
import difflib
import io
import math
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from .errors import InputError
from .units import unit_factor

MOST_TOML_BYTES = 2_000_000
MOST_CSV_BYTES = 50_000_000
MOST_ROWS = 200_000

COLUMN_UNITS = {
    "x": "m",
    "mass_per_length": "kg/m",
    "bending_stiffness": "N m^2",
    "axial_stiffness": "N",
    "axial_force": "N",
    "radius": "m",
    "radius_of_gyration": "m",
    "wall": "m",
}
"""SI unit of every column that a table of stations may have."""

Model = TypeVar("Model", bound=BaseModel)


def read_toml(path: Path) -> dict[str, Any]:
    """Read a TOML file into plain tables.

    Raises
    ------
    InputError
        If the file is missing, too large, no text, or no TOML.
    """
    text = _read_text(path, MOST_TOML_BYTES, "a TOML file")
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError, ValueError) as error:
        raise InputError(
            f"{path}: this is not valid TOML ({_short(str(error), 120)}); "
            "compare it with the file that 'antinode init' writes"
        ) from error


def _read_text(path: Path, most: int, what: str) -> str:
    try:
        if path.is_dir():
            raise InputError(f"{path}: this is a folder; name {what} inside it")
        size = path.stat().st_size
        if size > most:
            raise InputError(
                f"{path}: {size / 1e6:.1f} MB is more than the {most / 1e6:g} MB allowed for "
                f"{what}; check that this is the right file"
            )
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError as error:
        raise InputError(f"{path}: no such file{_similar_file(path)}") from error
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: this is not UTF-8 text; save it as text, or check that this is {what}"
        ) from error
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{path}: cannot be read ({reason}); check the path") from error


def _similar_file(path: Path) -> str:
    try:
        names = [p.name for p in path.parent.iterdir() if p.suffix == path.suffix][:500]
    except OSError:
        return f"; the folder {path.parent} does not exist either"
    close = difflib.get_close_matches(path.name, names, n=1)
    if close:
        return f"; did you mean {path.parent / close[0]}?"
    return "; write one with 'antinode init'" if path.suffix == ".toml" else "; check the path"


def read_stations(source: object, folder: Path, key: str, columns: Sequence[str]) -> object:
    """Return the columns of a table of stations that is given inline or as a CSV file's name.

    Parameters
    ----------
    source : object
        The value in the TOML file: a table of columns, or a path relative to `folder`.
    folder : Path
        Of the TOML file.
    key : str
        Where the value stands, for messages.
    columns : sequence of str
        Names that are allowed, before any ``:state``.
    """
    if isinstance(source, str):
        return read_csv(folder / source, columns)
    if isinstance(source, Mapping):
        for name in source:
            _check_column(str(name), columns, key)
        return dict(source)
    raise InputError(
        f"{key}: received {_short(source)}; give the name of a CSV file or a table of columns "
        "such as { x = [0, 1], ... }"
    )


def read_csv(path: Path, columns: Sequence[str]) -> dict[str, list[float]]:
    """Read a table of stations: a header ``name [unit]`` (or SI names), then rows of numbers.

    Empty cells in the last row repeat the row before, for stepped tables, whose last row only
    gives the end.
    """
    text = _read_text(path, MOST_CSV_BYTES, "a CSV table")
    lines = (line for line in io.StringIO(text) if line.strip() and not line.startswith("#"))
    try:
        rows = list(_limited(csv.reader(lines, skipinitialspace=True), path))
    except csv.Error as error:
        raise InputError(f"{path}: this is not a CSV table ({error})") from error
    if len(rows) < 2:
        raise InputError(
            f"{path}: the table is empty; it needs a header such as 'x [m], mass_per_length "
            "[kg/m], ...' and at least two rows of numbers"
        )
    names, factors = _header(rows[0], columns, path)
    table = [
        _numbers(row, rows[k], names, path, k + 1, k + 2 == len(rows))
        for k, row in enumerate(rows[1:])
    ]
    return {
        name: [float(row[c]) * factors[c] if row[c] else math.nan for row in table]
        for c, name in enumerate(names)
    }


def _limited(reader: Iterable[list[str]], path: Path) -> Iterable[list[str]]:
    for number, row in enumerate(reader):
        if number > MOST_ROWS:
            raise InputError(f"{path}: more than {MOST_ROWS} rows; give a coarser table")
        yield [cell.strip() for cell in row]


def _header(cells: list[str], columns: Sequence[str], path: Path) -> tuple[list[str], list[float]]:
    names: list[str] = []
    factors: list[float] = []
    for cell in cells:
        name, bracket, rest = cell.partition("[")
        name, unit = name.strip(), rest.rstrip("] ").strip()
        _check_column(name, columns, f"{path}: header")
        if name in names:
            raise InputError(f"{path}: header: the column {name} stands there twice; remove one")
        si = COLUMN_UNITS[name.partition(":")[0]]
        try:
            factors.append(unit_factor(unit, si) if bracket else 1.0)
        except ValueError as error:
            raise InputError(f"{path}: header: column {name}: {error}; use e.g. [{si}]") from error
        names.append(name)
    return names, factors


def _check_column(name: str, columns: Sequence[str], where: str) -> None:
    base = name.partition(":")[0]
    if base not in columns or (":" in name and base != "mass_per_length"):
        close = difflib.get_close_matches(base, columns, n=1)
        hint = f"did you mean {close[0]}?" if close else f"allowed are {', '.join(columns)}"
        raise InputError(f"{where}: unknown column {_short(name)}; {hint}")


def _numbers(
    row: list[str], above: list[str], names: list[str], path: Path, number: int, last: bool
) -> list[str]:
    if len(row) != len(names):
        raise InputError(
            f"{path}: row {number} has {len(row)} cells, the header {len(names)}; "
            "give one number a column"
        )
    if last and number > 1:
        row = [cell or up for cell, up in zip(row, above, strict=True)]
    for name, cell in zip(names, row, strict=True):
        try:
            float(cell)
        except ValueError:
            raise InputError(
                f"{path}: row {number}, column {name}: received {_short(cell)}; "
                "give a number (units stand in the header)"
            ) from None
    return row


def override(tables: dict[str, Any], assignments: Iterable[str]) -> None:
    """Apply ``key.subkey=value`` assignments to the tables of a file, in place.

    A value that is not TOML by itself is taken as text: ``condition.speed=100m/s``.
    """
    for assignment in assignments:
        path, equals, text = assignment.partition("=")
        keys = [key.strip() for key in path.split(".")]
        if not equals or not all(keys):
            raise InputError(
                f"--set: received {_short(assignment)}; write it as table.key=value, "
                "e.g. condition.speed=100m/s"
            )
        _assign(tables, keys, _toml_value(text.strip()), assignment)


def _toml_value(text: str) -> object:
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (tomllib.TOMLDecodeError, KeyError, RecursionError):
        return text


def _assign(tables: Any, keys: list[str], value: object, assignment: str) -> None:
    here = tables
    for position, key in enumerate(keys):
        final = position == len(keys) - 1
        if isinstance(here, list):
            if not key.isdigit() or int(key) >= len(here):
                raise InputError(
                    f"--set {_short(assignment)}: {'.'.join(keys[:position])} is a list of "
                    f"{len(here)}; give an index from 0 to {len(here) - 1} in place of '{key}'"
                )
            index: Any = int(key)
        elif isinstance(here, dict):
            index = key
            if not final:
                here.setdefault(key, {})
        else:
            raise InputError(
                f"--set {_short(assignment)}: {'.'.join(keys[:position])} holds a value, "
                "not a table; check the key"
            )
        if final:
            here[index] = value
        else:
            here = here[index]


def validate(model: type[Model], tables: Mapping[str, Any], where: str) -> Model:
    """Check the tables of a file against their model; say the first thing that is wrong.

    Raises
    ------
    InputError
        One sentence: where, key, received, allowed, next step.
    """
    try:
        return model.model_validate(tables)
    except ValidationError as error:
        raise InputError(f"{where}: {_explain(model, error)}") from error
    except RecursionError as error:
        raise InputError(f"{where}: tables are nested too deeply; flatten them") from error


def _explain(model: type[BaseModel], error: ValidationError) -> str:
    problems = error.errors(include_url=False)
    first = min(problems, key=lambda p: (p["type"] != "extra_forbidden", p["type"] == "missing"))
    key = ".".join(str(part) for part in first["loc"] if not _is_tag(part)) or "the file"
    more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
    return _sentence(model, key, first) + more


def _is_tag(part: int | str) -> bool:
    """Tell a union's or validator's tag from a key of the file."""
    return isinstance(part, str) and ("[" in part or "function-" in part)


def _sentence(model: type[BaseModel], key: str, problem: Any) -> str:
    kind, received = problem["type"], _short(problem["input"])
    if kind == "missing":
        return f"{key} is missing; add it ('antinode schema' lists every key with its unit)"
    if kind == "extra_forbidden":
        return f"unknown key {key}; {_suggestion(model, problem['loc'])}"
    context = problem.get("ctx", {})
    bounds = {
        "greater_than": ("greater than", "gt"),
        "greater_than_equal": ("at least", "ge"),
        "less_than": ("less than", "lt"),
        "less_than_equal": ("at most", "le"),
    }
    if kind in bounds:
        words, name = bounds[kind]
        return f"{key} is {received}; it must be {words} {context[name]:g}: correct the value"
    if kind == "literal_error":
        allowed = context["expected"]
        return f"{key} is {received}; allowed are {allowed}: choose one of them"
    if kind == "value_error":
        return f"{key}: {context['error']}"
    if kind == "quantity":
        return f"{key} is {received}; {context['reason']}: correct the value or its unit"
    if kind == "finite_number":
        return f"{key} is {received}; it must be a finite number: correct the value"
    if kind in ("too_short", "tuple_type", "list_type"):
        return f"{key} is {received}; it needs a list with at least one entry: add one"
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        return f"{key} is {received}; it must be a table of keys: write it as [{key}]"
    return f"{key} is {received}; {problem['msg'][0].lower()}{problem['msg'][1:]}: correct it"


def _suggestion(model: type[BaseModel], location: Sequence[int | str]) -> str:
    """Say which keys are allowed where an unknown one stands, nearest first."""
    allowed = sorted(_fields(_model_at(model, location[:-1])))
    close = difflib.get_close_matches(str(location[-1]), allowed, n=1)
    return f"did you mean {close[0]}?" if close else f"allowed are {', '.join(allowed)}"


def _model_at(model: type[BaseModel], location: Sequence[int | str]) -> type[BaseModel]:
    """Follow keys and list indices from a model to the one that they lead to."""
    for part in location:
        if isinstance(part, int) or part not in _fields(model):
            continue
        inner = _inner_model(_fields(model)[part].annotation)
        model = inner or model
    return model


def _fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Return the fields of a model by the names that they have in a file."""
    return {field.alias or name: field for name, field in model.model_fields.items()}


def _inner_model(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    for argument in get_args(annotation):
        found = _inner_model(argument)
        if found:
            return found
    return None


def _short(value: object, most: int = 60) -> str:
    text = value if isinstance(value, str) else repr(value)
    text = " ".join(text.split())
    text = text if len(text) <= most else f"{text[: most - 3]}..."
    return f"'{text}'" if isinstance(value, str) else text
