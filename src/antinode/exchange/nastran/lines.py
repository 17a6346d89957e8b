"""The lines of a NASTRAN file and of those that it includes, without comments.

A path stands relative to the file that includes it, or else to the deck; backslashes are slashes,
and a quoted path may run over several lines. What is included before BEGIN BULK directs a solver:
where it is not there it is passed over.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from antinode.errors import InputError
from antinode.inputs.reading import read_bytes
from antinode.text import short

MOST_BYTES = 20_000_000
"""Of a file, and of all that it includes together."""
_MOST_INCLUDES = 500
_DEEPEST = 50
_INCLUDE = re.compile(r"\s*INCLUDE\s+(.+)", re.I)


@dataclass(frozen=True)
class Line:
    """A line without its comment, and where it stands."""

    path: Path
    number: int
    text: str

    def error(self, what: str) -> InputError:
        """Return what is wrong with the line as an error that names it."""
        return InputError(f"{self.path}, line {self.number}: {what}")


@dataclass
class Source:
    """A deck whose lines are read, and what of it is not there.

    Attributes
    ----------
    path : Path
    missing : list of str
        Included files that direct a solver, and are not there.
    """

    path: Path
    missing: list[str] = field(default_factory=list)
    _bytes: int = 0
    _count: int = 0
    _in_bulk: bool = False

    def lines(self) -> list[Line]:
        """Return all lines, those of included files where they are included.

        Raises
        ------
        InputError
            If a file cannot be read.
        """
        return list(self._of(self.path, [self.path]))

    def _of(self, path: Path, above: list[Path]) -> Iterator[Line]:
        data = read_bytes(path, MOST_BYTES, "a NASTRAN file")
        self._bytes += len(data)
        numbered = enumerate(data.decode("utf-8", errors="replace").splitlines(), 1)
        for number, whole in numbered:
            line = Line(path, number, whole.partition("$")[0].rstrip())
            if not (include := _INCLUDE.match(line.text)):
                self._in_bulk |= begins_bulk(line.text)
                yield line
                continue
            name = include[1].strip()
            while name[0] in "'\"" and name.count(name[0]) < 2:  # it goes on in the next line
                more = next(numbered, None)
                if more is None or len(name) > 1000:
                    raise line.error("the quoted path of INCLUDE is not closed; close it")
                name += more[1].partition("$")[0].strip()
            if other := self._found(line, name.strip("'\" ").replace("\\", "/"), above):
                yield from self._of(other, [*above, other])

    def _found(self, line: Line, name: str, above: list[Path]) -> Path | None:
        """Return the file of an INCLUDE; None for one that is not there, and not needed."""
        here = (folder / name for folder in (line.path.parent, self.path.parent))
        other = next((path for path in here if _is_file(path)), None)
        if other is None and not self._in_bulk and len(above) == 1 and _has_bulk(self.path):
            self.missing.append(name)
            return None
        if other is None:
            raise line.error(f"INCLUDE: there is no file {short(name)} beside it; put it there")
        if other in above or len(above) > _DEEPEST:
            raise line.error(f"INCLUDE of {short(str(other))} goes round in a circle")
        self._count += 1
        if self._count > _MOST_INCLUDES or self._bytes > MOST_BYTES:
            raise line.error(
                f"more than {_MOST_INCLUDES} files, or {MOST_BYTES / 1e6:g} MB, are included; "
                "write out the beam alone"
            )
        return other


def begins_bulk(text: str) -> bool:
    """Tell whether a line begins the bulk data."""
    words = text.upper().split()
    return words in (["BEGIN"], ["BEGINBULK"], ["BEGIN_BULK"]) or words[:2] == ["BEGIN", "BULK"]


def _has_bulk(path: Path) -> bool:
    text = read_bytes(path, MOST_BYTES, "a NASTRAN file").decode("utf-8", errors="replace")
    return any(begins_bulk(line.partition("$")[0]) for line in text.splitlines())


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
