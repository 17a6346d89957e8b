"""The starter vehicle as `antinode init` writes it: plausible frequencies, and always the same."""

import json
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

ANTINODE = Path(sys.executable).with_name("antinode")

# First six bending frequencies [Hz] of the paper's vehicle at 80 m/s, sigma 0.02, 10 deg.
TARGETS = [3.25, 10.54, 20.68, 33.67, 48.56, 64.08]
# What our own solver finds with --tolerance 1e-11 [Hz].
OWN = {
    "bending": [3.219178684, 10.24794092, 19.77738516, 31.20402126, 43.85754459, 57.93592927],
    "longitudinal": [56.55697303, 113.5469604, 164.2256962, 210.8751982, 256.0302507, 302.6506962],
}
GROWTH = 6.831727761  # of the rigid rotation [1/s]
FIXED = ["--set", "model.end_force=fixed_direction"]
# The same where thrust and cavitator turn with the body, as the file says.
FOLLOWING = [3.76703421, 10.55472598, 20.01000264, 31.41278613, 44.05891004, 58.12171607]
ROTATION = 0.22511315  # [Hz]
# Without shear and rotary inertia: fixed directions, and as the file says.
PLAIN = [3.248708578, 10.50497523, 20.66677918, 33.3550938, 48.01956663, 65.11855481]
PLAIN_FOLLOWING = [3.800575615, 10.81839207, 20.91013265, 33.58028936, 48.24507169, 65.33387945]


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("starter")
    subprocess.run([ANTINODE, "init", folder], check=True, capture_output=True)
    return folder / "case.toml"


def solved(case, *more):
    command = [ANTINODE, "modes", case, "--json", *more]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


@pytest.fixture(scope="module")
def modes(case):
    return solved(case, *FIXED)["modes"]


@pytest.fixture(scope="module")
def following(case):
    return solved(case)


def test_what_the_file_says_is_that_the_end_forces_follow(following):
    assert frequencies(following["modes"], "bending") == pytest.approx(FOLLOWING, rel=1e-6)
    rotation = following["modes"][1]
    assert (rotation["name"], rotation["kind"]) == ("rigid rotation", "rigid")
    assert rotation["frequency_hz"] == pytest.approx(ROTATION, rel=1e-5)
    assert following["certificate"]["kind"] == "winding"
    assert following["notes"] == []


def test_every_choice_of_the_end_forces_stands_beside_the_files_own(following, modes):
    found = {choice["name"]: choice for choice in following["end_forces"]}
    assert list(found) == ["thrust and cavitator follow", "fixed directions", "thrust follows"]
    assert all(choice["proven"] for choice in found.values())
    fixed = found["fixed directions"]["frequencies_hz"]
    assert fixed == pytest.approx(frequencies(modes, "bending"), rel=1e-7)
    assert found["thrust follows"]["frequencies_hz"][0] == pytest.approx(3.693303396, rel=1e-6)


def test_a_case_that_does_not_say_gets_a_note(case):
    text = case.read_text(encoding="utf-8")
    silent = case.with_name("silent.toml")
    silent.write_text(text.replace('end_force = "follows_body"', ""), encoding="utf-8")
    found = solved(silent)
    assert ["end_force" in note for note in found["notes"]] == [True]
    assert frequencies(found["modes"], "bending") == pytest.approx(FOLLOWING, rel=1e-6)
    silent.write_text(text.replace('theory = "timoshenko"', ""), encoding="utf-8")
    found = solved(silent)
    assert ["theory" in note for note in found["notes"]] == [True]
    assert frequencies(found["modes"], "bending") == pytest.approx(FOLLOWING, rel=1e-6)


@pytest.mark.parametrize("more", [[], FIXED], ids=["following", "fixed"])
def test_without_shear_it_is_what_it_was(case, more):
    found = solved(case, *more, "--set", "model.theory=euler_bernoulli")["modes"]
    wanted = PLAIN if more else PLAIN_FOLLOWING
    assert frequencies(found, "bending") == pytest.approx(wanted, rel=1e-6)
    assert all(
        m["effect_of_shear"] is None and m["model_error"] < 0
        for m in found
        if m["number"] and m["family"] == "bending"
    )


def test_what_shear_does_is_solved(following):
    bending = [m for m in following["modes"] if m["family"] == "bending" and m["number"]]
    wanted = [f / plain - 1 for f, plain in zip(FOLLOWING, PLAIN_FOLLOWING, strict=True)]
    assert [m["effect_of_shear"] for m in bending] == pytest.approx(wanted, rel=1e-5)
    assert all(m["model_error"] is None for m in bending)


def frequencies(modes, family):
    return [m["frequency_hz"] for m in modes if m["family"] == family and m["number"]]


def test_bending_frequencies_lie_within_ten_per_cent(modes):
    assert frequencies(modes, "bending") == pytest.approx(TARGETS, rel=0.1)


@pytest.mark.parametrize("family", OWN)
def test_our_own_values_stay(modes, family):
    assert frequencies(modes, family) == pytest.approx(OWN[family], rel=1e-6)


def test_rigid_rotation_diverges_and_translation_stays(modes):
    rotation, translation = (m for m in modes if m["family"] == "bending" and not m["number"])
    assert rotation["growth_rate_per_s"] == pytest.approx(GROWTH, rel=1e-6)
    assert (translation["name"], translation["frequency_hz"]) == ("rigid translation", 0.0)


def test_numbers_and_counts_follow_each_other(modes):
    for family in OWN:
        mine = [m for m in modes if m["family"] == family]
        assert [m["number"] for m in mine if m["number"]] == [1, 2, 3, 4, 5, 6]
        assert mine[0]["counts"][0] == 0
        assert all(a["counts"][1] == b["counts"][0] for a, b in pairwise(mine))
