"""Checking the tables of a file against their model, and saying in one sentence what is wrong.

A sentence names the file, the key as `--set` takes it, the value received, what is allowed and what
to do next.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeVar, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from antinode.errors import InputError
from antinode.text import nearest, short

Checked = TypeVar("Checked", bound=BaseModel)
Location = Sequence[int | str]
Problem = Mapping[str, Any]


def validate(
    model: type[Checked],
    tables: Mapping[str, Any],
    where: str,
    elsewhere: Mapping[str, Path] | None = None,
    rows: Collection[str] = (),
) -> Checked:
    """Check the tables of a file against their model; say the first thing that is wrong.

    Parameters
    ----------
    model : type
        What the tables must be.
    tables : mapping
        As read from the file.
    where : str
        The file, for the message.
    elsewhere : mapping, optional
        Files that tables come from which stand in a file of their own, by the tables' keys.
    rows : collection of str
        Lists whose entries the message calls rows; they, and what a row lists, count from 1.

    Raises
    ------
    InputError
        One sentence: where, key, received, allowed, next step.
    """
    try:
        return model.model_validate(tables)
    except ValidationError as error:
        raise InputError(_explain(model, error, Places(where, elsewhere or {}, rows))) from error
    except RecursionError as error:
        raise InputError(f"{where}: tables are nested too deeply; flatten them") from error


def explained(model: type[BaseModel], error: ValidationError) -> InputError:
    """Return what is wrong with the arguments of a model, for a caller in Python."""
    return InputError(_explain(model, error, Places(f"{model.__name__}(...)", {}, ())))


class Places(NamedTuple):
    """How a message names what is wrong: the file, files of tables, lists of rows."""

    where: str
    elsewhere: Mapping[str, Path]
    rows: Collection[str]

    def of(self, key: str) -> tuple[str, str]:
        """Return where a key stands, down to its row, and the key there."""
        lists = (*self.elsewhere, *self.rows)
        table = next((t for t in lists if key == t or key.startswith(f"{t}.")), None)
        if table is None:
            return self.where, key
        file = self.elsewhere.get(table)
        rest = key[len(table) + 1 :]
        number, _, inside = rest.partition(".")
        if table not in self.rows or not number:
            return (self.where, key) if file is None else (str(file), rest)
        row = f"row {int(number) + 1}"
        names = _INDEX.sub(lambda found: f" {int(found[1]) + 1}", inside).replace(".", ", ")
        return (f"{self.where}: {table}, {row}" if file is None else f"{file}, {row}"), names


_INDEX = re.compile(r"\.(\d+)")


def _explain(model: type[BaseModel], error: ValidationError, places: Places) -> str:
    problems = error.errors(include_url=False)
    first = min(problems, key=lambda p: (p["type"] != "extra_forbidden", p["type"] == "missing"))
    key = key_text(model, first["loc"], unknown=first["type"] == "extra_forbidden")
    where, key = places.of(key)
    others = len(problems) - 1
    more = f" ({others} more problem{'s' * (others > 1)} after this one)" if others else ""
    return f"{where}: {_sentence(model, key, first)}{more}"


def key_text(model: type[BaseModel], location: Location, *, unknown: bool = False) -> str:
    """Write where a problem is, as `--set` takes it: ``vehicle.fins.0.thickness``.

    Names that a file does not have (tags of unions, the mass state "initial") are left out.

    Parameters
    ----------
    model : type
        From which the location leads on.
    location : sequence of int or str
        As pydantic gives it.
    unknown : bool
        Whether the last part is a key that the model does not have.
    """
    here: Any = model
    keys: list[str] = []
    for number, part in enumerate(location, 1):
        inner = _inner_model(here)
        if isinstance(part, int) or (unknown and number == len(location)):
            keys.append(str(part))
        elif inner and part in _fields(inner):
            keys.append(part)
            here = _fields(inner)[part].annotation
        elif get_origin(here) is dict and part != "initial":
            keys[-1] += f":{part}"
    return ".".join(keys)


def _sentence(model: type[BaseModel], key: str, problem: Problem) -> str:
    """Say what is wrong with a key."""
    kind, context = problem["type"], problem.get("ctx", {})
    if kind == "missing":
        return f"{key} is missing; add it ('antinode schema' lists every key with its unit)"
    if kind == "extra_forbidden":
        return f"unknown key {short(key)[1:-1]}; {_suggestion(model, problem['loc'])}"
    if kind in _NO_LIST and isinstance(problem["input"], Mapping) and _of_tables(model, problem):
        return (
            f"{key} is one table, but there may be several: write [[{key}]], in double brackets, "
            "above each"
        )
    if kind == "value_error":
        return f"{key}: {context['error']}" if key else str(context["error"])
    if kind in _ALLOWED:
        say = _meant(problem["input"], context) + _ALLOWED[kind].format_map(context)
    else:
        say = f"{problem['msg'][:1].lower()}{problem['msg'][1:]}: correct it"
    return f"{key or 'this'} is {short(problem['input'])}; {say}"


def _of_tables(model: type[BaseModel], problem: Problem) -> bool:
    """Tell whether the place of a problem wants a list of tables."""
    inner: type[BaseModel] | None = model
    for part in problem["loc"]:
        field = None if inner is None else _fields(inner).get(str(part))
        if field is None:
            return False
        inner = _inner_model(field.annotation)
    return inner is not None


_NO_LIST = ("tuple_type", "list_type")
_LIST = "it must be a list of at least one entry: write [ ... ], or [[...]] for tables"
_TABLE = "it must be a table of keys: correct it"
_WHOLE = "it must be a whole number: correct it"
_ALLOWED = {
    "greater_than": "it must be greater than {gt:g}: correct the value",
    "greater_than_equal": "it must be at least {ge:g}: correct the value",
    "less_than": "it must be less than {lt:g}: correct the value",
    "less_than_equal": "it must be at most {le:g}: correct the value",
    "literal_error": "allowed are {expected}: choose one of them",
    "quantity": "{reason}: correct the value or its unit",
    "finite_number": "it must be a finite number: correct the value",
    "too_short": _LIST,
    "tuple_type": _LIST,
    "list_type": _LIST,
    "model_type": _TABLE,
    "model_attributes_type": _TABLE,
    "dict_type": _TABLE,
    "int_type": _WHOLE,
    "int_from_float": _WHOLE,
    "int_parsing": _WHOLE,
    "string_type": "it must be a text in quotes: correct it",
    "string_too_long": "it may have {max_length} characters at most: shorten it",
    "bool_type": "it must be true or false: choose one of them",
    "bool_parsing": "it must be true or false: choose one of them",
}
"""What is allowed and what to do next, by pydantic's kind of problem."""


_SAME = {
    "fixed": ("clamped", "fixed"),
    "built-in": ("clamped", "fixed"),
    "encastre": ("clamped",),
    "cantilever": ("clamped",),
    "clamped": ("fixed",),
    "hinged": ("pinned", "free"),
    "simply supported": ("pinned",),
    "supported": ("pinned",),
    "ss": ("pinned",),
    "roller": ("pinned",),
    "pinned": ("fixed",),
    "guided": ("sliding",),
    "symmetric": ("sliding",),
    "none": ("free",),
    "constant": ("step",),
    "stepped": ("step",),
    "logarithmic": ("log",),
    "exponential": ("log",),
}
"""What others call the words that a key allows."""


def _meant(value: object, context: Mapping[str, Any]) -> str:
    """Ask for the allowed word that another one likely means."""
    allowed = re.findall("'([^']*)'", str(context.get("expected", "")))
    if not isinstance(value, str) or not allowed:
        return ""
    word = value.strip().lower().replace("_", " ")
    near = [*_SAME.get(word, ()), *difflib.get_close_matches(word, allowed, n=1)]
    found = next((name for name in near if name in allowed), None)
    return f"did you mean '{found}'? " if found else ""


def _suggestion(model: type[BaseModel], location: Location) -> str:
    """Say which keys are allowed where an unknown one stands, nearest first.

    A key that stands deeper in the file is named with its tables.
    """
    for part in location[:-1]:
        if part in _fields(model):
            model = _inner_model(_fields(model)[str(part)].annotation) or model
    name = str(location[-1])
    if deeper := next(_paths_to(name, model, ()), None):
        return f"did you mean {deeper}?"
    return nearest(name, sorted(_fields(model)))


def _paths_to(name: str, model: type[BaseModel], path: tuple[str, ...]) -> Iterator[str]:
    """Yield the dotted paths to a key that stands deeper in a model, nearest first."""
    inner = {key: _inner_model(field.annotation) for key, field in _fields(model).items()}
    tables = {key: found for key, found in inner.items() if found is not None}
    for key, found in tables.items():
        if name in _fields(found):
            entry = (".0",) if get_origin(_fields(model)[key].annotation) is tuple else ("",)
            yield ".".join((*path, f"{key}{entry[0]}", name))
    if len(path) < _DEEP:
        for key, found in tables.items():
            if get_origin(_fields(model)[key].annotation) is not tuple:
                yield from _paths_to(name, found, (*path, key))


_DEEP = 3


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
