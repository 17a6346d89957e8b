"""What no beam has is refused, each in one sentence that names the place and the way out."""

import pytest

from cli_run import refused, run

OWN = {
    "x": "[0, 2]",
    "mass_per_length": "[10, 10]",
    "bending_stiffness": "[1e4, 1e4]",
    "axial_stiffness": "[1e7, 1e7]",
}
SHEARED = OWN | {"shear_stiffness": "[1e5, 1e5]"}
DRAWN = '[beam.material]\nyoungs_modulus = "210 GPa"\ndensity = "7850 kg/m^3"\n'
ROUND = {"x": "[0, 2]", "outer_diameter": '["40 mm", "40 mm"]'}
BOX = {"x": "[0, 2]", "width": '["40 mm", "40 mm"]', "height": '["30 mm", "30 mm"]'}

CASES = [
    (SHEARED | {"axial_force": "[2e5, 2e5]"}, 'shear_form = "engesser"', "", "N < kGA"),
    (SHEARED | {"axial_force": "[-2e5, -2e5]"}, "", "", "kGA + N > 0"),
    (SHEARED | {"x": "[0, 2]", "axial_force": "[0, -4e5]"}, 'interpolation = "linear"', "", "kGA"),
    (OWN | {"rotary_inertia_per_length": "[1, -1]"}, "", "", "row 2, is -1; it must be zero"),
    (OWN | {"shear_stiffness": "[-1, 1]"}, "", "", "it must be positive, or inf"),
    (OWN | {"foundation_stiffness": "[-1, 0]"}, "", "", "it must be zero or positive"),
    (OWN | {"added_mass_per_length": "[0, -1]"}, "", "", "it must be zero or positive"),
    (OWN | {"torsional_stiffness": "[1e3, 1e3]"}, "", "", "polar_inertia_per_length is missing"),
    (OWN, "", "[[beam.point_masses]]\nx = 1\nmass = 1\nrotary_inertia = -1\n", "at least 0"),
    (ROUND | {"wall": '["25 mm", "25 mm"]'}, "", DRAWN, "the radius"),
    (ROUND | {"outer_diameter": "[0.04, 0.01]", "wall": "[8e-3, 8e-3]"}, "", DRAWN, "row 2 has"),
    (BOX | {"wall": '["16 mm", "16 mm"]'}, "", DRAWN, "half of width and of height"),
    (OWN, "", DRAWN, "stations have no section"),
    (ROUND, "", "", "[beam.material] is missing"),
    (ROUND | {"bending_stiffness": "[1e4, 1e4]"}, "", DRAWN, "remove one of them"),
    (ROUND | {"mass_per_length": "[1, 1]"}, "", DRAWN, "[[beam.masses]]"),
    (ROUND | {"width": "[0.04, 0.04]"}, "", DRAWN, "no section has the columns"),
    ({"x": "[0, 2]", "wall": "[8e-3, 8e-3]"}, "", DRAWN, "no section has the columns wall"),
    (ROUND, "", DRAWN + "poisson_ratio = 0.7\n", "at most 0.5"),
    (ROUND, "", DRAWN + "shear_coefficient = -0.5\n", "greater than 0"),
    (OWN, "", '[beam.ends]\nright = "clamped"\nright_follower = 1\n', "with a free end only"),
    (OWN, "", "[[beam.dashpots]]\nx = 1\n", "all values are 0"),
    (OWN, "", '[[beam.dashpots]]\nx = 1\ntranslational = "1 N/m"\n', "no unit of N s/m"),
]


@pytest.mark.parametrize(("columns", "choice", "tables", "word"), CASES)
def test_it_is_refused(columns, choice, tables, word, tmp_path):
    stations = ", ".join(f"{name} = {values}" for name, values in columns.items())
    path = tmp_path / "b.toml"
    path.write_text(f"[beam]\n{choice}\nstations = {{ {stations} }}\n{tables}")
    ended = run("beam", path, "--modes", "1")
    refused(ended, word)
    assert str(path) in ended.err
