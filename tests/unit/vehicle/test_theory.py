"""Vehicles with shear and rotary inertia: kGA and rho I from the stations, alone and in studies."""

import numpy as np
import pytest

import antinode as an
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
[[inputs]]
key = "condition.speed"
values = ["80 m/s", "100 m/s"]
[solve]
modes = 3
"""


@pytest.mark.parametrize("shear_form", ["haringx", "engesser"])
def test_a_sweep_solves_what_a_single_case_solves(starter, shear_form):
    text = starter.read_text()
    choices = f'[model]\ntheory = "timoshenko"\nshear_form = "{shear_form}" #'
    assert text.count("\n[model] ") == 1
    starter.write_text(text.replace("\n[model] ", f"\n{choices}"))
    (starter.parent / "study.toml").write_text(STUDY)
    found = an.sweep(an.load_study(starter.parent / "study.toml"))
    for k, speed in enumerate((80, 100)):
        case = an.load_case(starter, [f"condition.speed={speed}"])
        single = an.natural_frequencies(case, 3).frequencies_hz
        swept = np.asarray(found["frequency_hz"]).reshape(2, -1)[k, :3]
        assert swept == pytest.approx(single, rel=1e-5)
