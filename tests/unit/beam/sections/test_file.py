"""Beam files from a drawing: units, formats there and back, and what is refused in one sentence."""

import tomllib

import numpy as np
import pytest

import antinode as an
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.beam.sections import Material, drawn_beam
from antinode.exchange.inputs import Choices, read_beam
from antinode.exchange.outputs import write_beam

TOWER = """
[beam]
name = "tower"
interpolation = "linear"
[beam.stations]
x = ["0 m", "30 m", "80 m"]
outer_diameter = ["4000 mm", "4 m", "250 cm"]
wall = ["40 mm", 0.03, "20 mm"]
[beam.ends]
left = "clamped"
[beam.material]
youngs_modulus = "210 GPa"
density = "7850 kg/m^3"
"""


def written(folder, text):
    path = folder / "beam.toml"
    path.write_text(text)
    return path


def beam_of(folder, text=TOWER):
    return an.load_beam(written(folder, text)).beam()


def test_units_stand_in_any_cell(tmp_path):
    steel = Material(youngs_modulus=210e9, density=7850.0)
    ends = an.Ends("clamped", "free")
    x, D, t = [0, 30, 80], [4, 4, 2.5], [0.04, 0.03, 0.02]
    python = drawn_beam(x, steel, outer_diameter=D, wall=t, ends=ends, name="tower")
    assert beam_of(tmp_path) == python


def test_what_follows_from_a_section(tmp_path):
    beam = beam_of(tmp_path)
    D, t = 4.0, 0.04
    d, E, G, rho = D - 2 * t, 210e9, 210e9 / 2.6, 7850
    area, second = np.pi / 4 * (D**2 - d**2), np.pi / 64 * (D**4 - d**4)
    n = (d / D) ** 2
    kappa = 7.8 * (1 + n) ** 2 / (8.8 * (1 + n) ** 2 + 23.6 * n)
    wanted = {
        "mass_per_length": rho * area,
        "bending_stiffness": E * second,
        "axial_stiffness": E * area,
        "shear_stiffness": kappa * G * area,
        "rotary_inertia_per_length": rho * second,
        "torsional_stiffness": 2 * G * second,
        "polar_inertia_per_length": 2 * rho * second,
    }
    for name, value in wanted.items():
        assert getattr(beam, name)[0, 0] == pytest.approx(value, rel=1e-13), name
    assert beam.is_timoshenko


def test_mass_and_weight_are_those_of_a_cone():
    """rho pi/12 L (a^2 + a b + b^2); N of its weight at the foot, and halfway."""
    steel, a, b, L = Material(youngs_modulus=2e11, density=7800), 3.0, 0.2, 50.0
    cone = drawn_beam([0, L], steel, outer_diameter=[a, b], ends=an.Ends("clamped", "free"))
    mass = 7800 * np.pi / 12 * L * (a * a + a * b + b * b)
    assert cone.mass == pytest.approx(mass, rel=1e-14)
    middle = (a + b) / 2
    upper = 7800 * np.pi / 12 * L / 2 * (middle**2 + middle * b + b * b)
    hung = apply_loads(cone, AxialLoads(gravity=-9.80665))
    N = hung.axial_force_at(np.array([0, 0]), np.array([0.0, 0.5]))
    assert pytest.approx([9.80665 * mass, 9.80665 * upper], rel=1e-13) == N
    x = np.polynomial.Polynomial([0, 1])
    area = 7800 * np.pi / 4 * (a + (b - a) / L * x) ** 2
    J1, J2 = ((area * x**k).integ()(L) for k in (1, 2))
    assert cone.moment_of_inertia == pytest.approx(J2 - J1**2 / mass, rel=1e-12)


def test_a_load_between_two_supports_is_shared_by_the_true_compliance():
    """Cone between walls: int dx/EA = 4 L/(pi E a b)."""
    steel, a, b, L = Material(youngs_modulus=2e11, density=7800), 1.0, 0.01, 8.0
    cone = drawn_beam([0, L], steel, outer_diameter=[a, b], ends=an.Ends("clamped", "clamped"))
    loads = AxialLoads(point_forces=(PointForce(6.0, 1000.0),))
    beam = apply_loads(cone, loads)
    c = a + (b - a) * 0.75
    left, right = 0.75 / (a * c), 0.25 / (c * b)
    N = beam.axial_force[:, 0]
    assert (
        pytest.approx([-1000 * right / (left + right), 1000 * left / (left + right)], rel=1e-12)
        == N
    )


JUMP = """
[beam]
interpolation = "linear"
[beam.stations]
x = [0, 4, 4, 9]
width = [0.3, 0.2, 0.25, 0.1]
height = ["300 mm", "250 mm", "20 cm", "10 cm"]
axial_force = ["10 kN", "10 kN", "4 kN", "4 kN"]
[beam.material]
youngs_modulus = "70 GPa"
density = "2700 kg/m^3"
poisson_ratio = 0.33
[beam.ends]
left = "clamped"
[[beam.point_masses]]
x = 6
mass = "20 kg"
"""
STEPS = """
[beam]
stations = { x = [0, 1, 3], outer_diameter = [0.2, 0.1, 0.1] }
material = { youngs_modulus = 2e11, density = 7800, shear_coefficient = 0.5 }
ends = { left = "pinned", right = "pinned" }
"""
ANY = """
[beam]
interpolation = "linear"
[beam.stations]
x = [0, 10]
area = ["50 cm^2", "40 cm^2"]
second_moment = ["3000 cm^4", "2000 cm^4"]
shear_area = ["20 cm^2", "15 cm^2"]
[beam.material]
youngs_modulus = 2.1e11
density = 7850
[beam.ends]
left = "clamped"
"""


@pytest.mark.parametrize("text", [TOWER, JUMP, STEPS, ANY])
@pytest.mark.parametrize("how", ["toml", "csv", "xlsx"])
def test_a_drawing_goes_through_files(how, text, tmp_path):
    beam = beam_of(tmp_path, text)
    path = tmp_path / f"again.{how}"
    write_beam(path, beam, how)
    sets = [f"beam.ends.{side}={getattr(beam.ends, side)}" for side in ("left", "right")]
    again = read_beam(path, how, Choices(tuple(sets) if how == "csv" else ())).beam
    assert again.drawing is not None
    assert again.drawing.material == beam.drawing.material
    assert again.drawing.x.tolist() == beam.drawing.x.tolist()
    for name, table in beam.drawing.dimensions.items():
        assert again.drawing.dimensions[name] == pytest.approx(table, rel=1e-15)
    if how != "csv":
        f, g = (an.natural_frequencies(b, 3).frequencies_hz for b in (beam, again))
        assert g == pytest.approx(f, rel=1e-10)


def test_parts_and_weight_stay_beside_a_drawing(tmp_path):
    more = """
[[beam.masses]]
x = [10, 40, 60]
mass_per_length = [100, 250, 0]
[beam.loads]
gravity = -9.80665
"""
    beam = beam_of(tmp_path, TOWER + more)
    write_beam(tmp_path / "again.toml", beam, "toml")
    tables = tomllib.loads((tmp_path / "again.toml").read_text())["beam"]
    assert tables["stations"]["x"] == [0, 30, 80]
    assert [part["mass_per_length"] for part in tables["masses"]] == [[100] * 3, [250] * 2]
    again = an.load_beam(tmp_path / "again.toml").beam()
    f, g = (an.natural_frequencies(b, 3).frequencies_hz for b in (beam, again))
    assert g == pytest.approx(f, rel=1e-9)
    notes = write_beam(tmp_path / "again.csv", beam, "csv")
    assert any("64 straight pieces" in note and "changes its first three" in note for note in notes)


REFUSED = {
    "material without section": (
        TOWER.replace("outer_diameter", "mass_per_length")
        .replace("wall", "bending_stiffness")
        .replace(" mm", "")
        .replace(" cm", "")
        .replace('"4 m"', "4"),
        ["[beam.material] is given", "give outer_diameter"],
    ),
    "section without material": (
        TOWER.partition("[beam.material]")[0],
        ["outer_diameter and wall", "[beam.material] is missing"],
    ),
    "both": (
        TOWER.replace("wall =", "bending_stiffness = [1e9, 1e9, 1e9]\nwall ="),
        ["bending_stiffness", "both given"],
    ),
    "mass beside a section": (
        TOWER.replace("wall =", "mass_per_length = [1, 1, 1]\nwall ="),
        ["mass_per_length", "[[beam.masses]]"],
    ),
    "thick wall": (
        TOWER.replace("0.03", "2.3"),
        ["row 2", "wall 2.3 m", "at most half of outer_diameter"],
    ),
    "negative": (TOWER.replace("0.03", "-0.03"), ["wall, row 2", "greater than 0"]),
    "two shapes": (
        TOWER.replace("wall =", "width ="),
        ["no section has", "outer_diameter, width"],
    ),
    "log": (TOWER.replace('"linear"', '"log"'), ["'log'", "use 'linear'"]),
    "unit": (TOWER.replace("40 mm", "40 kg"), ["wall", "40 kg"]),
    "nu": (TOWER.replace("density =", "poisson_ratio = 0.7\ndensity ="), ["poisson_ratio", "0.5"]),
    "box filled": (
        JUMP.replace("[beam.material]", "wall = [0.01, 0.01, 0.1, 0.05]\n[beam.material]"),
        ["row 3", "less than half"],
    ),
    "no density": (
        TOWER.replace('density = "7850 kg/m^3"', ""),
        ["beam.material.density", "missing"],
    ),
}


@pytest.mark.parametrize("name", list(REFUSED))
def test_one_sentence(name, tmp_path):
    text, words = REFUSED[name]
    with pytest.raises(an.InputError) as error:
        beam_of(tmp_path, text)
    sentence = str(error.value)
    assert "\n" not in sentence
    assert all(word in sentence for word in words), sentence


def test_python_is_refused_in_the_same_words():
    steel = Material(youngs_modulus=2e11, density=7800)
    for columns, words in (
        ({"outer_diameter": 0.1, "wall": 0.06}, "at most half"),
        ({"outer_diameter": -0.1}, "greater than 0"),
        ({"diameter": 0.1}, "did you mean outer_diameter"),
        ({"width": 0.1}, "no section has"),
        ({}, "no section"),
    ):
        with pytest.raises(an.InputError, match=words):
            drawn_beam([0, 1], steel, **columns)
    with pytest.raises(an.InputError, match="'log'"):
        drawn_beam([0, 1], steel, interpolation="log", outer_diameter=0.1)
