"""What a report is made of, whatever it is printed as: sections of paragraphs, tables, figures."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, ClassVar, Literal

_CODE = re.compile(r"`([^`]+)`")
_SYMBOL = re.compile(r"(?<![\w.])((?:[^\W\d_]|[A-Z][a-z])'*)_([^\W_]+)\b")
_GREEK = {
    "alpha": "α",
    "beta": "β",
    "delta": "δ",
    "lambda": "λ",
    "mu": "μ",
    "omega": "ω",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "theta": "θ",
}
_LETTER = re.compile(rf"(?<![^\W\d_])({'|'.join(_GREEK)})(?![^\W\d_])")
_POWER = re.compile(r"\^(-?\d+)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Run:
    """A piece of text of one kind; a symbol has an index."""

    kind: Literal["text", "symbol", "code"]
    text: str
    index: str = ""


def runs(text: str) -> tuple[Run, ...]:
    """Split a text into words, symbols such as ``F_CX`` and `code` in backticks.

    Powers are raised, and Greek letters stand for their names.
    """
    found: list[Run] = []
    for number, piece in enumerate(_CODE.split(text)):
        if number % 2:
            found.append(Run("code", piece))
        else:
            piece = _LETTER.sub(lambda m: _GREEK[m[1]], piece)
            found += _symbols(_POWER.sub(lambda m: m[1].translate(_RAISED), piece))
    return tuple(run for run in found if run.text)


def _symbols(text: str) -> list[Run]:
    pieces = _SYMBOL.split(text)
    found = []
    for k in range(0, len(pieces) - 1, 3):
        found += [Run("text", pieces[k]), Run("symbol", pieces[k + 1], pieces[k + 2])]
    return [*found, Run("text", pieces[-1])]


@dataclass(frozen=True)
class Paragraph:
    """Running text."""

    kind: ClassVar[str] = "paragraph"
    text: tuple[Run, ...]


@dataclass(frozen=True)
class Bullets:
    """A list of short statements."""

    kind: ClassVar[str] = "bullets"
    items: tuple[tuple[Run, ...], ...]


@dataclass(frozen=True)
class Equation:
    """A formula: as text for HTML, and as typst sets it."""

    kind: ClassVar[str] = "equation"
    text: tuple[Run, ...]
    typst: str


@dataclass(frozen=True)
class Warnings:
    """What a reader must know before trusting a number."""

    kind: ClassVar[str] = "warnings"
    items: tuple[tuple[Run, ...], ...]


@dataclass(frozen=True)
class Table:
    """Rows of cells; a column is set left or right, a marked row stands out."""

    kind: ClassVar[str] = "table"
    caption: tuple[Run, ...]
    head: tuple[tuple[Run, ...], ...]
    rows: tuple[tuple[tuple[Run, ...], ...], ...]
    left: tuple[bool, ...]
    marked: tuple[bool, ...]
    wide: tuple[int, ...]
    """Shares of the room that is left which columns of words take; 0 for all others."""


@dataclass(frozen=True)
class Figure:
    """A drawing, as SVG, with its caption."""

    kind: ClassVar[str] = "figure"
    name: str
    svg: str = field(repr=False)
    caption: tuple[Run, ...] = ()


Block = Paragraph | Bullets | Equation | Warnings | Table | Figure


@dataclass(frozen=True)
class Section:
    """A heading with what stands below it; a level of 2 is a part of the one before."""

    title: str
    blocks: tuple[Block, ...]
    level: int = 1


@dataclass(frozen=True)
class Document:
    """A whole report.

    Attributes
    ----------
    title, subtitle : str
    facts : tuple
        Pairs of what stands under the title, such as the version.
    brief : tuple
        The result in a few sentences.
    sections : tuple of Section
    date : str
        As YYYY-MM-DD.
    """

    title: str
    subtitle: str
    facts: tuple[tuple[str, str], ...]
    brief: tuple[tuple[Run, ...], ...]
    sections: tuple[Section, ...]
    date: str

    def figures(self) -> list[Figure]:
        """Return all figures in their order."""
        blocks = [block for section in self.sections for block in section.blocks]
        return [block for block in blocks if isinstance(block, Figure)]

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain lists and texts, without the drawings."""
        data = asdict(self)
        for section, plain in zip(self.sections, data["sections"], strict=True):
            for block, each in zip(section.blocks, plain["blocks"], strict=True):
                each["kind"] = block.kind
                each.pop("svg", None)
        return data


def paragraph(text: str) -> Paragraph:
    """Return running text."""
    return Paragraph(runs(text))


def bullets(items: Sequence[str]) -> Bullets:
    """Return a list."""
    return Bullets(tuple(map(runs, items)))


def warnings(items: Sequence[str]) -> Warnings:
    """Return warnings."""
    return Warnings(tuple(map(runs, items)))


def table(
    caption: str,
    head: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    left: Sequence[int] = (0,),
    marked: Sequence[int] = (),
    wide: Sequence[int] = (),
) -> Table:
    """Return a table.

    Parameters
    ----------
    caption : str
    head : sequence of str
        One for each column.
    rows : sequence of sequences of str
    left, wide : sequence of int
        Columns of words; those of long texts, once for every share of the room that is left.
    marked : sequence of int
        Rows that stand out.
    """
    columns = range(len(head))
    return Table(
        caption=runs(caption),
        head=tuple(map(runs, head)),
        rows=tuple(tuple(map(runs, row)) for row in rows),
        left=tuple(k in left or k in wide for k in columns),
        marked=tuple(k in marked for k in range(len(rows))),
        wide=tuple(wide.count(k) for k in columns),
    )
