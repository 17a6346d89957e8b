"""Every measured number that the documents state, and what holds it: a record, a test, a constant.

    python -m validation.claims

writes claims.md from claims.toml; `tests/docs/test_claims.py` fails where a number has no tie, if
a tie's file no longer says it, and where the page says more than the file.

A measured number is one in prose with a unit of accuracy, speed or result (%, times, s, Hz, 1e-9,
... ). It is held where a block of the same page shows it, since these are compared with what
is printed; else claims.toml has its words, the file that holds it and the words there. A number of
the page must stand in these words, rounded; with ``bound``, the file may say less: it is the
worst allowed.
"""

import math
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TABLE, PAGE = ROOT / "validation" / "claims.toml", ROOT / "validation" / "claims.md"
KINDS = {"validation": "record", "benchmarks": "record", "tests": "test", "src": "program"}
UNITS = {"%": 1e-2, "ms": 1e-3, "µs": 1e-6, "ns": 1e-9, "kHz": 1e3, "million": 1e6}
UNITS |= {"MB": 1e6, "GB": 1e9, "GiB": 2**30}
NUMBER = r"(?<![\w.^/])[-+±]?\d[\d,_]*(?:\.\d+)?(?:e[-+]?\d+)?"
UNIT = r"%|ms|µs|ns|s(?! [MC] )|seconds|minutes|hours|times|digits|MB|GB|GiB|Hz|kHz|dB|million"
MEASURED = re.compile(
    rf"({NUMBER})(?:\s({UNIT})(?![\w^/])|(?<=e[-+]\d)|(?<=e[-+]\d\d))"
    rf"|({NUMBER}) random\b|({NUMBER}) of \d"
)


TABLES = {
    "docs/paper.md": ("validation/paper_readings.md",),
    "docs/theory/riccati.md": ("validation/literal_methods.md",),
}
"""Pages whose tables hold rows of a record, and that record."""


@dataclass(frozen=True)
class Tie:
    """Words of a page, the file that holds them, the words there, and how to read its numbers."""

    page: str
    quote: str
    file: str
    says: str
    options: tuple = ()

    @property
    def kind(self):
        return KINDS.get(self.file.partition("/")[0], "document")

    @property
    def bound(self):
        """Whether the page may say more than the file: the worst that is allowed."""
        return "bound" in self.options

    def said(self):
        """Return the numbers of the file's words, in plain units."""
        if self.file == "worked":
            result = eval(self.says, {"__builtins__": {}, "pi": math.pi})
            given = [float(each) for each in re.findall(r"\d+\.?\d*(?:e-\d+)?", self.says)]
            return [result, *given, *(each / 100 for each in given)]
        units = [UNITS.get(o) or float(o) for o in self.options if o not in ("bound", "rest")]
        found = [value(*each) * (units or [1.0])[0] for each in numbers(self.says)]
        return [1 - each for each in found] if "rest" in self.options else found

    def stands(self):
        """Whether the file still has these words; of a worked one, the page its numbers."""
        if self.file == "worked":
            whole = (ROOT / self.page).read_text(encoding="utf-8").replace(",", "")
            return all(re.search(rf"(?<![\d.]){re.escape(n)}(?!\d)", whole)
                       for n in re.findall(r"\d+\.\d+", self.says))  # fmt: skip
        return plain(self.says) in plain((ROOT / self.file).read_text(encoding="utf-8"))


def plain(text):
    """Return a text with single spaces and without marks of comments."""
    return " ".join(re.sub(r"^\s*#", " # ", text, flags=re.M).split())


def pages():
    """Return the documents that may claim: README, and docs but for decisions."""
    found = [p for p in (ROOT / "docs").rglob("*.md") if p.parent.name != "adr"]
    return sorted(p.relative_to(ROOT).as_posix() for p in [ROOT / "README.md", *found])


def rows_of(page):
    """Return what stands in the rows of a page's tables, without spaces and marks."""
    lines = (ROOT / page).read_text(encoding="utf-8").splitlines()
    return [[re.sub("[`*]", "", c).strip() for c in line.strip().strip("|").split("|")]
            for line in lines if line.startswith("|")]  # fmt: skip


def ties():
    """Return what claims.toml says."""
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    return [
        Tie(page, quote, *row[:2], tuple(row[2:]))
        for page, rows in table.items()
        for quote, *row in rows
    ]


def split(page):
    """Return the prose of a page without code, made one line, and its blocks."""
    text = (ROOT / page).read_text(encoding="utf-8")
    for record in TABLES.get(page, ()):
        known = {tuple(row) for row in rows_of(record)} | {tuple(r[1:]) for r in rows_of(record)}
        kept = [line for line in text.splitlines() if not line.startswith("|")
                or tuple(c.strip() for c in line.strip("|").split("|")) not in known]  # fmt: skip
        text = "\n".join(kept)
    blocks = re.findall(r"^```.*?^```", text, flags=re.M | re.S)
    fenced = [block for block in blocks if not block.startswith("```math")]
    text = re.sub(r"^```.*?^```", "\n", text, flags=re.M | re.S)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return " ".join(text.split()), "\n".join(fenced)


def value(number, unit=None):
    """Return a number as it was written, in plain units."""
    return abs(float(re.sub("[,_±]", "", number))) * UNITS.get(unit or "", 1.0)


def rounding(number, unit=None):
    """Return half a unit of the last digit that was written."""
    mantissa, _, exponent = number.replace(",", "").partition("e")
    return 0.501 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])) * UNITS.get(
        unit or "", 1.0
    )  # fmt: skip


def numbers(text):
    """Return the numbers of a text with their units."""
    return re.findall(rf"({NUMBER})\s?({UNIT})?(?![\w^])", text)


def holds(tie):
    """Return the measured numbers of a tie's quote that the words of its file do not hold."""
    said, missing = tie.said(), []
    for number, unit in measured(tie.quote):
        mine, room = value(number, unit), rounding(number, unit)
        near = any(abs(mine - each) <= room for each in said)
        if not near and not (tie.bound and any(each <= mine + room for each in said)):
            missing.append(f"{number} {unit}".strip())
    return missing


def measured(text):
    """Return the measured numbers of a text, with their units."""
    found = MEASURED.finditer(text)
    return [(each[1] or each[3] or each[4], each[2] or "") for each in found]


def untied(page, table):
    """Return the measured numbers of a page, with the words around, that nothing holds."""
    prose, fenced = split(page)
    code = [m.span() for m in re.finditer(r"`[^`]*`", prose)]
    spans = [m.span() for tie in table if tie.page == page
             for m in re.finditer(re.escape(tie.quote), prose)]  # fmt: skip
    found = []
    for match in MEASURED.finditer(prose):
        inside = any(a <= match.start() and match.end() <= b for a, b in [*code, *spans])
        if not inside and not shown(match[1] or match[3] or match[4], match[2] or "", fenced):
            around = prose[max(0, match.start() - 90) : match.end() + 40]
            found.append((match[0], around))
    return found


def shown(number, unit, fenced):
    """Whether a block shows it: with its unit or exponent, or alone if it has three digits."""
    digits = len(re.sub(r"e.*|\D", "", number).lstrip("0"))
    for each, its in numbers(fenced):
        alike = (unit and its == unit) or ("e" in each and "e" in number)
        near = abs(value(each, unit) - value(number, unit)) <= rounding(number, unit)
        if near and (alike or (not its and digits >= 3)):
            return True
    return False


def unrecorded():
    """Return what docs/validation.md states that neither a record nor the row's test has.

    A worst error stands in worst_seen.md, in a record that the row links to, or beside the row's
    test in worst_by_test.md; a tolerance in the test, there perhaps of omega^2, of which that of
    the frequency is half.
    """
    found = []
    for line in (ROOT / "docs" / "validation.md").read_text(encoding="utf-8").splitlines():
        cells = line.strip("|").split("|")
        if len(cells) != 6 or not line.startswith("| "):
            continue
        held = _exponents(_linked(line, "tests"))
        held |= {each / 2 for each in held}
        found += [(cells[0], n) for n in _exponents(cells[3]) if not _among(n, held)]
        seen = _exponents(_linked(line, "validation") + _read("validation/worst_seen.md"))
        seen |= _exponents("\n".join(_measured_tests(line)))
        found += [(cells[0], n) for n in _exponents(cells[4]) if not _among(n, seen)]
    return found


def _read(name):
    return (ROOT / name).read_text(encoding="utf-8")


def _linked(line, folder):
    return "\n".join(map(_read, re.findall(rf"\]\(\.\./({folder}/[^)]+)\)", line)))


def _measured_tests(line):
    names = re.findall(r"\]\((\.\./tests/[^)]+)\)", line)
    rows = _read("validation/worst_by_test.md").splitlines()
    return [row for row in rows if any(f"({name})" in row for name in names)]


def _exponents(text):
    return {float(each) for each in re.findall(r"(?<![\w.])\d+(?:\.\d+)?e-\d+", text)}


def _among(number, held):
    return any(
        abs(number - each) <= 0.051 * 10.0 ** math.floor(math.log10(each)) for each in held if each
    )


def text(table):
    """Return claims.md."""
    lines = [
        "# What holds the numbers of the documents",
        "",
        "Written by `python -m validation.claims` from [claims.toml](claims.toml). A test fails "
        "where a measured number of a page has no tie, or its tie no longer says it. Numbers that "
        "a block of the same page shows are compared with what is printed, those of "
        "[validation](../docs/validation.md) with its records and tests; they do not stand here.",
    ]
    for page in dict.fromkeys(tie.page for tie in table):
        lines += [
            "",
            f"## [{page}](../{page})",
            "",
            "| said | held by | which says |",
            "|---|---|---|",
        ]
        for tie in (t for t in table if t.page == page):
            said = " ".join(tie.says.split()).replace("|", "\\|").replace("`", "")
            quote = re.sub(r"[`*\[\]]", "", tie.quote).replace("|", "\\|")
            held = f"{tie.kind}: [{Path(tie.file).name}](../{tie.file})"
            if tie.file == "worked":
                held = "worked out"
            lines.append(f"| {quote} | {held} | {'not more than it: ' * tie.bound}`{said}` |")
    return "\n".join(lines) + "\n"


def main():
    PAGE.write_text(text(ties()), encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
