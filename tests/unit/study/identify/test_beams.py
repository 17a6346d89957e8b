"""Identification of a beam file: any number of it may change, and a row may set any other."""

import json
import math

import numpy as np
import pytest

import antinode as an
from antinode.study.identify.identification import prepare
from cli_run import refused, run

MAST = """# a mast with a lamp at its top
[beam]
name = "mast"
interpolation = "linear"
stations = { x = [1, 5, 9], outer_diameter = [0.2, 0.16, 0.12], wall = [6e-3, 5e-3, 4e-3] }
[beam.material]
youngs_modulus = "70 GPa"   # an alloy
density = "2700 kg/m^3"
[[beam.springs]]
x = 1
translational = "5e6 N/m"
rotational = "2e6 N m"
[[beam.point_masses]]
x = "8.5 m"
mass = "12 kg"
rotary_inertia = "0.4 kg m^2"
"""

FILE = """case = "mast.toml"
observations = "observed.csv"
[[parameters]]
key = "springs.0.rotational"
scale = "log"
[[parameters]]
key = "point_masses.0.x"
lower = "7 m"
upper = "9 m"
[[parameters]]
key = "material.youngs_modulus"
prior = { sd = "5 GPa" }
"""

TRUTH = {
    "springs.0.rotational": 1.3e6,
    "point_masses.0.x": 8.2,
    "material.youngs_modulus": 68e9,
}
LAMPS = {"one lamp": 12.0, "three lamps": 33.0}


def frequencies(folder, lamp, numbers=4, **others):
    values = {f"beam.{key}": value for key, value in (TRUTH | others).items()}
    sets = [f"{key}={value}" for key, value in values.items()]
    beam = an.load_beam(folder / "mast.toml", [*sets, f"beam.point_masses.0.mass={lamp}"]).beam()
    return np.sqrt(an.natural_frequencies(beam, numbers, tolerance=1e-9).omega2) / (2 * math.pi)


def write(folder, hz):
    heading = ", ".join(f"bending:{k} [Hz]" for k in range(1, 5))
    lines = [f"name, point_masses.0.mass [kg], {heading}"]
    for (name, lamp), row in zip(LAMPS.items(), hz, strict=True):
        lines.append(", ".join([name, str(lamp), *map(repr, map(float, row))]))
    (folder / "observed.csv").write_text("\n".join(lines) + "\n")


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "mast.toml").write_text(MAST)
    (tmp_path / "identify.toml").write_text(FILE)
    write(tmp_path, [frequencies(tmp_path, lamp) for lamp in LAMPS.values()])
    return tmp_path


def test_exact_frequencies_give_the_numbers_they_were_made_with(folder):
    """A spring, the place of a mass and a modulus; the prior of one is far too wide to pull."""
    problem = an.load_identification(folder / "identify.toml", ["fit.relative_sd=1e-7"])
    result = an.identify(problem)
    for parameter, (key, value) in zip(result.parameters, TRUTH.items(), strict=True):
        assert parameter.name == key
        assert parameter.value == pytest.approx(value, rel=1e-5)
    assert result.name == "mast"
    assert result.row_case(2).table.point_masses[0].mass == 33.0


def test_derivatives_are_those_of_closed_forms(folder):
    """All frequencies go with sqrt(E) once the springs do not matter."""
    stiff = MAST.replace("5e6 N/m", "5e15 N/m").replace("2e6 N m", "2e15 N m")
    (folder / "mast.toml").write_text(stiff)
    misfit = prepare(an.load_identification(folder / "identify.toml", ["fit.sd=1"]))
    at = misfit.evaluate(misfit.unknowns.start)
    by_modulus = misfit.jacobian(at)[:, 2]
    hz = np.concatenate([at.fitted_hz(k, "bending") for k in range(2)])
    assert by_modulus == pytest.approx(hz / 2 * 5e9 / 70e9, rel=1e-6)


def test_intervals_hold_the_truth(folder):
    """Of 8 twins with noise of 1e-3; at 95 %, fewer than 18 of 24 are 2 in 10,000."""
    same = MAST.replace("[0.2, 0.16, 0.12]", "[0.2, 0.2, 0.2]").replace("5e-3, 4e-3", "6e-3, 6e-3")
    (folder / "mast.toml").write_text(same)
    inside, rng = 0, np.random.default_rng(7)
    clean = [frequencies(folder, lamp) for lamp in LAMPS.values()]
    for _ in range(8):
        write(folder, [row * (1 + 1e-3 * rng.standard_normal(4)) for row in clean])
        settings = ["fit.relative_sd=1e-3", "fit.frequency_tolerance=1e-6"]
        result = an.identify(an.load_identification(folder / "identify.toml", settings))
        for parameter, value in zip(result.parameters, TRUTH.values(), strict=True):
            low, high = parameter.interval
            inside += low <= value <= high
    assert inside >= 18


def test_a_column_changes_along_the_beam(folder):
    (folder / "identify.toml").write_text(
        'case = "mast.toml"\nobservations = "observed.csv"\n[fit]\nrelative_sd = 1e-4\n'
        '[[distributions]]\ncolumn = "wall"\ncontrol_points = 2\nprior_sd = 0.3\n'
    )
    wall = [6e-3 * 1.1, 5e-3 * math.sqrt(1.1 * 0.95), 4e-3 * 0.95]
    own = {"springs.0.rotational": 2e6, "point_masses.0.x": 8.5, "material.youngs_modulus": 70e9}
    write(
        folder,
        [frequencies(folder, lamp, **own, **{"stations.wall": wall}) for lamp in LAMPS.values()],
    )
    result = an.identify(an.load_identification(folder / "identify.toml"))
    assert [p.value for p in result.parameters] == pytest.approx([1.1, 0.95], rel=1e-4)
    assert [p.name for p in result.parameters] == ["wall at 1 m", "wall at 9 m"]


def test_the_fitted_beam_is_a_file_that_gives_these_frequencies(folder):
    ended = run("identify", folder / "identify.toml", "-o", folder / "fitted", "--json")
    assert ended.code == 0, ended.err
    text = (folder / "fitted" / "beam.toml").read_text()
    assert "# an alloy" in text
    assert 'density = "2700 kg/m^3"' in text
    found = json.loads(run("beam", folder / "fitted" / "beam.toml", "--json").out)
    hz = [mode["frequency_hz"] for mode in found["modes"] if mode["family"] == "bending"][:4]
    assert hz == pytest.approx(frequencies(folder, 12.0).tolist(), rel=1e-5)
    refused(run("identify", folder / "identify.toml", "-o", folder / "fitted"), "exists already")


def test_a_row_of_a_vehicle_sets_any_number_too(tmp_path):
    run("init", tmp_path)
    case = an.load_case(tmp_path / "case.toml", ["vehicle.cavitator.diameter=0.079"])
    hz = an.solve_modes(case, 2).frequencies_hz("bending").tolist()
    (tmp_path / "identify.toml").write_text(
        'case = "case.toml"\n[[parameters]]\nkey = "thrust"\n[fit]\nrelative_sd = 1e-4\n'
        f"[[observations]]\nbending = {hz}\n"
        'inputs = { "vehicle.cavitator.diameter" = "79 mm" }\n'
    )
    result = an.identify(an.load_identification(tmp_path / "identify.toml"))
    assert result.parameter("thrust").value == pytest.approx(case.condition.thrust, rel=1e-4)


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ('parameters=[{key="springs.7.rotational"}]', ["without '7'"]),
        ('parameters=[{key="stations.x.1"}]', ["stay as they are"]),
        ('parameters=[{key="rotor"}]', ["parameters: key = 'rotor' leads nowhere"]),
        ("observations=[{speed=3,bending=[2.0]}]", ["row 1: speed", "no operating condition"]),
        (
            'observations=[{inputs={"point_masses.0.mass"="3 m"},bending=[2.0]}]',
            ["row 1: inputs", "'m' is no unit of kg"],
        ),
        (
            'observations=[{inputs={"point_masses.0.mass"=-3},bending=[2.0]}]',
            ["point_masses.0.mass is -3", "0 to inf"],
        ),
        (
            'observations=[{inputs={"material.youngs_modulus"="69 GPa"},bending=[2.0, 9.0]}]',
            ["row 1 sets youngs_modulus", "per_row"],
        ),
        (
            'distributions=[{column="radius",control_points=2}]',
            ["allowed are outer_diameter, wall"],
        ),
        (
            'parameters=[{key="stations.wall.1"}]'
            '\ndistributions=[{column="wall",control_points=2}]',
            ["part of a distribution already"],
        ),
    ],
)
def test_what_cannot_be_is_one_sentence(folder, setting, words):
    sets = [part for each in setting.split("\n") for part in ("--set", each)]
    refused(run("identify", folder / "identify.toml", *sets), *words)
