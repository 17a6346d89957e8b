"""Numbers of the documents are tied to records, tests and the program, and agree with them."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from benchmarks import table
from validation import claims

ROOT = Path(__file__).resolve().parents[2]
TIES = claims.ties()


@pytest.mark.parametrize("page", claims.pages())
def test_every_measured_number_has_a_tie(page):
    if page != "docs/validation.md":  # whose rows are ties themselves
        assert claims.untied(page, TIES) == []


@pytest.mark.parametrize("tie", TIES, ids=lambda tie: f"{tie.page}: {tie.quote}"[:70])
def test_a_tie_holds(tie):
    assert tie.quote in claims.split(tie.page)[0], "the page no longer says this"
    assert tie.stands(), f"{tie.file} no longer says {tie.says}"
    assert claims.holds(tie) == [], f"{tie.file} says {tie.says}"


def test_tolerances_stand_in_tests_and_worst_errors_in_records():
    assert claims.unrecorded() == []


def test_the_page_is_what_the_table_says():
    assert claims.PAGE.read_text("utf-8") == claims.text(TIES), "run python -m validation.claims"


def test_the_table_of_benchmarks_is_that_of_its_results():
    rows = json.loads(table.RESULTS.read_text(encoding="utf-8"))
    assert table.shown() == table.text(rows).strip(), "run python -m benchmarks.table"


def test_a_claim_ahead_of_its_record_is_seen():
    tie = next(tie for tie in TIES if tie.file.endswith("bounds.toml"))
    assert claims.holds(replace(tie, quote="at most 0.06 % apart"))
    assert not replace(tie, says="[achieved.all] worst = 1e-9").stands()
    assert claims.untied("README.md", [t for t in TIES if t is not tie])[0][0] == "0.07 %"
    bound = replace(tie, quote="within 0.06 %", says="7e-4", options=("bound",))
    assert claims.holds(bound)
    assert not claims.holds(replace(bound, quote="within 0.08 %"))
