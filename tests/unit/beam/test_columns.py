"""Columns of shear, rotary inertia, foundation, added mass and loss: checked, kept, read again."""

import numpy as np
import pytest

from antinode import Beam, Ends, InputError
from antinode.beam.file import load_beam
from antinode.exchange.beam_toml import beam_file_text
from cli_run import run

MORE = {
    "shear_stiffness": [np.inf, np.inf, 3e7, 2e7],
    "rotary_inertia_per_length": [0.0, 0.1, 0.2, 0.3],
    "foundation_stiffness": [0.0, 1e4, 1e4, 2e4],
    "added_mass_per_length": [0.0, 2.0, 3.0, 3.0],
    "loss_factor": [0.01, 0.02, 0.02, 0.0],
}


def made(**other):
    given = {"shear_form": "engesser", "interpolation": "linear", "ends": Ends("clamped"), **other}
    x = [0.0, 1.0, 1.0, 3.0]
    return Beam.from_stations(x, [9.0, 8.0, 7.0, 6.0], 1e6, axial_force=1e3, **given)


@pytest.mark.parametrize("name", ["beam.toml", "beam.xlsx", "beam.csv"])
def test_a_file_keeps_them(tmp_path, name):

    beam = made(**MORE, theory="timoshenko")
    source, target = tmp_path / "a.toml", tmp_path / name
    source.write_text(beam_file_text(beam)[0], encoding="utf-8")
    assert load_beam(source).beam() == beam
    if name != "beam.toml":
        ended = run("convert", source, target)
        assert ended.code == 0, ended
        read = load_beam(target).beam()
        for column in MORE:
            np.testing.assert_array_equal(getattr(read, column), getattr(beam, column))
        if name.endswith("xlsx"):
            assert (read.theory, read.shear_form) == ("timoshenko", "engesser")


def test_reversed_and_with_breakpoints():
    beam = made(**MORE)
    assert beam.reversed().reversed() == beam
    cut = beam.with_breakpoints([0.5, 2.0])
    np.testing.assert_array_equal(cut.shear_stiffness[:2], np.inf)
    np.testing.assert_allclose(cut.shear_stiffness[2:], [[3e7, 2.5e7], [2.5e7, 2e7]])
    np.testing.assert_allclose(cut.rotary_inertia_per_length[0], [0.0, 0.05])


def test_theory_follows_from_what_is_given():
    assert not made().is_timoshenko
    assert made(rotary_inertia_per_length=0.1).is_timoshenko
    assert not made(shear_stiffness=1e7, theory="euler_bernoulli").is_timoshenko
    chain = made(radius_of_gyration=0.2, theory="timoshenko").chain("bending")
    np.testing.assert_allclose(chain.columns["rotary_inertia"], chain.mass * 0.04)
    assert "rotary_inertia" not in made(radius_of_gyration=0.2).chain("bending").columns


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"shear_stiffness": 0.0}, "shear_stiffness must be positive, or inf: interval 1 has 0"),
        ({"shear_stiffness": [np.inf, 1e7, 1e7, 1e7]}, "runs from inf to 1e+07 in interval 1"),
        (
            {"rotary_inertia_per_length": -1.0},
            "zero or positive, and finite: interval 1 has -1",
        ),
        ({"foundation_stiffness": -5.0}, "foundation_stiffness must be zero or positive"),
        ({"added_mass_per_length": np.nan}, "added_mass_per_length must be zero or positive"),
        ({"loss_factor": -0.1}, "loss_factor must be zero or positive"),
        ({"theory": "Timoshenko"}, "theory is 'Timoshenko'"),
        ({"shear_form": "reissner"}, "shear_form is 'reissner'"),
        ({"shear_stiffness": 900.0}, "N < kGA in Engesser's form"),
    ],
)
def test_bad_columns(given, words):
    with pytest.raises(InputError) as caught:
        made(**given)
    assert words in str(caught.value)


def test_tension_beyond_the_stiffness_in_shear():
    with pytest.raises(InputError, match="kGA \\+ N > 0 in Haringx' form"):
        Beam.from_stations([0, 1], 1, 1, axial_force=-20, shear_stiffness=10)
    Beam.from_stations([0, 1], 1, 1, axial_force=-20, shear_stiffness=10, shear_form="engesser")
