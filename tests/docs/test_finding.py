"""The places that `validation/finding.md` leads to are there, and say what is looked for."""

from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "validation" / "finding.md").read_text("utf-8").partition("## Counted again")[2]
ROWS = [[cell.strip() for cell in line.split("|")[1:-1]] for line in TEXT.splitlines()
        if line.startswith("| ")][1:-1]  # fmt: skip


@pytest.mark.parametrize(("question", "flat", "today", "place", "words"), ROWS)
def test_the_answer_stands_where_it_is_said_to(question, flat, today, place, words):
    held = (ROOT / "src" / "antinode" / place.strip("`")).read_text("utf-8")
    assert words.strip("`") in " ".join(held.split())
    assert int(today) >= 2 + place.count("/")  # the package, each folder, the file


def test_the_sums_add_up():
    sums = next(line for line in TEXT.splitlines() if line.startswith("| **sum**")).split("|")
    for column, cell in ((1, 2), (2, 3)):
        assert sum(int(row[column].split()[0]) for row in ROWS) == int(sums[cell].strip(" *"))
