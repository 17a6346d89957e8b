"""TOML read within bounds, and written into files whose comments stay."""

import math
import re
import tomllib
from importlib.resources import files

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import antinode as an
from antinode.inputs.reading import read_toml
from antinode.inputs.toml_reading import DEEPEST, parse_toml
from antinode.inputs.toml_writing import same, toml_text, with_values
from cli_run import run

KEYS = st.text(min_size=1, max_size=8)
VALUES = st.one_of(
    st.booleans(),
    st.integers(-(2**62), 2**62),
    st.floats(),
    st.text(st.characters(exclude_categories=["Cs"]), max_size=20),
)
ROW = st.dictionaries(st.text(st.characters(exclude_categories=["Cs"]), min_size=1), VALUES)
LISTS = st.lists(VALUES, max_size=5) | st.lists(ROW.filter(bool), max_size=3)
TABLE = st.dictionaries(st.text(st.characters(exclude_categories=["Cs"])), VALUES | LISTS | ROW)
FILES = st.dictionaries(st.text(st.characters(exclude_categories=["Cs"])), VALUES | LISTS | TABLE)


@given(FILES)
@settings(max_examples=150, deadline=None)
def test_what_is_written_is_what_is_read(tables):
    assert same(tomllib.loads(toml_text(tables)), tables)


@given(FILES, FILES)
@settings(max_examples=150, deadline=None)
def test_any_file_takes_any_values(before, after):
    changed = with_values(toml_text(before), before, after)
    assert same(tomllib.loads(changed), after)


def test_arrays_and_tuples_are_lists():
    tables = {"a": np.array([1.0, math.nan]), "b": (1, 2), "c": np.float64(0.1)}
    assert toml_text(tables) == "a = [1.0, nan]\nb = [1, 2]\nc = 0.1\n"


SOURCE = """\
# Of the yard.
[beam]
name = "mast"         # its name
gravity = "9.81 m/s^2"   # SI
# free = true

[[beam.springs]]      # the foot
x = 0                 # here
k = "3 kN/m"

[solve]               # how
"""


def test_comments_stay_and_keep_their_column():
    before = tomllib.loads(SOURCE)
    after = {
        "beam": {"name": "pole", "gravity": 9.8, "more": 1, "springs": [{"x": 0, "k": 4e3}]},
        "solve": {"modes": 3},
    }
    assert (
        with_values(SOURCE, before, after)
        == """\
# Of the yard.
[beam]
name = "pole"         # its name
gravity = 9.8            # SI
more = 1
# free = true

[[beam.springs]]      # the foot
x = 0                 # here
k = 4000.0

[solve]               # how
modes = 3
"""
    )


def test_values_are_compared_in_another_form_than_the_file_has():
    """A number that is 9.81 before and after stays the text that it is in the file."""
    changed = with_values(SOURCE, {"beam": {"gravity": 9.81}}, {"beam": {"gravity": 9.81, "a": 1}})
    assert 'gravity = "9.81 m/s^2"   # SI' in changed
    assert tomllib.loads(changed)["beam"]["a"] == 1


@pytest.mark.parametrize(
    "text",
    [
        "a.b = 1\nc = 2\na.d = 3\n",
        "[x.y]\nb = 1\n[z]\n[x]\nq = 2\n[x.w]\nb = 3\n",
        "a = { b = 1, c = { d = 2 } }\n",
        "[[a]]\n[[a.b]]\nc = 1\n[[a]]\n",
    ],
)
def test_tables_in_any_order_take_new_values(text):
    before = tomllib.loads(text)
    for after in ({}, {"new": {"e": [1]}}, {**before, "new": 1}, {"a": 5}, {"x": {"y": 7}}):
        assert same(tomllib.loads(with_values(text, before, after)), after)


def test_true_is_not_one():
    assert with_values("a = 1\n", {"a": 1}, {"a": True}) == "a = true\n"
    assert not same({"a": [1]}, {"a": [True]})
    assert same(math.nan, math.nan)


@pytest.mark.parametrize("name", ["starter", "paper", "beam", "tower", "rocket", "drill_string"])
def test_every_example_keeps_all_its_lines_but_the_one_that_changes(name):
    folder = files("antinode.examples") / name
    path = next(file for file in folder.iterdir() if file.name.endswith(".toml"))
    text = path.read_text(encoding="utf-8")
    before = tomllib.loads(text)
    kind = "vehicle" if "vehicle" in before else "beam"
    changed = with_values(text, before, {**before, kind: {**before[kind], "name": "other"}})
    pairs = zip(text.splitlines(), changed.splitlines(), strict=True)
    assert [old for old, new in pairs if old != new and not old.startswith("name")] == []


# --- bounds -----------------------------------------------------------------------------------

HOSTILE = {
    "dotted": "a." * 50_000 + "a = 1",
    "quoted": '"a".' * 50_000 + "a = 1",
    "spaced": "a . " * 50_000 + "a = 1",
    "header": "[" + "a." * 50_000 + "a]",
    "inline": "x = { " + "a." * 50_000 + "a = 1 }",
    "lists": "a = " + "[" * 50_000,
    "tables": "a = " + "{a=" * 50_000,
    "many": "".join(f"[a{k}.b.c.d.e.f.g.h]\n" for k in range(10_000)),
}


@pytest.mark.parametrize("kind", list(HOSTILE))
def test_what_would_fill_the_memory_is_refused_at_once(kind, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(HOSTILE[kind])
    with pytest.raises(an.InputError, match="levels") as caught:
        read_toml(path)
    assert len(str(caught.value)) < 400
    done = run("beam", path)
    assert (done.code, done.out) == (2, "")


def test_set_is_bounded_too(tmp_path):
    assert run("init", tmp_path).code == 0
    done = run("modes", tmp_path / "case.toml", "--set", f"condition.speed={{{HOSTILE['dotted']}}}")
    assert done.code == 2


def test_dots_and_brackets_in_texts_and_comments_do_not_count():
    deep = "a." * 30 + "[[[[[[[[[[[[[[["
    text = f"a = \"{deep}\" # {deep}\nb = \"\"\"\n{deep}\"\"\"\nc = '{deep}'\nd = '''{deep}'''\n"
    assert parse_toml(text) == {"a": deep, "b": deep, "c": deep, "d": deep}
    key = ".".join("abcdefghijklmnop"[:DEEPEST])
    assert parse_toml(f"{key} = [[[1.25, 2.5]]]")


@pytest.mark.parametrize(
    "text",
    ['a = "\\', 'a = """' + '\\"""' * 200_000, "a" * 1_000_000, "a " * 500_000, '"' * 1_000_000],
)
def test_bounds_are_found_in_time(text):
    with pytest.raises(ValueError, match=re.compile("Unterminated|Expected|Unescaped|Illegal")):
        parse_toml(text)
