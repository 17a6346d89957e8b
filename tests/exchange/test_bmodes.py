"""Main files of BModes, with numbers worked out by hand."""

import math

import numpy as np
import pytest

from antinode import InputError
from antinode.beam.attachments import PointMass
from antinode.exchange.inputs import Choices, read_beam
from cli_run import refused, run
from exchange.test_sections import BMODES

MAIN = """\
=================   BModes v3.00 Main Input File  ==================
A tower of 90 m on a rigid base of 10 m

2         beam_type   1: blade, 2: tower (-)
12.0      rot_rpm:    rotor speed, automatically set to zero for tower modal analysis (rpm)
1.0       rpm_mult:   rotor speed multiplicative factor (-)
90.0      radius:     rotor tip radius OR tower height (m)
10.0      hub_rad:    hub radius OR tower rigid-base height (m)
0.        precone:    built-in precone angle (deg)
0.        bl_thp:     blade pitch setting (deg)
1         hub_conn:   hub-to-blade or tower-base boundary condition
5.d4      tip_mass    blade-tip or tower-top mass (kg)
-2.0      cm_loc      tip-mass c.m. offset (m)
1.5       cm_axial    tip-mass c.m. offset measured axially (m)
3.e6      ixx_tip     (kg-m^2)
4.e6      iyy_tip     (kg-m^2)
5.e6      izz_tip     (kg-m^2)
0.        ixy_tip     (kg-m^2)
-1.e4     izx_tip     (kg-m^2)
0.        iyz_tip     (kg-m^2)
'sections.dat'   : sec_props_file   name of beam section properties file (-)
2.0       sec_mass_mult:   mass density multiplier (-)
3.0       flp_iner_mult:   (-)
7.0       lag_iner_mult:   (-)
0.5       flp_stff_mult:   (-)
0.25      edge_stff_mult:  (-)
1.0       tor_stff_mult:   (-)
4.0       axial_stff_mult: (-)
0         tow_support: additional tower support
"""


@pytest.fixture
def tower(tmp_path):
    (tmp_path / "sections.dat").write_text(BMODES)
    path = tmp_path / "tower.bmi"
    path.write_text(MAIN)
    return path


def test_a_tower_with_its_head(tower):
    found = read_beam(tower, "bmodes", Choices())
    beam = found.beam
    np.testing.assert_array_equal(beam.x, [0, 80])
    assert (beam.ends.left, beam.ends.right, beam.rotation) == ("clamped", "free", None)
    assert np.all(beam.mass_per_length == 200)
    assert np.all(beam.bending_stiffness == 0.5e9)
    assert np.all(beam.rotary_inertia_per_length == 1200)
    assert np.all(beam.axial_stiffness == 2e10)
    assert beam.attachments == (
        PointMass(80.0, 5e4, 4e6 + 5e4 * 4, offset=1.5, polar_inertia=5e6 + 5e4 * 4),
    )
    assert any("cm_loc = -2 m counts" in note for note in found.notes)
    assert any("products of inertia" in note for note in found.notes)


def test_a_tower_from_the_side_has_the_stiffness_of_fore_aft(tower):
    found = read_beam(tower, "bmodes", Choices(plane=2))
    assert np.all(found.beam.bending_stiffness == 2e9 * 0.5)
    assert found.beam.attachments[0].rotary_inertia == 3e6
    assert any("couples this plane with torsion" in note for note in found.notes)


def test_a_blade_rotates(tower):
    text = MAIN.replace("2         beam_type", "1 beam_type").replace("1.5  ", "0.  ")
    tower.write_text(text.replace("0.        bl_thp", "3. bl_thp"))
    found = read_beam(tower, "bmodes", Choices(plane=2))
    beam = found.beam
    assert (beam.rotation.axis, beam.rotation.plane) == (-10.0, "in_plane")
    rate = 12 * math.pi / 30
    assert beam.rotation.rate == pytest.approx(rate)
    # N at the root: minus Omega^2 times (m L (r + L/2) + M (r + L)), m doubled
    pull = rate**2 * (200 * 80 * 50 + 5e4 * 90)
    assert beam.axial_force[0, 0] == pytest.approx(-pull, rel=1e-12)
    assert np.all(beam.bending_stiffness == 2e9 * 0.25)
    assert beam.attachments[0].rotary_inertia == 3e6 + 5e4 * 4
    assert "bl_thp counts as 0" in found.notes


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("0         tow_support", "1 tow_support", "platforms, monopiles and guy wires"),
        ("1         hub_conn", "4 hub_conn", "hub_conn is 4; allowed are"),
        ("90.0      radius", "9.0 radius", "from hub_rad = 10 m to radius = 9 m"),
        ("90.0      radius", "x radius", "line 7: radius is 'x'; it must be a number"),
        ("2         beam_type", "2 beam", "no line of beam_type"),
        ("sec_props_file", "file", "no line of sec_props_file"),
        ("'sections.dat'", "'other.dat'", "other.dat"),
    ],
)
def test_refused(tower, old, new, said):
    tower.write_text(MAIN.replace(old, new))
    with pytest.raises(InputError, match=said):
        read_beam(tower, "bmodes", Choices())


def test_by_the_command_line(tower, monkeypatch):
    monkeypatch.chdir(tower.parent)
    assert "cm_loc" in run("convert", "tower.bmi", "tower.toml").err
    ended = run("beam", "tower.toml", "--modes", "2")
    assert ended.code == 0
    assert "bending 1" in ended.out
    refused(run("convert", "tower.toml", "x.toml", "--to", "bmodes"), "cannot be written")
    assert "--length has no effect" in run("convert", "tower.bmi", "t.toml", "--length", "3m").err
