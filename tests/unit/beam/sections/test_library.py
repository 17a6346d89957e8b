"""Sections of `sectionproperties`: where it is installed a rectangle, else a sentence."""

import sys
from types import SimpleNamespace

import pytest

import antinode as an
from antinode.beam.sections import Material, drawn_beam
from antinode.beam.sections.library import properties_of
from antinode.beam.sections.shapes import SHAPES

STEEL = Material(youngs_modulus=210e9, density=7850)


class Analysed:
    """What a solved section answers, of a rectangle 0.3 wide and 0.5 high."""

    def calculate_geometric_properties(self):
        pass

    def calculate_warping_properties(self):
        pass

    def get_area(self):
        return 0.15

    def get_ic(self):
        return 0.003125, 0.001125, 0.0

    def get_as(self):
        return 0.11, 0.125

    def get_j(self):
        return 0.00281637


def test_a_section_becomes_columns():
    found = properties_of(Analysed())
    beam = drawn_beam([0, 4], STEEL, ends=an.Ends("clamped", "free"), **found)
    box = drawn_beam([0, 4], STEEL, ends=an.Ends("clamped", "free"), width=0.3, height=0.5)
    assert beam.bending_stiffness == pytest.approx(box.bending_stiffness, rel=1e-12)
    assert beam.polar_inertia_per_length == pytest.approx(box.polar_inertia_per_length, rel=1e-12)
    assert beam.torsional_stiffness == pytest.approx(box.torsional_stiffness, rel=1e-4)


def test_several_materials_are_refused():
    class Composite(Analysed):
        def get_ic(self):
            raise RuntimeError("composite")

    with pytest.raises(an.InputError, match="one material"):
        properties_of(Composite())


def test_what_is_missing_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "sectionproperties.analysis", None)
    with pytest.raises(an.InputError, match=r"pip install 'antinode\[sections\]'"):
        properties_of(SimpleNamespace(create_mesh=None, mesh={}))


def test_a_real_rectangle():
    library = pytest.importorskip("sectionproperties.pre.library")
    geometry = library.rectangular_section(d=0.5, b=0.3).create_mesh(mesh_sizes=[0.0005])
    found = properties_of(geometry)
    rectangle = SHAPES["rectangle"]
    assert found["second_moment"] == pytest.approx(rectangle.second_moment(0.3, 0.5), rel=1e-10)
    assert found["torsion_constant"] == pytest.approx(
        float(rectangle.torsion_constant(0.3, 0.5)), rel=1e-4
    )
    assert found["shear_area"] == pytest.approx(0.125, rel=1e-3)
