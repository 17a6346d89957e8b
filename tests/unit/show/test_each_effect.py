"""What each effect does: bars that are solved, with the effect and without it."""

import numpy as np
import pytest

import antinode as an
from antinode.show.each_effect import each_effect, plot_each_effect
from cli_run import run

UNIFORM = {"mass_per_length": 2.0, "bending_stiffness": 3.0, "axial_stiffness": 900.0}
PINNED = an.Ends("pinned", "pinned")
WAVES = np.pi * np.arange(1, 4)


def effects_of(**columns):
    beam = an.Beam.from_stations([0.0, 1.0], **UNIFORM, ends=PINNED, **columns)
    found = each_effect(an.solve_modes(beam, 3, families=["bending"]))
    return {effect.name: effect.change for effect in found}


def test_bars_of_a_pinned_beam_in_closed_form():
    """omega^2 = (EI k^4 - N k^2 + K)/(m + m_w), k = n pi/L: Euler and Bernoulli's."""
    N, K, added = 5.0, 40.0, 1.0
    found = effects_of(axial_force=N, foundation_stiffness=K, added_mass_per_length=added)
    assert list(found) == ["axial force N", "foundation", "added mass"]
    bending = 3.0 * WAVES**4
    whole = bending - N * WAVES**2 + K
    assert found["axial force N"] == pytest.approx(np.sqrt(whole / (bending + K)) - 1, rel=1e-6)
    assert found["foundation"] == pytest.approx(np.sqrt(whole / (whole - K)) - 1, rel=1e-6)
    assert found["added mass"] == pytest.approx(np.full(3, np.sqrt(2 / 3) - 1), rel=1e-9)


def test_shear_and_rotary_inertia_are_told_apart():
    """Without the other, each in closed form: EI k^4/(1 + EI k^2/kGA), and m + rho I k^2."""
    found = effects_of(shear_stiffness=200.0, rotary_inertia_per_length=0.0)
    soft = 1 / np.sqrt(1 + 3.0 * WAVES**2 / 200) - 1
    assert found["shear"] == pytest.approx(soft, rel=1e-6)
    found = effects_of(shear_stiffness=np.inf, rotary_inertia_per_length=0.02)
    assert found["rotary inertia"] == pytest.approx(1 / np.sqrt(1 + 0.01 * WAVES**2) - 1, rel=1e-6)


def test_a_beam_with_none_says_so():
    with pytest.raises(an.InputError, match="there is no effect to draw"):
        plot_each_effect(())
    longitudinal = an.solve_modes(
        an.Beam.from_stations([0.0, 1.0], **UNIFORM), 2, families=["longitudinal"]
    )
    with pytest.raises(an.InputError, match="bending modes, and none was solved"):
        each_effect(longitudinal)


def test_the_command_draws_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run("init", "demo")
    chosen = ("--set", "model.theory=timoshenko")
    done = run("modes", "demo/case.toml", *chosen, "--modes", "2", "--effects", "effects.svg")
    assert done.code == 0
    text = (tmp_path / "effects.svg").read_text()
    for name in ("axial force N", "ends that follow", "shear", "rotary inertia"):
        assert name in text
    assert run("modes", "demo/case.toml", "--effects", "effects.doc").code == 2
