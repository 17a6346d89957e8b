"""Loads and chains of many cases at once: a case is the same whatever stands beside it."""

import numpy as np
import pytest

import antinode as an
from antinode.study.cases.values import case_of
from antinode.vehicle.forces import forces_of
from antinode.vehicle.load_warnings import validity_of
from antinode.vehicle.loads import compute_loads
from antinode.vehicle.many_beams import ManyBeams, sheared_columns
from antinode.vehicle.many_loads import loads_of_many
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


def loads_alone(one):
    return compute_loads(one.vehicle, one.condition, one.water, one.model)


def sentence(function, argument):
    """What an input is refused with."""
    with pytest.raises(an.InputError) as error:
        function(argument)
    return str(error.value)


def sentences(many, i):
    return tuple(w.sentence(i) for w in many.warnings if w.concerns[i])


def compare(case, numbers, cases):
    """Hold every case to itself alone, to the last bit; return how many have no loads."""
    many, failed = loads_of_many(case.many(numbers, cases)), 0
    for i in range(cases):
        one = case_of(case, numbers, i)
        if many.refusals.code[i]:
            assert sentence(many.refusals.check, i) == sentence(loads_alone, one)
            failed += 1
            continue
        loads = loads_alone(one)
        assert {name: v[i] for name, v in many.numbers.items()} == loads.numbers
        assert forces_of(many.hydrodynamics.forces, i) == loads.forces
        assert many.hydrodynamics.planing.of(i) == loads.planing
        assert validity_of(many.ranges, i) == loads.validity
        assert sentences(many, i) == loads.warnings
    return failed


@pytest.mark.parametrize("model", CHOICES)
def test_loads_of_many_cases_are_those_of_each(tmp_path, model):
    case = case_with(tmp_path, model)
    assert compare(case, sampled(RANGES, 60, 1), 60) == 0


def test_depth_and_pressure_give_the_cavitation_number(tmp_path):
    replaced_case = case_with(tmp_path)
    replaced(tmp_path / "case.toml", "cavitation_number = 0.02", "depth = 3")
    case = an.load_case(tmp_path / "case.toml")
    assert case != replaced_case
    assert 5 < compare(case, sampled(DEPTHS, 80, 2), 80) < 75


def test_fins_off_the_body_fail(tmp_path):
    numbers = sampled({("condition", "fin_position"): (5, 7)}, 30, 3)
    failed = compare(case_with(tmp_path), numbers, 30)
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
    assert compare(case, numbers, 12) == 0
    beams = ManyBeams(loads_of_many(case.many(numbers, 12)))
    for refinement, allowed in ((4, 1e-6), (8, 1e-7)):
        for chains in beams.chains(np.arange(12), refinement):
            for k, i in enumerate(chains.rows):
                table = (chains.length, chains.mass, chains.stiffness, chains.axial_force)
                own = (v[k if len(v) > 1 else 0] for v in table)
                more = sheared_columns({name: v[k] for name, v in chains.more.items()})
                batch = an.BeamBatch(*own, modes=3, following=chains.following[k], **more)
                hz = an.solve_many(batch).frequencies_hz[0]
                exact = an.solve_modes(
                    case_of(case, numbers, int(i)), 3, tolerance=1e-10, families=["bending"]
                )
                assert hz == pytest.approx(exact.frequencies_hz(), rel=allowed)
