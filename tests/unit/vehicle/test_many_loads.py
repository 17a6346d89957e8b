"""Loads and chains of many cases at once, against one case at a time."""

import numpy as np
import pytest

import antinode as an
from antinode.study.cases.values import case_of
from antinode.study.design.file import LOAD_OUTPUTS
from antinode.vehicle.loads import compute_loads
from antinode.vehicle.many_beams import ManyBeams
from antinode.vehicle.many_loads import compute_many_loads
from cli_run import replaced, run

RANGES = {
    ("condition", "speed"): (55, 130),
    ("condition", "cavitation_number"): (0.011, 0.12),
    ("condition", "cavitator_angle"): (-0.2, 0.3),
    ("condition", "body_angle"): (-0.03, 0.03),
    ("condition", "thrust"): (0, 2e5),
    ("condition", "fin_position"): (3.3, 6.0),
    ("condition", "burn_fraction"): (0, 1),
    ("water", "density"): (990, 1030),
    ("vehicle", "cavitator", "diameter"): (0.07, 0.09),
    ("vehicle", "fins", 0, "thickness"): (0.01, 0.02),
    ("vehicle", "fins", 0, "deflection"): (-0.1, 0.1),
}
DEPTHS = {
    ("condition", "depth"): (0, 12),
    ("condition", "cavity_pressure"): (0.7e5, 1.8e5),
    ("condition", "speed"): (60, 120),
}
CHOICES = [
    "",
    'gravity_rise = "buoyancy"',
    'distortion = "none"\ngravity_rise = "none"\nplaning_angle = "axis"',
    'fin_immersion = "tip_distance"\nfin_lift = "none"\nplaning_area = "projected"',
    'planing_position = "tail"\nplaning_angle = "attitude"\nplaning_direction_width = 0',
    'planing = "none"\naxial_force = "element_midpoint"',
]


def case_with(tmp_path, model="", example="starter"):
    run("init", "--example", example, tmp_path)
    if model:
        file = tmp_path / "case.toml"
        text = file.read_text().replace("# [model] ", "[model] ")
        file.write_text(text.replace("\n[solve]", f"\n{model}\n\n[solve]"))
    return an.load_case(tmp_path / "case.toml")


def sampled(ranges, cases, seed):
    rng = np.random.default_rng(seed)
    return {keys: rng.uniform(*ends, cases) for keys, ends in ranges.items()}


def scalars(loads):
    table = {name: getattr(loads, name, None) for name in LOAD_OUTPUTS}
    return table | {"cavity_length": loads.cavity.L_c, "cavity_diameter": loads.cavity.D_c}


def compare(case, numbers, cases):
    """Largest difference of any number, over its scale among the cases; cases that fail agree."""
    many = compute_many_loads(case, numbers, cases)
    scale = {name: np.nanmax(np.abs(v)) or 1.0 for name, v in many.scalars.items()}
    worst, failed = 0.0, 0
    for i in range(cases):
        one = case_of(case, numbers, i)
        try:
            loads = compute_loads(one.vehicle, one.condition, one.water, one.model)
        except an.InputError:
            assert many.code[i] != 0
            failed += 1
            continue
        assert many.code[i] == 0
        for name, value in scalars(loads).items():
            worst = max(worst, abs(many.scalars[name][i] - value) / scale[name])
    return worst, failed


@pytest.mark.parametrize("model", CHOICES)
def test_loads_of_many_cases_are_those_of_each(tmp_path, model):
    case = case_with(tmp_path, model)
    worst, failed = compare(case, sampled(RANGES, 60, 1), 60)
    assert worst < 1e-12
    assert failed == 0


def test_depth_and_pressure_give_the_cavitation_number(tmp_path):
    replaced_case = case_with(tmp_path)
    replaced(tmp_path / "case.toml", "cavitation_number = 0.02", "depth = 3")
    case = an.load_case(tmp_path / "case.toml")
    assert case != replaced_case
    worst, failed = compare(case, sampled(DEPTHS, 80, 2), 80)
    assert worst < 1e-12
    assert 5 < failed < 75


def test_fins_off_the_body_fail(tmp_path):
    numbers = sampled({("condition", "fin_position"): (5, 7)}, 30, 3)
    worst, failed = compare(case_with(tmp_path), numbers, 30)
    assert worst < 1e-12
    assert failed == np.sum(numbers["condition", "fin_position"] > 6)


LINEAR = """
interpolation = "{how}"
[vehicle.stations]
x = [0, 1, 2.5, 6]
mass_per_length = [150, 400, 420, 260]
bending_stiffness = [4e5, 3e6, 3e6, 1e6]
axial_stiffness = [1e8, 5e8, 5e8, 3e8]
radius = [0.05, 0.12, 0.17, 0.17]
"""
TANK = """
[[vehicle.masses]]
x = [1.5, 3.1]
mass_per_length = [90, 70]
interpolation = "linear"
burns = true
"""


@pytest.mark.parametrize("how", ["step", "linear", "log"])
def test_chains_are_those_of_the_beam(tmp_path, how):
    """Masses that vary, parts that burn, forces inside cells: frequencies within the estimate."""
    run("init", tmp_path)
    text = (tmp_path / "case.toml").read_text()
    start, end = text.index('interpolation = "step"'), text.index("[vehicle.cavitator]")
    tank = "" if how == "log" else TANK
    text = (
        text[:start]
        + LINEAR.format(how=how)
        + "\n"
        + text[end:].replace("[condition]", f"{tank}\n[condition]", 1)
    )
    (tmp_path / "case.toml").write_text(text)
    case = an.load_case(tmp_path / "case.toml")
    numbers = sampled({k: v for k, v in RANGES.items() if k[0] == "condition"}, 12, 4)
    rows = case.vehicle.stations.bending_stiffness
    factors = np.random.default_rng(5).uniform(0.9, 1.1, (12, len(rows)))
    numbers["vehicle", "stations", "bending_stiffness"] = rows * factors
    mass = case.vehicle.stations.mass_per_length["initial"]
    numbers["vehicle", "stations", "mass_per_length", "initial"] = mass * factors[::-1]
    worst, _ = compare(case, numbers, 12)
    assert worst < 1e-12
    beams = ManyBeams(case, numbers, compute_many_loads(case, numbers, 12))
    for refinement, allowed in ((4, 1e-6), (8, 1e-7)):
        for chains in beams.chains(np.arange(12), refinement):
            for k, i in enumerate(chains.rows):
                table = (chains.length, chains.mass, chains.stiffness, chains.axial_force)
                batch = an.BeamBatch(*(v[k if len(v) > 1 else 0] for v in table), modes=3)
                hz = an.solve_many(batch).frequencies_hz[0]
                exact = an.solve_modes(
                    case_of(case, numbers, int(i)), 3, tolerance=1e-10, families=["bending"]
                )
                assert hz == pytest.approx(exact.frequencies_hz(), rel=allowed)
