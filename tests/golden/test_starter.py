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
    "bending": [3.248708578, 10.50497523, 20.66677918, 33.3550938, 48.01956663, 65.11855481],
    "longitudinal": [56.55697303, 113.5469604, 164.2256962, 210.8751982, 256.0302507, 302.6506962],
}
GROWTH = 6.841455312  # of the rigid rotation [1/s]


@pytest.fixture(scope="module")
def modes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("starter")
    subprocess.run([ANTINODE, "init", folder], check=True, capture_output=True)
    case = folder / "case.toml"
    done = subprocess.run([ANTINODE, "modes", case, "--json"], check=True, capture_output=True)
    return json.loads(done.stdout)["modes"]


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
