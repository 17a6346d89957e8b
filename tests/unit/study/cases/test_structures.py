"""Studies of beam files: each case is the beam of a file with those numbers in it."""

import json
import math

import numpy as np
import pytest

import antinode as an
from antinode.errors import AntinodeError, InputError
from antinode.study.cases.batches import fits_a_batch
from antinode.study.cases.reasons import FLUTTERS, NO_BEAM, PAST_BUCKLING
from antinode.study.design.points import points_of
from antinode.study.sweep.report import failure_text, summary
from antinode.vehicle.refusals import OUT_OF_RANGE
from cli_run import refused, run

MAST = """
[beam]
name = "mast"
interpolation = "linear"
[beam.stations]
x = [0, 5, 10, 20]
mass_per_length = [300, 250, 200, 150]
bending_stiffness = [1.7e9, 1.3e9, 8e8, 2e8]
axial_stiffness = [9e9, 8e9, 6e9, 4e9]
axial_force = [1e5, 8e4, 5e4, 0]
[beam.ends]
left = "clamped"
"""
CARRYING = (
    MAST
    + """
[[beam.springs]]
x = 15
translational = 1e5
[[beam.point_masses]]
x = 20
mass = 800
rotary_inertia = 50
[[beam.joints]]
x = 10
rotational = 1e-9
"""
)
DAMPED = f"""{CARRYING}
[[beam.dashpots]]
x = 20
translational = 1e3
"""
TUBE = """
[beam]
name = "tube"
interpolation = "linear"
[beam.stations]
x = [0, 10, 20]
outer_diameter = [0.6, 0.5, 0.4]
wall = [0.02, 0.02, 0.01]
[beam.material]
youngs_modulus = "210 GPa"
density = 7850
[beam.ends]
left = "clamped"
"""
COLUMN = """
[beam]
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [1, 1]
[beam.ends]
left = "{left}"
right = "{right}"
"""


@pytest.fixture
def study(tmp_path):
    """Make a study of a beam file from texts."""

    def made(beam, text):
        (tmp_path / "beam.toml").write_text(beam)
        (tmp_path / "study.toml").write_text('case = "beam.toml"\n' + text)
        return an.load_study(tmp_path / "study.toml")

    return made


def inputs(*given, kind="sobol", number=12, solve="modes = 3"):
    """The text of a study with inputs of a range."""
    listed = ", ".join(f'{{ key = "{k}", low = {a}, high = {b} }}' for k, a, b in given)
    design = f'kind = "{kind}", number = {number}'
    return f"inputs = [{listed}]\ndesign = {{ {design} }}\nsolve = {{ {solve} }}\n"


def alone(tmp_path, sets, families=("bending",), modes=3):
    """What a beam file with numbers set says by itself."""
    file = an.load_beam(tmp_path / "beam.toml", [f"beam.{k}={v!r}" for k, v in sets.items()])
    return an.solve_modes(file, modes, families=families, tolerance=1e-10)


NUMBERS = (
    ("springs.0.translational", 0, 1e6),
    ("springs.0.x", 6, 19),
    ("point_masses.0.mass", 10, 2000),
    ("joints.0.rotational", 0, 1e-7),
    ("stations.bending_stiffness.2", 5e8, 9e8),
)


def test_every_number_of_a_beam_is_the_one_that_varies(study, tmp_path):
    found = an.sweep(study(CARRYING, inputs(*NUMBERS)))
    assert found.attrs["failed"] == 0
    names = list(found.attrs["input_names"])
    for i in range(found.sizes["case"]):
        sets = {k: float(found[n][i]) for (k, *_), n in zip(NUMBERS, names, strict=True)}
        own = alone(tmp_path, sets).frequencies_hz()
        assert np.all(np.abs(found.frequency_hz[i] - own) <= found.error_hz[i] + 1e-9 * own)


def test_dashpots_damp_and_move_the_modes(study, tmp_path):
    text = inputs(("dashpots.0.translational", 0, 5e4), ("dashpots.0.x", 12, 20), number=4)
    outputs = 'outputs = ["frequency_hz", "error_hz", "damping_ratio", "growth_rate_per_s"]\n'
    found = an.sweep(study(DAMPED, outputs + text))
    for i in range(4):
        sets = {k: float(found[k][i]) for k in found.attrs["input_names"]}
        own = [m for m in alone(tmp_path, sets).modes if m.number][:3]
        for name in ("frequency_hz", "damping_ratio", "growth_rate_per_s"):
            expected = [getattr(m, name) for m in own]
            np.testing.assert_allclose(found[name][i], expected, rtol=1e-5)
    assert float(found.damping_ratio.min()) > 0 > float(found.growth_rate_per_s.max())


def test_batches_halve_steps_until_each_beam_is_within_the_tolerance(study, tmp_path):
    """A range of ten in one row: one beam needs finer steps than another."""
    rows = ("stations.bending_stiffness.3", 2e7, 2e9), ("stations.mass_per_length.0", 9, 900)
    text = inputs(*rows)
    made = study(MAST, text)
    assert fits_a_batch(made.case.beam(), "bending")
    found = an.sweep(made)
    for i in range(found.sizes["case"]):
        sets = {k: float(found[k][i]) for k in found.attrs["input_names"]}
        own = alone(tmp_path, sets).frequencies_hz()
        off = np.abs(found.frequency_hz[i] - own)
        assert np.all(off <= found.error_hz[i] + 1e-9 * own)
        assert np.all(found.error_hz[i] <= 1.01e-6 * own)


@pytest.mark.parametrize("beam", [MAST, TUBE], ids=["columns", "section"])
def test_columns_take_factors(study, tmp_path, beam):
    column = "bending_stiffness" if beam is MAST else "outer_diameter"
    given = f'inputs = [{{ key = "{column}", values = [0.9, 1.0, 1.1] }}]\nsolve.modes = 2'
    found = an.sweep(study(beam, given))
    own = an.load_beam(tmp_path / "beam.toml").table.stations.given((column,))[column]
    for i, factor in enumerate((0.9, 1.0, 1.1)):
        sets = {f"stations.{column}": (own * factor).tolist()}
        expected = alone(tmp_path, sets, modes=2).frequencies_hz()
        np.testing.assert_allclose(found.frequency_hz[i], expected, rtol=1e-6)


def test_material_and_sections_in_every_family(study):
    """f goes with sqrt(E/rho), whatever the section: bending with shear, a bar, a shaft."""
    text = """
    inputs = [{ key = "material.youngs_modulus", values = ["210 GPa", "52.5 GPa"] }]
    solve = { modes = 2, families = ["bending", "longitudinal", "torsion"] }
    outputs = ["frequency_hz", "mass"]
    """
    found = an.sweep(study(TUBE, text))
    np.testing.assert_allclose(found.frequency_hz[0] / found.frequency_hz[1], 2, rtol=2e-6)
    assert float(found.mass[0]) == float(found.mass[1]) > 0
    assert list(found.mode.values)[2] == "longitudinal 1"


@pytest.mark.parametrize("form", ["haringx", "engesser"])
@pytest.mark.parametrize("attached", ["", "[[beam.point_masses]]\nx = 12\nmass = 100\n"])
def test_what_shear_does_is_solved_in_batches_and_alone(study, tmp_path, form, attached):
    beam = MAST.replace('name = "mast"', f'name = "mast"\nshear_form = "{form}"').replace(
        "axial_force = [1e5", "shear_stiffness = [9e7, 8e7, 5e7, 2e7]\naxial_force = [1e5"
    )
    found = an.sweep(study(beam + attached, inputs(("axial_force", 1, 20), number=8)))
    assert "effect_of_shear" in found
    assert "model_error" not in found
    own = an.load_beam(tmp_path / "beam.toml").table.stations.axial_force
    for i in range(8):
        sets = {"stations.axial_force": (own * float(found.axial_force[i])).tolist()}
        single = alone(tmp_path, sets)
        hz = single.frequencies_hz()
        assert np.all(np.abs(found.frequency_hz[i] - hz) <= found.error_hz[i] + 1e-9 * hz)
        expected = [m.effect_of_shear for m in single.modes if m.number]
        np.testing.assert_allclose(found.effect_of_shear[i], expected, atol=2e-6)


def test_control_points_of_a_column(study, tmp_path):
    text = """
    [[inputs]]
    key = "mass_per_length"
    control_points = 2
    interpolation = "linear"
    low = 0.5
    high = 2
    [design]
    kind = "sobol"
    number = 4
    [solve]
    modes = 1
    """
    found = an.sweep(study(MAST, text))
    file = an.load_beam(tmp_path / "beam.toml")
    x, m = file.table.stations.x, file.table.stations.mass_per_length
    for i in range(4):
        ends = [float(found[n][i]) for n in found.attrs["input_names"]]
        rows = m * np.exp(np.interp(x, [0, 20], np.log(ends)))
        expected = alone(tmp_path, {"stations.mass_per_length": rows.tolist()}, modes=1)
        np.testing.assert_allclose(found.frequency_hz[i], expected.frequencies_hz(), rtol=1e-6)


def test_a_column_under_load_by_its_closed_form(study):
    """f(P)/f(0) = sqrt(1 - P/P_E) for pinned ends; past P_E omega^2 is below zero."""
    text = "inputs = [{ key = 'axial_force', values = [0.001, 5.0, 9.0, 10.0] }]\nsolve.modes = 2"
    found = an.sweep(study(COLUMN.format(left="pinned", right="pinned"), text))
    P = found.axial_force.values
    expected = (np.pi**4 - P * np.pi**2) / 1.0
    text += "\noutputs = ['omega2']"
    own = an.sweep(study(COLUMN.format(left="pinned", right="pinned"), text))
    np.testing.assert_allclose(own.omega2[:, 0], expected, rtol=1e-8)
    assert found.reason.values.tolist() == [0, 0, 0, PAST_BUCKLING]
    assert math.isnan(found.frequency_hz[3, 0])
    (told,) = [w for w in found.attrs["warnings"] if "past buckling" in w["message"]]
    assert (told["count"], told["first_case"]) == (1, 3)


def test_becks_column_flutters_past_20_05(study):
    text = """
    inputs = [
      { key = "axial_force", values = [19.0, 20.0, 20.1] },
      { key = "ends.right_follower", values = [0.0, 1.0] },
    ]
    solve.modes = 2
    """
    found = an.sweep(study(COLUMN.format(left="clamped", right="free"), text))
    assert found.reason.values.tolist()[1::2] == [0, 0, FLUTTERS]
    assert found.reason.values.tolist()[::2] == [PAST_BUCKLING] * 3
    (told,) = [w for w in found.attrs["warnings"] if "flutter" in w["message"]]
    assert (told["count"], told["first_case"]) == (1, 5)


def test_a_case_that_fails_says_why_and_leaves_the_others(study):
    text = """
    inputs = [
      { key = "springs.0.x", values = [15, 25] },
      { key = "springs.0.translational", values = [1e5, -1] },
    ]
    solve.modes = 2
    """
    made = study(CARRYING, text)
    found = an.sweep(made)
    assert found.reason.values.tolist() == [0, OUT_OF_RANGE, NO_BEAM, OUT_OF_RANGE]
    assert np.isnan(found.frequency_hz[1:]).all()
    assert np.isfinite(found.frequency_hz[0]).all()
    assert "off the beam" in failure_text(points_of(made), 2)
    assert summary(points_of(made), found)["failed"] == 3


WARNED = MAST.replace('left = "clamped"', "")


@pytest.mark.parametrize("attached", ["", "[[beam.point_masses]]\nx = 3\nmass = 100\n"])
def test_warnings_are_those_of_each_beam_alone(study, tmp_path, attached):
    """In batches and one by one: rotation of a free body, and shear by modes."""
    text = inputs(("axial_force", 0.01, 5), ("axial_stiffness", 0.01, 2), number=16)
    found = an.sweep(study(WARNED + attached, text))
    texts, bits = found.warned.attrs["flag_meanings"], found.warned.values
    for i in range(16):
        sets = {}
        file = an.load_beam(tmp_path / "beam.toml").table.stations
        for name in ("axial_force", "axial_stiffness"):
            sets[f"stations.{name}"] = (getattr(file, name) * float(found[name][i])).tolist()
        own = alone(tmp_path, sets).warnings
        told = [t for k, t in enumerate(texts) if bits[i] >> k & 1]
        for part in ("rotation is divergent", "lower the frequency by more", "below zero"):
            assert any(part in w for w in own) == any(part in t for t in told), (i, own, told)
        assert len(told) <= len(own)
    assert any(w["count"] > 0 for w in found.attrs["warnings"])


def test_modes_are_tracked_along_a_beam_that_starts_off_zero(study):
    beam = MAST.replace("x = [0, 5, 10, 20]", "x = [2, 7, 12, 22]")
    text = "inputs = [{ key = 'bending_stiffness', values = [1.0, 1.1] }]\nsolve.modes = 2"
    found = an.sweep(study(beam, text))
    assert found.point.values[[0, -1]].tolist() == [2, 22]
    np.testing.assert_allclose(found.tracked_mac, 1, atol=1e-9)
    assert abs(float(found.shape[0, 0, 0])) < 1e-9  # clamped


def test_slopes_by_differences_against_closed_forms(study):
    """A pinned column: omega^2 = (pi^4 EI - P pi^2)/m; a factor of 1 is where the file is."""
    text = """
    inputs = [{ key = "bending_stiffness", low = 0.9, high = 1.1 },
              { key = "mass_per_length", low = 0.9, high = 1.1 },
              { key = "axial_force", low = 0.5, high = 2 }]
    solve.modes = 2
    """
    made = study(COLUMN.format(left="pinned", right="pinned"), text)
    first = an.sensitivity(made, 8).modes[0]
    share = np.pi**4 / (np.pi**4 - np.pi**2)
    np.testing.assert_allclose(first.elasticity, [share / 2, -0.5, (1 - share) / 2], rtol=1e-8)


def test_the_slope_by_a_share_at_its_bound_is_taken_on_one_side(study, tmp_path):
    beam = COLUMN.format(left="clamped", right="free")
    made = study(beam, inputs(("ends.right_follower", 0, 0.4), solve="modes = 1"))
    slope = float(an.sensitivity(made, 8).modes[0].slope[0])
    h = 1e-4
    f0, f1 = (
        an.solve_modes(
            an.load_beam(tmp_path / "beam.toml", [f"beam.ends.right_follower={share}"]), 1
        ).frequencies_hz()[0]
        for share in (0.0, h)
    )
    assert slope == pytest.approx((f1 - f0) / h, rel=1e-3)


@pytest.mark.parametrize(
    ("key", "told"),
    [
        ("bending_stifness", "did you mean bending_stiffness"),
        ("torsional_stiffness", "no such column"),
        ("springs.1.x", "give an index from 0 to 0"),
        ("ends.left_follower", "left is held"),
        ("ends.left", "the choice 'clamped'"),
        ("loads.gravity", "write that table first"),
        ("stations.x.1", "positions of stations stay"),
        ("x", "positions of stations stay"),
        ("condition.speed", "leads nowhere"),
    ],
)
def test_a_key_that_cannot_vary_is_refused_in_a_sentence(study, key, told):
    with pytest.raises(InputError, match=told):
        points_of(study(CARRYING, inputs((key, 0.1, 0.2))))


def test_what_a_beam_does_not_have_is_refused(study):
    with pytest.raises(InputError, match="F_CX is of vehicles"):
        points_of(study(MAST, "outputs = ['F_CX']\n" + inputs(("axial_force", 1, 2))))
    with pytest.raises(InputError, match="torsion modes need polar_inertia_per_length"):
        points_of(study(MAST, inputs(("axial_force", 1, 2), solve="families = ['torsion']")))
    held = CARRYING.replace("translational = 1e5", "translational = inf")
    with pytest.raises(InputError, match="leads to a support"):
        points_of(study(held, inputs(("springs.0.translational", 1, 2))))
    assert issubclass(InputError, AntinodeError)


def test_the_commands_take_beam_files(study, tmp_path):
    study(MAST, inputs(("bending_stiffness", 0.9, 1.1), ("axial_force", 0.5, 2), number=16))
    file, store = tmp_path / "study.toml", tmp_path / "s.zarr"
    swept = json.loads(run("sweep", file, "-o", store, "--json").out)
    assert (swept["name"], swept["cases"], swept["failed"]) == ("mast", 16, 0)
    assert swept["inputs"][0]["key"] == "beam.stations.bending_stiffness"
    asked = json.loads(run("ask", store, "--share", "f1 > 0", "--smallest", "f1", "--json").out)
    assert asked["shares"][0]["share"] == 1
    again = json.loads(run("sweep", file, "-o", store, "--json").out)
    assert again["modes"] == swept["modes"]
    beam = tmp_path / "beam.toml"
    given = ("--uncertain", "bending_stiffness=2%", "--samples", 8, "--json")
    found = json.loads(run("sensitivity", beam, *given).out)
    assert found["modes"][0]["inputs"][0]["percent_per_percent"] == pytest.approx(0.5, abs=0.02)
    refused(run("sweep", beam), "name it in a study file")
