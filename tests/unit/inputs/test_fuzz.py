"""Random input: whatever stands in a file, the loader returns a sound object or says no.

The trees of valid files are changed at random (keys dropped, added, misspelt; values replaced by
others of any type), and random bytes are read as TOML and as CSV. Runs are repeatable.
"""

import copy
import math
import subprocess
import tomllib
from importlib.resources import files

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from antinode import ComputationError, InputError
from antinode.beam.file import ALL_COLUMNS as BEAM_COLUMNS
from antinode.beam.file import BeamFile, load_beam
from antinode.examples import EXAMPLES
from antinode.inputs.explain import validate
from antinode.inputs.override import override
from antinode.inputs.reading import read_csv
from antinode.inputs.units import to_si
from antinode.vehicle.case import COLUMNS, Case, load_case
from cli_run import python

SLOW = [HealthCheck.too_slow, HealthCheck.function_scoped_fixture]


def repeatable(examples):
    """Settings of hypothesis: so many examples, the same ones in every run."""
    return settings(
        max_examples=examples,
        derandomize=True,
        database=None,
        deadline=None,
        suppress_health_check=SLOW,
    )


def tried(function, *arguments):
    """Return what a function returns, and the sentence with which it refuses, if it does."""
    try:
        return function(*arguments), ""
    except ValueError as error:
        return None, str(error)


INLINE = {
    "x": [0.0, "1 m", 3.0, 6.0],
    "mass_per_length": [300.0, 300.0, "0.3 t/m", 300.0],
    "bending_stiffness": [4e5, 4e5, 4e5, 4e5],
    "axial_stiffness": [1e8, 1e8, 1e8, 1e8],
    "radius": [0.05, 0.1, 0.19, 0.19],
}


DRAWN = {
    "x": [0.0, "10 m", 40.0, 40.0, 80.0],
    "outer_diameter": ["2 m", 2.0, 1.5, 1.5, "120 cm"],
    "wall": ["20 mm", 0.02, 0.02, 0.01, 0.01],
}


def tables(name):
    """The tables of an example, with stations inline."""
    folder = files("antinode.examples") / name
    file = next(f for f in (folder / "case.toml", folder / "beam.toml") if f.is_file())
    found = tomllib.loads(file.read_text(encoding="utf-8"))
    if "vehicle" in found:
        found["vehicle"]["stations"] = copy.deepcopy(INLINE)
    elif isinstance(found["beam"]["stations"], str):
        found["beam"]["stations"] = copy.deepcopy(DRAWN)
    return found


TREES = {name: tables(name) for name in EXAMPLES}
BEAMS = [name for name in EXAMPLES if "beam" in TREES[name]]

GARBAGE = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.sampled_from([10**400, -(10**400), 0, -1, math.nan, math.inf, -math.inf, -0.0, 5e-324]),
    st.floats(),
    st.text(max_size=20),
    st.sampled_from(["1 m", "10 deg", "-3 kN", "nan m", "1e999 kg", "5 %", "1 m^9^9^9", "[m]", ""]),
    st.dates(),
    st.lists(st.one_of(st.integers(), st.floats(), st.text(max_size=5)), max_size=5),
    st.dictionaries(st.text(max_size=5), st.integers(), max_size=3),
    st.recursive(st.just([]), lambda inner: st.lists(inner, max_size=2), max_leaves=30),
)


def places(tree, path=()):
    """Every place in a tree: path and value."""
    inner = tree.items() if isinstance(tree, dict) else enumerate(tree)
    for key, value in list(inner):
        yield (*path, key)
        if isinstance(value, dict | list):
            yield from places(value, (*path, key))


@st.composite
def changed(draw, names):
    """The tables of an example after one to three changes."""
    tree = copy.deepcopy(TREES[draw(st.sampled_from(names))])
    for _ in range(draw(st.integers(1, 3))):
        if not tree:
            break
        path = draw(st.sampled_from(list(places(tree))))
        here = tree
        for key in path[:-1]:
            here = here[key]
        how = draw(st.sampled_from(["replace", "replace", "drop", "rename", "add"]))
        if how == "replace":
            here[path[-1]] = draw(GARBAGE)
        elif how == "add" and isinstance(here, dict):
            here[draw(st.text(max_size=12))] = draw(GARBAGE)
        else:
            value = here.pop(path[-1])
            if how == "rename" and isinstance(here, dict):
                here[draw(st.text(max_size=12))] = value
    return tree


def judged(model, tree):
    """Return the validated object, or None after a sentence that is fit to be read."""
    found, text = tried(validate, model, tree, "file.toml")
    if found is None:
        assert text.startswith("file.toml: ")
        assert 20 < len(text) < 700
        for noise in ("Value error", "function-", "pydantic", "\n"):
            assert noise not in text
    return found


@repeatable(300)
@given(changed(BEAMS))
def test_a_changed_beam_is_sound_or_refused(tree):
    file = judged(BeamFile, tree)
    if file is None:
        return
    beam, _ = tried(file.beam)
    if beam is None:
        return
    assert np.all(np.diff(beam.x) > 0)
    for values in (beam.mass_per_length, beam.bending_stiffness):
        assert np.all(np.isfinite(values) & (values > 0))
    assert 1 <= file.solve.modes <= 500
    assert 1e-12 <= file.solve.tolerance <= 0.1


@repeatable(300)
@given(changed(["starter"]))
@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # numbers near 1e308 overflow on the way
def test_a_changed_case_is_sound_or_refused(tree):
    case = judged(Case, tree)
    if case is None:
        return
    try:
        beam = case.beam()
    except (InputError, ComputationError):
        return
    for values in (beam.x, beam.mass_per_length, beam.bending_stiffness):
        assert np.all(np.isfinite(values))
    assert 0 < case.loads.sigma < 1
    assert math.isfinite(case.loads.a_X)


BYTES = st.one_of(
    st.binary(max_size=300),
    st.text(max_size=200).map(lambda text: text.encode("utf-8", "surrogatepass")),
    st.text(alphabet='[]{}"=.,#\n\\u 1e-+_xyz', max_size=200).map(str.encode),
)


@repeatable(300)
@given(BYTES)
def test_random_bytes_as_toml(tmp_path, content):
    path = tmp_path / "case.toml"
    path.write_bytes(content)
    for load in (load_case, load_beam):
        with pytest.raises(InputError, match=r"case\.toml"):
            load(path)


CELLS = st.one_of(
    st.sampled_from(
        ["x", "x [m]", "mass_per_length", "radius [mm]", "0", "1.5", "nan", "", '"', "#"]
    ),
    st.text(alphabet='[]",;#.-+e019 mx\t\x00\u00e9', max_size=8),
)
CSV = st.lists(st.lists(CELLS, max_size=4).map(",".join), max_size=6).map("\n".join)


@repeatable(400)
@given(st.one_of(BYTES, CSV.map(str.encode)))
def test_random_bytes_as_csv(tmp_path, content):
    path = tmp_path / "stations.csv"
    path.write_bytes(content)
    columns, refusal = tried(read_csv, path, COLUMNS)
    if columns is None:
        assert str(path) in refusal
        return
    assert len({len(column) for column in columns.values()}) == 1
    assert all(name.partition(":")[0] in COLUMNS for name in columns)


@repeatable(200)
@given(changed(BEAMS), st.text(max_size=40), st.sampled_from(list(places(TREES["tower"]))))
def test_random_overrides(tree, value, path):
    key = ".".join(map(str, path))
    for assignment in (f"{key}={value}", f"{value}={key}", value):
        _, refusal = tried(override, tree, [assignment])
        assert refusal == "" or refusal.startswith("--set")
    judged(BeamFile, tree)


@repeatable(400)
@given(st.one_of(GARBAGE, st.text(alphabet="0123456789.e+-^*/() mkgNs²·", max_size=30)))
def test_random_quantities(value):
    for unit in ("m", "N m^2", ""):
        number, refusal = tried(to_si, value, unit)
        assert isinstance(number, float) or 10 < len(refusal) < 200


@pytest.mark.parametrize("seed", range(3))
def test_no_process_shows_a_traceback(tmp_path, seed):
    rng = np.random.default_rng(seed)
    text = (files("antinode.examples") / "beam" / "beam.toml").read_bytes()
    for k in range(2):
        spoilt = bytearray(text)
        for place in rng.integers(0, len(text), 20 * k + 1):
            spoilt[place] = rng.integers(0, 256)
        (tmp_path / "beam.toml").write_bytes(spoilt)
        done = subprocess.run(
            python("beam", tmp_path / "beam.toml"), capture_output=True, text=True, check=False
        )
        assert done.returncode in (0, 1, 2)
        assert "Traceback" not in done.stderr
        if done.returncode:
            assert (done.stdout, done.stderr.count("\n")) == ("", 1)
            assert done.stderr.startswith("antinode: ")


def test_the_unchanged_trees_are_accepted():
    for name in BEAMS:
        assert BeamFile.model_validate(TREES[name]).beam().mass > 0
        assert set(TREES[name]["beam"]["stations"]) <= set(BEAM_COLUMNS)
    assert Case.model_validate(TREES["starter"]).beam().mass > 0
