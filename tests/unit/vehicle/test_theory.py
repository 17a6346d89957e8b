"""Vehicles with shear and rotary inertia: kGA and rho I from the stations, alone and in studies."""

import pickle
import re

import numpy as np
import pytest

import antinode as an
from antinode.beam import representation
from antinode.study.cases.beams import beams_of
from antinode.study.cases.bending import chain_of
from antinode.study.cases.chunks import solve_values
from antinode.study.cases.reasons import NO_BEAM, failed
from antinode.study.cases.values import Cases
from antinode.study.design.points import points_of
from antinode.vehicle import many_beams
from cli_run import run


@pytest.fixture
def starter(tmp_path):
    run("init", tmp_path)
    return tmp_path / "case.toml"


def load(path, *sets, theory="timoshenko"):
    return an.load_case(path, [f"model.theory={theory}", *sets])


def test_kGA_is_that_of_a_thin_tube_and_rho_I_that_of_the_hull(starter):
    beam = load(starter).beam()
    assert beam.shear_stiffness == pytest.approx(beam.axial_stiffness / 4.9, rel=1e-15)
    section = load(starter).vehicle.section(beam.x)
    if section.radius_of_gyration is not None:
        r2 = section.radius_of_gyration**2
    elif section.wall is not None:
        r2 = (section.radius**2 + (section.radius - section.wall) ** 2) / 4
    else:
        r2 = section.bending_stiffness / section.axial_stiffness
    m = beam.mass_per_length
    assert beam.rotary_inertia_per_length == pytest.approx(m * r2, rel=1e-14)
    assert beam.is_timoshenko
    assert beam.shear_form == "haringx"
    assert not load(starter, theory="euler_bernoulli").beam().is_timoshenko


def test_it_lowers_the_frequencies_by_about_the_estimate(starter):
    plain = an.solve_modes(load(starter, theory="euler_bernoulli"), 6, families=("bending",))
    sheared = an.solve_modes(load(starter), 6, families=("bending",))
    f, g = (r.frequencies_hz()[-6:] for r in (plain, sheared))
    change = g / f - 1
    assert np.all(np.diff(change) < 0)
    assert change[5] == pytest.approx(-0.1103, abs=2e-4)


def test_own_columns_take_their_place(starter):
    table = starter.parent / "stations.csv"
    lines, seen = [], False
    for row in table.read_text().splitlines():
        more = ", shear_stiffness [MN], rotary_inertia_per_length [kg m]" if not seen else ", 40, 3"
        closing = seen and not row.split(",")[-1].strip()
        counts = row and not row.startswith("#")
        seen = seen or bool(counts)
        lines.append(row + (", ," if closing else more) if counts else row)
    table.write_text("\n".join(lines) + "\n")
    beam = load(starter).beam()
    assert np.all(beam.shear_stiffness == 40e6)
    assert np.all(beam.rotary_inertia_per_length == 3.0)


STUDY = """
case = "case.toml"
inputs = [
  { key = "condition.speed", low = "60 m/s", high = "130 m/s" },
  { key = "condition.thrust", low = "0 kN", high = "150 kN" },
  { key = "mass_per_length", control_points = 2, distribution = "lognormal", sd = 0.1 },
  { key = "axial_stiffness", control_points = 2, distribution = "lognormal", sd = 1.5 },
]
design = { kind = "sobol", number = 16 }
[solve]
modes = 3
"""
VARIANTS = [
    ("step", "haringx", "follows_body", "exact"),
    ("step", "engesser", "fixed_direction", "exact"),
    ("step", "haringx", "follows_body", "element_midpoint"),
    ("linear", "haringx", "fixed_direction", "exact"),
    ("log", "engesser", "follows_body", "exact"),
]


def study_of(starter, interpolation, shear_form, end_force, axial_force):
    """A study of the starter with these choices; its shear goes with EA."""
    text = re.sub(
        r"\ninterpolation = .*", f'\ninterpolation = "{interpolation}"', starter.read_text()
    )
    text = re.sub(r"\n(end_force|theory) = .*", "", text)
    choices = {"theory": "timoshenko", "shear_form": shear_form, "axial_force": axial_force}
    lines = [f'{key} = "{word}"' for key, word in (choices | {"end_force": end_force}).items()]
    starter.write_text(text.replace("\n[model] ", "\n[model]\n" + "\n".join(lines) + "\n#"))
    path = starter.parent / "study.toml"
    path.write_text(STUDY)
    return an.load_study(path)


@pytest.mark.parametrize("variant", VARIANTS, ids="-".join)
def test_a_sweep_solves_what_a_single_case_solves(starter, variant):
    study = study_of(starter, *variant)
    points = points_of(study)
    values = points.values(0)
    found = solve_values(points, values)
    cases = Cases(study, points.variables, values)
    assert not np.any(failed(found["reason"]))
    for k in range(len(values)):
        single = an.solve_modes(cases.case(k), 3, families=("bending",), tolerance=1e-10)
        modes = [m for m in single.modes if m.number]
        hz = np.array([m.frequency_hz for m in modes])
        off = np.abs(found["frequency_hz"][k] - hz)
        assert np.all(off <= found["error_hz"][k])
        assert np.all(found["error_hz"][k] <= 2e-6 * hz)
        effect = np.array([m.effect_of_shear for m in modes])
        assert found["effect_of_shear"][k] == pytest.approx(effect, rel=1e-3)
    assert "model_error" not in found


def test_chains_of_a_sweep_are_those_of_single_cases(starter, monkeypatch):
    """Averages of s, sN and sN^2 over halves of steps, not products of averages."""
    monkeypatch.setattr(many_beams, "_LONGEST", representation._LONGEST)  # cut at the same places
    study = study_of(starter, "step", "haringx", "follows_body", "exact")
    points = points_of(study)
    values = points.values(0)[:4]
    cases = Cases(study, points.variables, values)
    for chains in beams_of(cases).chains(np.arange(4), 2):
        for k, row in enumerate(chains.rows.tolist()):
            single = cases.case(row).beam().chain("bending", 2)
            swept = chain_of(chains, k)
            assert swept.columns.keys() == single.columns.keys()
            for name, column in single.columns.items():
                assert swept.columns[name] == pytest.approx(column, rel=1e-14), name
    s, N, work = (swept.columns[name] for name in ("shear", "axial_force", "shear_work"))
    assert np.max(np.abs(s * N**2 / work - 1)) > 1e-6


def test_an_axial_force_beyond_the_shear_stiffness_has_no_beam(starter):
    study = study_of(starter, "step", "engesser", "follows_body", "exact")
    points = points_of(study)
    values = points.values(0)[:4]
    values[1:3, -2:] = 1e-6  # of EA: kGA below N
    found = solve_values(points, values)
    assert found["reason"].tolist() == [0, NO_BEAM, NO_BEAM, 0]
    cases = Cases(study, points.variables, values)
    with pytest.raises(an.InputError, match="N < kGA in Engesser's form"):
        cases.case(1).beam()


def test_a_case_that_was_solved_can_be_sent_to_another_process(starter):
    case = load(starter)
    mass = case.loads.mass
    again = pickle.loads(pickle.dumps(case))
    assert again == case
    assert again.loads.mass == mass
