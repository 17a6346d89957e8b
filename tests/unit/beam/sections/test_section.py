"""`Section`: one cross-section, and the columns of a beam that follow from it."""

from math import pi

import numpy as np
import pytest

from antinode import Beam, Ends, InputError, Material, Section, drawn_beam

STEEL = Material(youngs_modulus="210 GPa", density="7850 kg/m^3")
D, T = 0.1683, 0.0071


def test_a_pipe_by_hand():
    columns = Section(STEEL, outer_diameter="168.3 mm", wall="7.1 mm").columns
    area = pi / 4 * (D**2 - (D - 2 * T) ** 2)
    second = pi / 64 * (D**4 - (D - 2 * T) ** 4)
    np.testing.assert_allclose(columns["mass_per_length"], 7850 * area, rtol=1e-13)
    np.testing.assert_allclose(columns["bending_stiffness"], 210e9 * second, rtol=1e-13)
    np.testing.assert_allclose(columns["polar_inertia_per_length"], 2 * 7850 * second, rtol=1e-13)


def test_its_columns_make_its_beam():
    section, ends = Section(STEEL, width=0.03, height="5 mm"), Ends("clamped")
    drawn = section.beam([0, 1], ends=ends, name="strip")
    assert drawn == drawn_beam([0, 1], STEEL, width=0.03, height=0.005, ends=ends, name="strip")
    table = Beam([0, 1], **section.columns, ends=ends)
    for name in section.columns:
        np.testing.assert_allclose(getattr(table, name), getattr(drawn, name), rtol=1e-15)


def test_any_other_section_has_what_is_known_of_it():
    assert set(Section(STEEL, area="20 cm^2", second_moment="100 cm^4").columns) == {
        "mass_per_length",
        "bending_stiffness",
        "axial_stiffness",
        "rotary_inertia_per_length",
    }


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"outer_diameter": 1, "width": 2}, "no section has the columns"),
        ({}, "give outer_diameter"),
        ({"outer_diameter": 0.1, "wall": 0.06}, "half of outer_diameter"),
        ({"outer_diameter": "1 kg"}, "no unit of m"),
        ({"outer_diameter": [0.1, 0.2]}, "give one number, or use drawn_beam"),
    ],
)
def test_what_is_no_section_is_refused(given, words):
    with pytest.raises(InputError, match=words):
        Section(STEEL, **given)


def test_the_material_comes_first():
    with pytest.raises(InputError, match="needs its material"):
        Section(0.1, 0.2)


def test_it_prints_in_one_line():
    assert repr(Section(STEEL, outer_diameter=0.2)) == (
        "Section(outer_diameter=0.2 m; E = 210 GPa, 7850 kg/m^3)"
    )
