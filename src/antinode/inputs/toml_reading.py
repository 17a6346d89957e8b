"""TOML parsed within bounds: a small text cannot fill the memory by keys of keys of keys.

The parser of the standard library takes a kilobyte, and time, for each level of each key. So the
levels are counted before it sees the text.
"""

from __future__ import annotations

import re
import tomllib
from typing import Any

from antinode.text import one_line

DEEPEST = 10
"""Levels of a key, and of lists and tables in one another."""
MOST_LEVELS = 20_000
"""Of all keys that have three levels or more, together."""

_TEXTS = re.compile(
    r"(\"\"\"(?:[^\\]|\\.)*?(?:\"\"\"|\Z)"
    r"|'''.*?(?:'''|\Z)"
    r"|\"(?:[^\"\\\n]|\\.)*\"?"
    r"|'[^'\n]*'?)"
    r"|#[^\n]*",
    re.DOTALL,
)
"""Texts in quotes, closed or not, and comments: what dots and brackets do not count in."""
_KEY = re.compile(r"(?<![\w-])[\w-]++(?:[ \t]*+\.[ \t]*+[\w-]++){2,}")


def parse_toml(text: str) -> dict[str, Any]:
    """Return the tables of a TOML text.

    Raises
    ------
    ValueError
        If it is no TOML, or nested too deeply; the text says why, without an end.
    """
    _check_depth(text)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ValueError(one_line(f"{error}{_hint(text, str(error))}", 300)) from error
    except RecursionError:
        raise ValueError(_DEEP) from None
    except ValueError as error:
        raise ValueError("one of its numbers has thousands of digits") from error


_TYPED = (
    (re.compile("[\u201c\u201d\u201e\u2018\u2019]"), "use straight quotes, not typographic ones"),
    (
        re.compile(r'"[^"]*\\'),
        "a text with a backslash stands in single quotes, 'C:\\folder', or is written with /",
    ),
    (re.compile(r"=\s*[+-]?\d+,\d"), "a number has a point, 2.5, or stands in quotes, '2,5'"),
    (
        re.compile(r"=\s*[+-]?[\d.]+\s*[^\W\d_%]"),
        "a number with a unit stands in quotes, '80 m/s'",
    ),
    (re.compile(r"^\s*(?:%|//|!)"), "a comment begins with #"),
    (
        re.compile("[\u200b\u200c\u200d\ufeff]"),
        "a character that is not seen stands there: type it anew",
    ),
    (re.compile("[\u2212\uff0c\uff1d\u2013]"), "use plain - and , and ="),
    (re.compile(r"^\s*[^=\[]*[\[(][^=]*[\])]\s*="), 'put a key with a unit in quotes, "x [mm]"'),
    (re.compile(r"[\d.][dD][+-]?\d"), "an exponent begins with e, 1.0e6"),
    (re.compile(r"\d\s*(?:\*|\^|x\s*10)"), "a power of ten is written 1e6"),
    (
        re.compile(r"(?:=|\[|,)\s*[+-]?(?:\.\d|\d+\.(?!\d))"),
        "a point has digits on both sides: 0.5, 5.0",
    ),
    (re.compile(r"\[[^\]]*[\d\"']\s*;"), "commas separate the values of a list"),
    (re.compile(r"\[[^\]]*\d\s+[+-]?[\d.]"), "commas separate the values of a list"),
    (re.compile(r"=\s*(?:True|False)\b"), "write true or false"),
    (re.compile(r"^[^=:]*:"), "a value follows '=', not ':'"),
    (re.compile(r"=\s*[A-Za-z]"), "a text stands in quotes"),
)
"""What people write that is no TOML, and what to write in its place."""


def _hint(text: str, error: str) -> str:
    """Return what to write in place of the line that an error names."""
    found = re.search(r"at line (\d+)", error)
    lines = text.splitlines()
    number = int(found[1]) if found else len(lines)
    line = lines[number - 1] if 0 < number <= len(lines) else ""
    return next((f": {say}" for typed, say in _TYPED if typed.search(line)), "")


_DEEP = f"its values are nested too deeply, at most {DEEPEST} levels are allowed"


def _check_depth(text: str) -> None:
    """Raise ValueError if keys, or lists in lists, have too many levels."""
    bare = _TEXTS.sub(lambda found: "s" if found[1] else "", text)
    levels = [found[0].count(".") + 1 for found in _KEY.finditer(bare)]
    if max(levels, default=0) > DEEPEST:
        raise ValueError(f"one of its keys has {max(levels)} levels, at most {DEEPEST} are allowed")
    if sum(levels) > MOST_LEVELS:
        raise ValueError(
            f"its keys have {sum(levels)} levels together, at most {MOST_LEVELS} may be"
        )
    depth = 0
    for bracket in re.findall(r"[\[\]{}]", bare):
        depth += 1 if bracket in "[{" else -1
        if depth > DEEPEST:
            raise ValueError(_DEEP)
