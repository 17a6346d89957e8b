"""A vehicle on the water's stiffness at the command line: what stands beside its modes."""

import json

import pytest

from cli_run import refused, run

TANGENT = ["--set", "model.hydrodynamic_stiffness=tangent"]
FIXED = ["--set", "model.end_force=fixed_direction", "--set", "model.theory=euler_bernoulli"]
FEW = ["--modes", "3"]


@pytest.fixture(autouse=True)
def wide(monkeypatch):
    """A terminal on which headings stand in full."""
    monkeypatch.setenv("COLUMNS", "120")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("water")
    run("init", "--example", "sweep", folder)
    return folder


def test_what_each_device_does_stands_beside_the_modes(folder):
    out = run("modes", folder / "case.toml", *TANGENT, *FIXED, *FEW).out
    for words in (
        "the water at",
        "planing",
        "2503",
        "without",
        "contact off",
        "contact ends",
        "f L/V",
        "one-sided",
        "2.77 mm",
    ):
        assert words in out
    left_out = " ".join(out[out.index("Not in the model") :].split())
    assert "hydrodynamic" not in left_out
    assert " damping" not in left_out


def test_what_is_left_out_names_the_key_that_takes_it_in(folder):
    for command in ("modes", "stability"):
        out = " ".join(run(command, folder / "case.toml").out.split())
        assert '[model] hydrodynamic_stiffness = "tangent"' in out


def test_as_json(folder):
    data = json.loads(run("modes", folder / "case.toml", *TANGENT, *FIXED, *FEW, "--json").out)
    water = data["water"]
    assert [t["name"] for t in water["tangents"]] == ["cavitator", "fin set 1", "planing"]
    planing = water["tangents"][2]
    assert planing["spring_N_per_m"] == pytest.approx(2.503e6, rel=1e-3)
    assert planing["contact_ends_at_m"] == pytest.approx(2.77e-3, rel=1e-2)
    assert water["tangents"][0]["contact_ends_at_m"] is None
    assert water["without"]["frequencies_hz"][0] == pytest.approx(3.2487, rel=1e-4)
    assert planing["contact_x_m"] == 6.0
    assert water["contact_off"]["frequencies_hz"][0] < water["without"]["frequencies_hz"][0]
    ends = {end["mode"]: end for end in water["contact_ends"]}
    assert ends["bending 4"]["amplitude_m"] == planing["contact_ends_at_m"]
    assert ends["bending 4"]["acceleration_g"] == pytest.approx(0.749, rel=2e-2)
    assert water["reduced_frequency"]["bending 4"] == pytest.approx(0.613, abs=2e-3)


def test_it_is_left_out_first_and_says_so(folder):
    data = json.loads(run("modes", folder / "case.toml", *FEW, "--json").out)
    assert data["not_modelled"][0].startswith("hydrodynamic stiffness and damping")
    assert data["water"] == {"hydrodynamic_stiffness": "none", "tangents": []}


@pytest.mark.parametrize(
    "share",
    ["model.cavitator_follows=0.5", "model.cavitator_follows=1", "model.cavitator_follows=0"],
)
def test_two_words_on_the_disk_are_refused(folder, share):
    ended = run("modes", folder / "case.toml", *TANGENT, "--set", share)
    refused(ended, "takes the place of that share")


@pytest.fixture(scope="module")
def wet(folder):
    """The example of a sweep, its case on the water's stiffness."""
    text = (folder / "case.toml").read_text(encoding="utf-8")
    changed = text.replace("[model]", '[model]\nhydrodynamic_stiffness = "tangent"')
    (folder / "wet").mkdir()
    for name in ("stations.csv", "study.toml"):
        (folder / "wet" / name).write_bytes((folder / name).read_bytes())
    (folder / "wet" / "case.toml").write_text(changed, encoding="utf-8")
    return folder / "wet"


def test_a_study_tells_what_limits_its_numbers(wet):
    one = 'inputs=[{key="condition.speed", values=[80]}]'
    ended = run("sweep", wet / "study.toml", "--set", one, "--set", "solve.modes=2")
    assert ended.code == 0, ended
    assert "1 of 1 case solved" in ended.out
    assert "touches on one side" in ended.out
    assert "the motion grows without oscillating" in ended.out
    assert "Not in the model: " in ended.out
    assert "hydrodynamic stiffness" not in ended.out


def test_a_study_without_it_names_it_first_among_what_is_left_out(folder):
    one = 'inputs=[{key="condition.speed", values=[80]}]'
    ended = run("sweep", folder / "study.toml", "--set", one)
    assert "Not in the model: hydrodynamic stiffness" in ended.out
