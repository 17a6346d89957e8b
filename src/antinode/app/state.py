"""What a page shows, as a value: the file, what was changed of it, how to look at it.

Pure: no browser and no disk. A state gives the problem to solve, a link that brings it back, and a
file to save.
"""

from __future__ import annotations

import base64
import hashlib
import json
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Any, Literal, Self

from pydantic import Field

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FamilyName
from antinode.beam.file import BeamFile
from antinode.beam.limits import check_limits
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.inputs.reading import naming
from antinode.inputs.toml_reading import parse_toml
from antinode.inputs.toml_writing import plain
from antinode.inputs.units import Frozen
from antinode.vehicle.case import Case

from .asked import Asked
from .display import System
from .inputs import Problem

Value = float | int | str | bool | None | list[Any] | dict[str, Any]
Tables = Mapping[str, Any]

LONGEST_LINK = 16_000
"""Characters of a link; a larger case has to be saved as a file."""
_MOST_UNPACKED = 2_000_000
_TELLING = 12  # characters of a fingerprint in a link


Panel = Literal["characteristic", "mode", "response", "effects", "ends", "stability", "compare"]


class View(Frozen):
    """How a page looks at its problem."""

    units: System = "SI"
    dark: bool | None = None
    family: FamilyName = BENDING
    component: int = 0
    modes: tuple[int, ...] = (1, 2, 3)
    body: int = 1
    curve: str = ""
    panel: Panel = "characteristic"
    response: Asked = Asked()
    sliders: Annotated[tuple[str, ...], Field(max_length=30)] = ()
    band: tuple[float, float] | None = None
    lines: tuple[float, ...] = ()
    margin: float = 0.05
    baseline: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class File:
    """A case or beam file as tables, its stations with them.

    Parameters
    ----------
    tables : mapping
        As read.
    origin : str
        Name of the file, for messages.
    own : bool
        Whether the server was started with it: a link need not hold it.
    text : str
        The file as it is written, whose comments a saved one keeps; empty where it is not known.
    """

    tables: Tables
    origin: str
    own: bool = True
    text: str = ""

    @cached_property
    def fingerprint(self) -> str:
        """What tells this file from others."""
        return hashlib.sha256(json.dumps(plain(self.tables)).encode()).hexdigest()

    @cached_property
    def checked(self) -> tuple[Problem, Beam]:
        """The case or the beam file, and its beam.

        Raises
        ------
        InputError
            If a value is wrong.
        """
        return _checked(self.tables, self.origin)

    def packed(self) -> str:
        """Return the file for a link, as it is written too where that is short enough."""
        data = {"origin": self.origin, "tables": self.tables}
        whole = packed({**data, "text": self.text})
        return whole if len(whole) < LONGEST_LINK // 2 else packed(data)


def _checked(tables: Tables, where: str) -> tuple[Problem, Beam]:
    """Return the case or the beam file of some tables, and its beam."""
    model: type[Case] | type[BeamFile] = Case if "vehicle" in tables else BeamFile
    problem = validate(model, tables, where)
    with naming(where):
        beam = problem.beam()
        if isinstance(problem, BeamFile):  # a case's own is checked as it is built
            check_limits(beam)
    return problem, beam


_VIEW = View()


@dataclass(frozen=True)
class State:
    """A file, what was changed of it, and how to look at it.

    Parameters
    ----------
    file : File
    changes : mapping
        New values by their paths, as `--set` takes them; None takes a key out.
    view : View
    """

    file: File
    changes: Mapping[str, Value] = field(default_factory=dict)
    view: View = _VIEW

    @property
    def is_vehicle(self) -> bool:
        """Whether the file describes a vehicle in a condition."""
        return "vehicle" in self.file.tables

    def changed(self, changes: Mapping[str, Value]) -> Self:
        """Return the state with further values changed; a table takes the place of its entries."""
        inside = tuple(f"{path}." for path in changes)
        kept = {
            path: value
            for path, value in self.changes.items()
            if path not in changes and not path.startswith(inside)
        }
        return replace(self, changes=kept | dict(changes))

    def viewed(self, **how: Any) -> Self:
        """Return the state looked at in another way."""
        return replace(self, view=View.model_validate(self.view.model_dump() | how))

    @property
    def problem(self) -> Problem:
        """The case or the beam file with all changes.

        Raises
        ------
        InputError
            If a value is wrong: the sentence of the command line.
        """
        return self._solvable[0]

    @property
    def beam(self) -> Beam:
        """The beam of the problem."""
        return self._solvable[1]

    @cached_property
    def _solvable(self) -> tuple[Problem, Beam]:
        if not self.changes:
            return self.file.checked
        tables = with_changes(self.file.tables, self.changes)
        return _checked(tables, f"{self.file.origin} (with --set)")

    @property
    def original(self) -> Problem:
        """The case or the beam file as it was opened."""
        return self.file.checked[0]

    @property
    def families(self) -> tuple[FamilyName, ...]:
        """The families of modes that the file as it was opened has the columns for."""
        return self.file.checked[1].families

    @cached_property
    def key(self) -> str:
        """What the numbers depend on, as a text."""
        changes = json.dumps(plain(self.changes), sort_keys=True)
        return f"{self.file.origin} {self.file.fingerprint} {changes}"

    # --- links --------------------------------------------------------------------------------

    def query(self) -> dict[str, str]:
        """Return what a link must hold to bring the state back, as parameters of a URL.

        Raises
        ------
        InputError
            If it would be too long.
        """
        found: dict[str, str] = {}
        if not self.file.own:
            found["case"] = self.file.packed()
        if self.changes:
            found["set"] = _changes_text(self.changes)
        how = self.view.model_dump(exclude_defaults=True)
        if self.file.own and (self.changes or how):
            found["file"] = self.file.fingerprint[:_TELLING]
        found |= {key: json.dumps(value, separators=(",", ":")) for key, value in how.items()}
        if sum(map(len, found.values())) > LONGEST_LINK:
            raise InputError("this case is too large for a link; save it as a file instead")
        return found

    def from_query(self, query: Mapping[str, str]) -> Self:
        """Return the state that a link describes, this one being what the server was started with.

        Raises
        ------
        InputError
            If the link is damaged.
        """
        state = self
        if "case" in query:
            state = state._opened(query["case"])
        elif query.get("file", "") not in ("", self.file.fingerprint[:_TELLING]):
            raise InputError(
                f"the link belongs to another file than {self.file.origin}, which this server "
                "shows: start antinode app with that file, or save the case there and drop it here"
            )
        if "set" in query:
            state = replace(state, changes=_read_changes(query["set"]))
        how = {key: query[key] for key in View.model_fields if key in query}
        try:
            values = {key: json.loads(text) for key, text in how.items()}
            return replace(state, view=View.model_validate(values))
        except (ValueError, RecursionError) as error:
            raise InputError("the link is damaged: its view cannot be read; check it") from error

    def _opened(self, text: str) -> Self:
        data = unpacked(text)
        tables = data.get("tables") if isinstance(data, dict) else None
        if not isinstance(tables, dict) or not {"vehicle", "beam"} & set(tables):
            raise InputError("the link is damaged: it holds no case; check it")
        name = str(data.get("origin", "link"))[:100]
        file = File(tables, name, own=False, text=_toml_or_nothing(data.get("text")))
        return replace(self, file=file, changes={})


def _toml_or_nothing(text: object) -> str:
    """Return the text of a file that a link brings, if it is one."""
    try:
        parse_toml(str(text))
    except ValueError:
        return ""
    return str(text)


def _changes_text(changes: Mapping[str, Value]) -> str:
    """Write changes for a link: plain where they are short, packed where tables are among them."""
    text = json.dumps(plain(changes), separators=(",", ":"))
    return text if len(text) < 500 else packed(changes)


def _read_changes(text: str) -> dict[str, Value]:
    try:
        changes = json.loads(text) if text.startswith("{") else unpacked(text)
    except (ValueError, RecursionError) as error:
        raise InputError("the link is damaged: its values cannot be read; check it") from error
    if not isinstance(changes, dict):
        raise InputError("the link is damaged: its values cannot be read; check it")
    return changes


def packed(data: object) -> str:
    """Return data as a short text that a URL can hold."""
    raw = json.dumps(plain(data), separators=(",", ":")).encode()
    return base64.urlsafe_b64encode(zlib.compress(raw, 9)).decode().rstrip("=")


def unpacked(text: str) -> Any:
    """Return what was packed; never more than two megabytes of it.

    Raises
    ------
    InputError
        If the text is damaged.
    """
    try:
        raw = base64.urlsafe_b64decode(text + "=" * (-len(text) % 4))
        unpacker = zlib.decompressobj()
        content = unpacker.decompress(raw, _MOST_UNPACKED)
        if unpacker.unconsumed_tail:
            raise ValueError("too large")
        return json.loads(content)
    except (ValueError, zlib.error, RecursionError) as error:
        raise InputError("the link is damaged: it cannot be unpacked; check it") from error


# --- changes of tables ----------------------------------------------------------------------


def with_changes(tables: Tables, changes: Mapping[str, Value]) -> dict[str, Any]:
    """Return tables with values changed; the given ones stay as they are.

    Raises
    ------
    InputError
        If a path leads nowhere.
    """
    result: Any = dict(tables)
    for path, value in changes.items():
        result = _replaced(result, path.split("."), value, path)
    return dict(result)


def _replaced(node: Any, keys: list[str], value: Value, path: str) -> Any:
    key, rest = keys[0], keys[1:]
    if isinstance(node, Mapping):
        if not rest and value is None:
            return {name: inner for name, inner in node.items() if name != key}
        inner = value if not rest else _replaced(node.get(key, {}), rest, value, path)
        return {**node, key: inner}
    if isinstance(node, list | tuple):
        index = int(key) if key.isascii() and key.isdigit() and len(key) < 9 else -1
        if 0 <= index < len(node):
            inner = value if not rest else _replaced(node[index], rest, value, path)
            return [*node[:index], inner, *node[index + 1 :]]
    raise InputError(f"{path[:60]} leads nowhere; check the key")


# --- undo -------------------------------------------------------------------------------------


class History:
    """A state with those before it; moves of one slider in a row are one step."""

    _MOST = 200

    def __init__(self, state: State) -> None:
        self.state = state
        self._before: list[State] = []
        self._gesture = ""

    def put(self, state: State, gesture: str = "") -> None:
        """Take a new state; states of the same `gesture` in a row count as one step."""
        if (state.file, state.changes) == (self.state.file, self.state.changes):
            self.state = state
            return
        if not gesture or gesture != self._gesture:
            self._before = [*self._before[-self._MOST :], self.state]
        self._gesture = gesture
        self.state = state

    def look(self, state: State) -> None:
        """Take a state that only looks at the same problem in another way: no step to undo."""
        self.state = state

    def end_gesture(self) -> None:
        """Let the next move be a step of its own."""
        self._gesture = ""

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to take back."""
        return bool(self._before)

    def undo(self) -> State:
        """Take the last step back; the way of looking stays."""
        if self._before:
            view = self.state.view
            self.state = replace(self._before.pop(), view=view)
            self._gesture = ""
        return self.state


def fields_of(error: str, paths: tuple[str, ...]) -> str:
    """Return the path of the field that an error speaks of; empty if of none."""
    named = [path for path in paths if path in error or path.rpartition(".")[2] in error]
    return max(named, key=lambda path: (path in error, len(path)), default="")
