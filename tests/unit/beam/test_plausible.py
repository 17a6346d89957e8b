"""Numbers that hardly any beam has are doubted, and those of real structures are not."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import PointMass, Spring
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.beam.plausible import doubts
from antinode.beam.sections import Material, drawn_beam
from antinode.modes.result import not_modelled
from cli_run import run

CLAMPED = Ends("clamped", "free")


def bar(d=0.04, length=1.2, E=2.1e11, rho=7850.0, m=1.0, EI=1.0, EA=1.0, x=1.0, ends=CLAMPED):
    """A round bar, its columns times factors of a missed unit; EA = None leaves it out."""
    A = math.pi * d**2 / 4
    stiffness = None if EA is None else E * A * EA
    own = rho * A * m, E * A * d**2 / 16 * EI
    return Beam.from_stations([0.0, x * length], *own, stiffness, ends=ends)


STEEL, POLYMER = {}, {"d": 0.02, "length": 0.5, "E": 2.4e9, "rho": 1200.0}
CABLE = {"d": 0.006, "length": 3.0, "E": 1.1e11, "rho": 8900.0}
PILE = {"d": 2.5, "length": 60.0, "E": 3.2e10, "rho": 2500.0}
ROTOR = {"d": 0.3, "length": 0.9}


@pytest.mark.parametrize("body", [STEEL, POLYMER, CABLE, PILE, ROTOR])
@pytest.mark.parametrize("EA", [1.0, None])
def test_real_structures_are_not_doubted(body, EA):
    assert doubts(bar(**body, EA=EA)) == []


@pytest.mark.parametrize("example", ["beam", "tower", "rocket", "drill_string", "shaft"])
def test_the_examples_are_not_doubted(example, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run("init", "--example", example, ".")
    told = json.loads(run("beam", "beam.toml", "--modes", "2", "--json").out)["warnings"]
    assert not any("check the unit" in text for text in told)


@pytest.mark.parametrize("body", [STEEL, POLYMER, PILE])
@pytest.mark.parametrize(
    ("missed", "word"),
    [
        ({"x": 1e3, "m": 1e-6, "EI": 1e6, "EA": 1.0}, "numbers in mm, N and t"),
        ({"EI": 1e6}, "in N mm^2 gives"),
        ({"EI": 1e6, "EA": None}, "sqrt(EI/m)"),
        ({"x": 1e3, "m": 1e-6, "EI": 1e6, "EA": None}, "sqrt(EI/m)"),
        ({"x": 1e3}, "x [m, not mm]"),
        ({"EA": 1e-6}, "sqrt(EA/m)"),
        ({"EA": 1e-6, "EI": 1e-6}, "not kN or MN"),
        ({"m": 1e-3, "EA": 1e3}, "faster than in any material"),
    ],
)
def test_missed_units(body, missed, word):
    if body is PILE and missed == {"x": 1e3}:
        missed = {"x": 1e3, "EI": 1e-3}
    if body is POLYMER and missed == {"EA": 1e-6}:
        word = "radius of gyration"
    assert any(word in text for text in doubts(bar(**body, **missed)))


def test_every_doubt_says_what_to_do():
    for missed in ({"m": 1e-9}, {"m": 1e9}, {"EI": 1e6}, {"x": 1e5}):
        for EA in (1.0, None):
            told = doubts(bar(**missed, EA=EA))
            assert told
            assert all("check the units of" in text for text in told)


def test_point_masses_carry_a_beam_without_mass():
    light = bar(m=1e-8)
    assert doubts(light)
    assert doubts(light.with_attachments(PointMass(1.2, 10.0))) == []


def test_a_heavy_mass_does_not_slow_a_bar():
    assert doubts(bar().with_attachments(PointMass(1.2, 1e8))) == []


def test_a_rigid_piece_does_not_count():
    mass, EI, EA = [10.0, 10.0, 10.0], [3e4, 3e12, 3e12], [2.6e8, 2.6e16, 2.6e16]
    assert doubts(Beam.from_stations([0, 1, 1.2], mass, EI, EA, ends=CLAMPED)) == []


def test_a_long_wire_in_tension_or_on_supports_is_not_doubted():
    wire = {"d": 1e-3, "length": 30.0}
    free = bar(**wire)
    assert doubts(free)
    pulled = Beam.from_stations([0, 30.0], 6e-3, 0.01, 1.6e5, -100.0, ends=CLAMPED)
    assert doubts(pulled) == []
    assert doubts(free.with_attachments(Spring(15.0, translational=1e5))) == []


def test_more_stations_change_no_verdict():
    x = np.linspace(0, 1200, 31)
    one = bar(x=1e3, m=1e-6, EI=1e6)
    columns = (one.mass_per_length, one.bending_stiffness, one.axial_stiffness)
    many = Beam.from_stations(x, *(float(c[0, 0]) for c in columns), ends=CLAMPED)
    assert doubts(many) == doubts(one)


def test_doubts_come_with_the_modes():
    told = solve_modes(bar(EI=1e6), 1).warnings
    assert any("in N mm^2 gives" in text for text in told)
    assert not any("check the units" in text for text in solve_modes(bar(), 1).warnings)


HANGS = "pulls away from the clamped end"


@pytest.mark.parametrize(
    ("ends", "gravity", "hangs"),
    [
        (CLAMPED, 9.81, True),
        (CLAMPED, -9.81, False),
        (Ends("free", "clamped"), -9.81, True),
        (Ends("free", "clamped"), 9.81, False),
        (Ends("pinned", "free"), 9.81, False),
        (Ends("clamped", "clamped"), 9.81, False),
        (Ends("clamped", "free", left_axial="free"), 9.81, False),
    ],
)
def test_weight_that_pulls_away_from_the_clamp(ends, gravity, hangs):
    beam = apply_loads(bar(ends=ends), AxialLoads(gravity=gravity))
    assert any(HANGS in text for text in doubts(beam)) == hangs


def test_a_mast_that_shakes_upward_hangs_from_nothing():
    beam = apply_loads(bar(), AxialLoads(gravity=-9.81, acceleration=3.0))
    assert not any(HANGS in text for text in doubts(beam))


LAST_ROW = """
[beam]
stations.x = [0, 4, 8]
stations.mass_per_length = [60, 50, {m}]
stations.bending_stiffness = [9e6, 6e6, {EI}]
interpolation = "{how}"
ends.left = "clamped"
"""


@pytest.mark.parametrize(
    ("m", "EI", "how", "told"),
    [
        (40, 6e6, "step", "mass_per_length stays 50 up to the end, not 40 kg/m"),
        (50, 3e6, "step", "bending_stiffness stays 6e+06"),
        (50, 6e6, "step", ""),
        (40, 3e6, "linear", ""),
        (40, 3e6, "log", ""),
    ],
)
def test_a_last_row_that_is_not_used(tmp_path, m, EI, how, told):
    path = tmp_path / "beam.toml"
    path.write_text(LAST_ROW.format(m=m, EI=EI, how=how))
    for arguments in (
        ["beam", path, "--json"],
        ["report", path, "-o", tmp_path / "r.html", "--json"],
    ):
        found = [t for t in json.loads(run(*arguments).out)["warnings"] if "is not used" in t]
        assert len(found) == bool(told)
        assert told in "".join(found)


def test_a_last_row_of_a_table_in_csv(tmp_path):
    path = tmp_path / "mast.csv"
    rows = "x [m], mass_per_length [kg/m], bending_stiffness [N m^2]\n0, 5, 7\n1, 5, 7\n2, 5, "
    path.write_text(rows + "3\n")
    ended = run("beam", path, "--modes", "1")
    assert "bending_stiffness stays 7 up to the end, not 3 N m^2" in " ".join(ended.out.split())
    path.write_text(rows + "7\n")
    assert "is not used" not in run("beam", path, "--modes", "1").out


@pytest.mark.parametrize("ends", [CLAMPED, Ends("free", "free"), Ends("pinned", "pinned")])
@pytest.mark.parametrize("how", ["column", "force", "tension"])
def test_strains_beyond_any_material_are_doubted(how, ends):
    """A force in N where EA is in kN; loads and columns, compression and tension."""
    plain = bar(**POLYMER, EA=1e-3, EI=1e3, ends=ends)  # c = 45 m/s: no other doubt
    EA = float(plain.axial_stiffness[0, 0])
    for share, told in ((0.05, False), (0.3, True)):
        if how == "force":
            loads = AxialLoads(point_forces=(PointForce(0.25, share * EA),))
            loaded = apply_loads(plain, loads) if ends is CLAMPED else None
        else:
            sign = -1.0 if how == "tension" else 1.0
            N = np.full_like(plain.axial_force, sign * share * EA)
            loaded = replace(plain, axial_force=N)
        if loaded is not None:
            assert any("N/EA" in text for text in doubts(loaded)) == told


@pytest.mark.parametrize(("gravity", "told"), [(9806.65, True), (9810.0, True), (981.0, False)])
def test_gravity_in_millimetres_is_doubted(gravity, told):
    for sign in (1.0, -1.0):
        loaded = apply_loads(bar(**PILE), AxialLoads(gravity=sign * gravity))
        assert any("mm/s^2" in text for text in doubts(loaded)) == told


def test_a_drawing_in_millimetres_without_a_unit_is_doubted():
    steel = Material(youngs_modulus="210 GPa", density=7850)
    for size, length, told in ((40.0, 1200.0, True), (0.04, 1.2, False), (10.0, 150.0, False)):
        for columns in ({"outer_diameter": size}, {"width": size, "height": size / 2}):
            found = doubts(drawn_beam([0, length], steel, **columns))
            assert any("[mm] in the heading" in text for text in found) == told


def test_rotary_inertia_alone_leaves_shear_out():
    rows = {"rotary_inertia_per_length": [1e-3, 1e-3]}
    beam = Beam.from_stations([0, 1.2], 10.0, 2e4, 2.6e8, ends=CLAMPED, **rows)
    assert not_modelled(beam)[0].startswith("shear deformation (its effect is estimated")
    both = replace(beam, theory="euler_bernoulli")
    for own, other in zip(
        *(solve_modes(b, 3).family("bending") for b in (beam, both)), strict=True
    ):
        assert own.effect_of_shear > 0.4 * own.model_error
        assert own.by_shear == pytest.approx(other.by_shear, rel=0.02)
