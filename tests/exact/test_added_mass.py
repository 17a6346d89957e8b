"""Added mass of a vehicle's fins and tail: its size by brute force, its modes by elements."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from following_beams import _scaled

import antinode as an
from antinode.study.cases.chunks import compute_chunk
from antinode.study.design.points import points_of
from antinode.study.sensitivity.local import local_slopes
from antinode.vehicle.hydrodynamics.added_mass import fin_mass, plate, tail_mass, wedge
from antinode.vehicle.numbers import replaced, value_at
from cli_run import refused, run
from hp_beam import _weighted
from study_text import study

BOTH = {"fin_added_mass": "plate", "planing_added_mass": "wedge"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("added")
    run("init", "--example", "sweep", folder)
    return folder


def case_of(folder, *more, **model):
    words = [f"model.{key}={value}" for key, value in model.items()]
    return an.load_case(folder / "case.toml", [*words, *more])


def test_the_formulas_by_hand():
    assert plate(1000.0, 0.2) == pytest.approx(31.41592654, rel=1e-9)  # 1000 pi 0.2^2/4
    assert wedge(1000.0, 0.2) == pytest.approx(15.70796327, rel=1e-9)
    cross = (0.0, math.pi / 2, math.pi, 3 * math.pi / 2)  # two fins stand across the motion
    assert fin_mass(1000.0, 0.2, (0.3,) * 4, cross, 2) == pytest.approx(18.84955592, rel=1e-9)
    slanted = fin_mass(1000.0, 0.2, (0.3,), (math.pi / 4,), 1)
    assert slanted == pytest.approx(31.41592654 * 0.3 / 2 / 2, rel=1e-9)


def wetted_by_points(case, places=1501, points=4000):
    """Added mass of the tail: at each place the width of what points of the circle are wet."""
    cavity, body = case.loads.cavity, case.vehicle.radius_profile
    x = np.linspace(cavity.L_c / 2, case.vehicle.length, places)
    around = np.linspace(-math.pi, math.pi, points, endpoint=False)
    total = []
    for place in x:
        R = float(case.vehicle.radius_at(np.array([place]))[0])
        hole, off = float(cavity.radius(place)), float(cavity.axis_offset(place))
        wet = np.hypot(R * np.sin(around), R * np.cos(around) - off) > hole
        if wet.all():
            total.append(case.water.density * math.pi * R**2)
            continue
        across = R * np.sin(around[wet])
        wide = wet.mean() >= 0.5
        width = 2 * R if wide else (np.ptp(across) if wet.any() else 0.0)
        total.append(case.water.density * math.pi * width**2 / 8)
    assert body.x[-1] == case.vehicle.length
    return float(np.trapezoid(total, x))


@pytest.mark.parametrize("sigma", [0.02, 0.0215, 0.03])
def test_the_tail_by_brute_force(folder, sigma):
    case = case_of(folder, f"condition.cavitation_number={sigma}", **BOTH)
    cavities = case.many_loads.hydrodynamics.cavity
    (mine,) = tail_mass(np.array([case.water.density]), cavities, case.vehicle.radius_profile)
    assert mine > 0.1
    assert mine == pytest.approx(wetted_by_points(case), rel=5e-3)


@pytest.mark.parametrize("end_force", ["fixed_direction", "follows_body"])
def test_modes_are_those_of_elements_that_carry_it(folder, end_force):
    case = case_of(folder, theory="euler_bernoulli", end_force=end_force, **BOTH)
    parts = case.added_masses
    assert [p.name for p in parts] == ["fin set 1", "tail"]
    result = an.solve_modes(case, 3, families=["bending"], tolerance=1e-9)
    beam = case.beam()
    added = beam.added_mass_per_length
    spread = np.sum(added[:, 0] * np.diff(beam.x))
    assert spread == pytest.approx(sum(p.mass for p in parts), rel=1e-12)
    assert case.loads.mass == pytest.approx(case_of(folder).loads.mass, rel=1e-15)
    mesh, K, M, d = _scaled(replace(beam, added_mass_per_length=None), 3, 3e4)
    middle = np.cumsum(mesh.h) - mesh.h / 2
    interval = np.searchsorted(beam.x, middle) - 1
    _, w = np.polynomial.legendre.leggauss(mesh.mass.shape[1])
    own = _weighted(added[interval, :1] * w * mesh.h[:, None] / 2, mesh.value)
    for e, dofs in enumerate(mesh.dofs):
        M[np.ix_(dofs, dofs)] += own[e] * np.outer(d[dofs], d[dofs])
    shift = 3e4
    theta = np.linalg.eigvals(np.linalg.solve(K - shift * M, M))
    exact = shift + 1 / theta[np.abs(theta) > 1e-9 * np.abs(theta).max()]
    bending = [m for m in result.modes if m.number]
    plain = an.solve_modes(case_of(folder, theory="euler_bernoulli", end_force=end_force), 3)
    for mode, without in zip(bending, plain.family("bending")[2:], strict=True):
        near = exact[np.argmin(np.abs(exact - mode.omega2))]
        assert mode.omega2 == pytest.approx(near.real, rel=1e-8)
        assert mode.omega2 < without.omega2 * (1 - 1e-5)


def test_its_size_is_printed_and_what_is_left_out_is_named(folder):
    path, words = folder / "case.toml", ["--modes", "2"]
    ended = run("modes", path, *words, "--set", "model.fin_added_mass=plate_one_face")
    out = " ".join(ended.out.split())
    assert "added mass, sideways alone: fin set 1 2.221 kg (plate with a cavity behind" in out
    left = out[out.index("Not in the model") :]
    assert "added mass of the planing tail" in left
    assert "added mass of wetted parts" not in left
    both = [word for key, value in BOTH.items() for word in ("--set", f"model.{key}={value}")]
    data = json.loads(run("modes", path, *words, *both, "--json").out)
    fins, tail = data["water"]["added_mass"]
    assert fins["mass_kg"] == pytest.approx(4.442, rel=1e-3)
    assert tail["mass_kg"] == pytest.approx(0.1705, rel=1e-3)
    assert not any("added mass" in text for text in data["not_modelled"])
    plain = json.loads(run("modes", path, *words, "--json").out)
    first = [{m["name"]: m for m in each["modes"]}["bending 1"] for each in (data, plain)]
    f1, dry = (mode["frequency_hz"] for mode in first)
    assert f1 / dry - 1 == pytest.approx(-0.0014, abs=5e-5)
    assert "added_mass" not in plain["water"]
    assert "added mass of wetted parts" in plain["not_modelled"]


INPUTS = """
[[inputs]]
key = "condition.cavitation_number"
low = 0.0195
high = 0.0225
[[inputs]]
key = "condition.fin_position"
low = 4.1
high = 5.7
[[inputs]]
key = "water.density"
low = 990
high = 1030
[[inputs]]
key = "vehicle.fins.0.tip_radius"
low = 0.3
high = 0.4
"""
STUDY = """
outputs = ["frequency_hz", "error_hz", "omega2"]
[design]
kind = "sobol"
number = 16
[solve]
modes = 3
families = ["bending", "longitudinal"]
"""


@pytest.mark.parametrize("axial_force", ["element_midpoint", "exact"])
@pytest.mark.parametrize("interpolation", ["step", "linear"])
def test_cases_of_a_study_have_the_water_of_each(folder, interpolation, axial_force):
    model = {"axial_force": axial_force, "end_force": "fixed_direction", **BOTH}
    case = case_of(folder, f"vehicle.interpolation={interpolation}", **model)
    points = points_of(study(case, STUDY + INPUTS))
    found = compute_chunk(points, 0)
    exact = (interpolation, axial_force) == ("step", "element_midpoint")
    water = set()
    for i in range(16):
        own = case
        for variable in points.variables:
            own = replaced(own, variable.keys, float(found[variable.name][i]))
        water.add(sum(part.mass for part in own.added_masses))
        result = an.solve_modes(own, 3, tolerance=1e-9, families=["bending", "longitudinal"])
        hz = [m.frequency_hz for m in result.modes if m.number]
        off = np.abs(found["frequency_hz"][i] - hz)
        assert np.all(off <= (1e-12 * np.array(hz) if exact else found["error_hz"][i] + 1e-9))
    assert len(water) == 16
    assert max(water) > 2 * min(water)


@pytest.mark.parametrize("end_force", ["fixed_direction", "follows_body"])
def test_derivatives_know_the_water(folder, end_force):
    case = case_of(folder, "condition.cavitation_number=0.021", end_force=end_force, **BOTH)
    points = points_of(study(case, STUDY + INPUTS))
    found = local_slopes(points.study, points)
    for k, variable in enumerate(points.variables):
        value = value_at(case, variable.keys)
        step = 1e-4 * value
        low, high = (
            an.solve_modes(
                replaced(case, variable.keys, value + sign * step), 3, tolerance=1e-11
            ).family("bending")
            for sign in (-1, 1)
        )
        pairs = zip(low, high, strict=True)
        slopes = [(b.frequency_hz - a.frequency_hz) / (2 * step) for a, b in pairs if a.number]
        mine = [found[f"bending {n}"][1][k] for n in (1, 2, 3)]
        np.testing.assert_allclose(mine, slopes, rtol=2e-4, atol=2e-5 * np.abs(slopes).max())


def test_a_wrong_name_is_told_and_a_sweep_takes_the_right_one(folder):
    refused(run("modes", folder / "case.toml", "--set", "model.fin_added_mass=disk"), "plate")
    text = (folder / "case.toml").read_text(encoding="utf-8")
    (folder / "wet").mkdir()
    for name in ("stations.csv", "study.toml"):
        (folder / "wet" / name).write_bytes((folder / name).read_bytes())
    changed = text.replace("[model]", '[model]\nfin_added_mass = "plate"')
    (folder / "wet" / "case.toml").write_text(changed, encoding="utf-8")
    assert "bending 1" in run("sweep", folder / "wet" / "study.toml").out
