"""Places in other units than the stations' meet the ends of the beam but for the last bit."""

import pytest

from antinode import Beam, InputError, load_beam
from antinode.beam.attachments import PointMass

TABLE = """
[beam.stations]
x = [{start}, "{feet} ft"]
mass_per_length = [1, 1]
bending_stiffness = [1e6, 1e6]
[beam.ends]
left = "clamped"
[[beam.point_masses]]
x = "{inches} in"
mass = 1
[[beam.masses]]
name = "lining"
x = [{start}, "{inches} in"]
mass_per_length = [1, 1]
[beam.loads]
point_forces = [{{x = "{inches} in", force = -1}}]
"""


@pytest.mark.parametrize("feet", [1, 3, 7, 11, 13, 17, 19, 23, 29, 35, 41, 100, 1000])
def test_feet_and_inches_end_at_one_place(tmp_path, feet):
    path = tmp_path / "beam.toml"
    path.write_text(TABLE.format(start=0, feet=feet, inches=12 * feet))
    beam = load_beam(path).beam()
    assert [item.x for item in beam.attachments] == [beam.x[-1]]
    assert len(beam.x) == 2


def test_a_mass_before_the_first_station_by_a_bit():
    beam = Beam.from_stations([0.3, 1.0], [1, 1], [1, 1])
    own = beam.with_attachments(PointMass(0.1 * 3 - 1e-16, 1.0), PointMass(0.3 - 5e-17, 1.0))
    assert {item.x for item in own.attachments} == {0.3}


def test_a_mass_off_the_beam_is_off_the_beam():
    beam = Beam.from_stations([0.0, 1.0], [1, 1], [1, 1])
    with pytest.raises(InputError, match="off the beam"):
        beam.with_attachments(PointMass(1 + 1e-9, 1.0))
