"""How near the tests of docs/validation.md come to their tolerances, measured as they run.

    python -m validation.worst_by_test

Every comparison by `numpy.testing.assert_allclose`, `pytest.approx` and `check_printed` is watched.
Of each test function stand here: its comparisons, the worst relative error among them, and the
worst share of what each comparison allowed (1 would be a failure). Takes some minutes; writes
worst_by_test.md.
"""

import functools
import re
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
LEFT_OUT = ("tests/app/", "tests/exchange/test_solvers", "tests/golden/")
"""What takes a browser or other programs, or has its own record."""


class Watch:
    """A plugin of pytest: worst relative error and share of the tolerance of each test."""

    def __init__(self):
        self.seen, self.now = {}, None

    def pytest_runtest_call(self, item):
        self.now = item.nodeid.partition("[")[0]

    def pytest_runtest_teardown(self):
        self.now = None

    def note(self, relative, share):
        if self.now is None:
            return
        count, worst, most = self.seen.get(self.now, (0, 0.0, 0.0))
        self.seen[self.now] = (count + 1, max(worst, relative), max(most, share))

    def compared(self, actual, wanted, rtol, atol):
        """Note one comparison of arrays, where wanted is not zero for the relative error."""
        with np.errstate(all="ignore"):
            try:
                off = np.abs(np.asarray(actual) - np.asarray(wanted)).astype(float)
            except (TypeError, ValueError):
                return
            size = np.abs(np.asarray(wanted)).astype(float) + 0 * off
            allowed = atol + rtol * size
            relative = np.where(size > 0, off / size, 0)
            share = np.where(allowed > 0, off / allowed, 0)
        good = np.isfinite(off)
        if np.any(good) and np.all(off[good] <= allowed[good]):  # else it fails, or must differ
            self.note(float(np.max(relative[good])), float(np.max(share[good])))


def watch(plugin):
    """Wrap the three ways of comparing, before any test is imported."""
    allclose = np.testing.assert_allclose

    @functools.wraps(allclose)
    def watched(actual, desired, rtol=1e-7, atol=0, **kwargs):
        plugin.compared(actual, desired, rtol, atol)
        return allclose(actual, desired, rtol=rtol, atol=atol, **kwargs)

    np.testing.assert_allclose = watched
    scalar = type(pytest.approx(1.0))
    equal = scalar.__eq__

    def approx(self, actual):
        if isinstance(actual, (int, float, complex, np.number)):
            plugin.compared(actual, self.expected, 0.0, float(self.tolerance))
        return equal(self, actual)

    scalar.__eq__ = approx
    sys.path.insert(0, str(ROOT / "tests"))
    from literature import published  # as the tests import it

    printed = published.check_printed

    def checked(found, text):
        found = list(found)
        for number, each in zip(found, text.split(), strict=True):
            plugin.compared(number, float(each), 0.0, published.last_digit(each))
        return printed(found, text)

    published.check_printed = checked


def files():
    """Return the test files of the rows of docs/validation.md that state a measured error."""
    page = (ROOT / "docs" / "validation.md").read_text(encoding="utf-8")
    rows = [line.strip("|").split("|") for line in page.splitlines() if line.startswith("| ")]
    stated = [row for row in rows if len(row) == 6 and re.search(r"e-\d|unit", row[4])]
    named = dict.fromkeys(
        n for row in stated for n in re.findall(r"\(\.\./(tests/[^)]+)\)", row[5])
    )
    recorded = ["tests/exact/test_segment.py", "tests/exact/test_uniform_beam.py"]
    return [n for n in named if n not in recorded and not n.startswith(LEFT_OUT)]


def main():
    plugin = Watch()
    watch(plugin)
    options = ["-q", "-o", "addopts=--strict-markers --import-mode=importlib", "-n", "0"]
    code = pytest.main([*options, *files()], plugins=[plugin])
    lines = [
        "# How near the tests come to their tolerances",
        "",
        "Written by `python -m validation.worst_by_test`: of each test function of "
        "[validation](../docs/validation.md) that compares numbers by a tolerance, how many it "
        "compared, the worst relative error among them, and the worst share of what was allowed.",
        "",
        "| test | comparisons | worst relative error | worst share |",
        "|---|---|---|---|",
    ]
    for name, (count, worst, share) in sorted(plugin.seen.items()):
        file, _, function = name.partition("::")
        words = function.removeprefix("test_").replace("_", " ").replace("::", ", ")
        lines.append(
            f"| [{Path(file).name}](../{file}): {words} | {count} | {worst:.1e} | {share:.2g} |"
        )
    (ROOT / "validation" / "worst_by_test.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return int(code)


if __name__ == "__main__":
    sys.exit(main())
