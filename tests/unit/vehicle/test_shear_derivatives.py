"""Derivatives through shear and rotary inertia, of columns and the hull, against differences."""

import re

import numpy as np
import pytest

import antinode as an
from antinode.study.eigenvalues import eigenvalues_of
from antinode.vehicle.effects import by_rows, effect_of_mass, effect_of_number, effect_of_radius
from antinode.vehicle.numbers import replaced
from antinode.vehicle.paths import find_place
from cli_run import run

COLUMNS = ("mass_per_length", "bending_stiffness", "axial_stiffness")
ROW = 3
WANTED = {"bending": 4}


@pytest.fixture(params=["step haringx hull", "linear engesser hull", "log haringx bare"])
def case(request, tmp_path):
    """A starter soft in shear, whose r is that of the hull, or sqrt(EI/EA)."""
    interpolation, shear_form, hull = request.param.split()
    run("init", tmp_path)
    path = tmp_path / "case.toml"
    text = re.sub(r"\ninterpolation = .*", f'\ninterpolation = "{interpolation}"', path.read_text())
    text = re.sub(r"\ntheory = .*", "", text)
    choices = f'theory = "timoshenko"\nshear_form = "{shear_form}"'
    path.write_text(text.replace("\n[model] ", f"\n[model]\n{choices}\n#"))
    found = an.load_case(path)
    stations = found.vehicle.stations
    found = replaced(
        found, ("vehicle", "stations", "axial_stiffness"), stations.axial_stiffness / 9
    )
    wall = 0.1 * stations.radius if hull == "hull" else None
    return replaced(found, ("vehicle", "stations", "wall"), wall)


def omega2(case):
    return eigenvalues_of([case], [WANTED], 4)[0].modes["bending"].omega2


def differences(case, keys, value, step):
    low, high = (replaced(case, keys, value + sign * step) for sign in (-1, 1))
    return (omega2(high) - omega2(low)) / 2


def exact_of(case):
    return eigenvalues_of([case], [WANTED], 4)[0].sensitivity("bending")


@pytest.mark.parametrize("column", COLUMNS)
def test_by_a_row_of_a_column(case, column):
    state = ("initial",) if column == "mass_per_length" else ()
    keys = ("vehicle", "stations", column, *state)
    values = getattr(case.vehicle.stations, column)
    values = values["initial"] if state else values
    step = np.zeros_like(values)
    step[ROW] = 1e-4 * values[ROW]
    wanted = differences(case, keys, values, step)
    slope = by_rows(case, ":".join(keys[2:]), exact_of(case))[ROW] * step[ROW]
    assert slope == pytest.approx(wanted, rel=3e-4, abs=1e-7 * np.max(np.abs(wanted)))


@pytest.mark.parametrize("column", ["shear_stiffness", "rotary_inertia_per_length"])
def test_by_a_column_of_its_own(case, column):
    stations = case.vehicle.stations
    own = {"shear_stiffness": stations.axial_stiffness / 5}.get(column, 3 + stations.x / 9)
    keys = ("vehicle", "stations", column)
    case = replaced(case, keys, own)
    step = np.zeros_like(own)
    step[ROW] = 1e-4 * own[ROW]
    slope = by_rows(case, column, exact_of(case))[ROW] * step[ROW]
    assert slope == pytest.approx(differences(case, keys, own, step), rel=3e-4)
    if column == "shear_stiffness":
        assert np.all(by_rows(case, "axial_stiffness", exact_of(case))[ROW] == 0) or (
            stations.wall is None  # then EA is in r = sqrt(EI/EA)
        )


def test_by_the_hull(case):
    if case.vehicle.stations.wall is None:
        bare = case.vehicle.stations.radius
        case = replaced(case, ("vehicle", "stations", "wall"), 0.2 * bare)
    place = find_place(case, f"vehicle.stations.wall[{ROW}]")
    wall = case.vehicle.stations.wall
    step = np.zeros_like(wall)
    step[ROW] = 1e-3 * wall[ROW]
    slope = effect_of_number(case, place).slope(exact_of(case)) * step[ROW]
    assert slope == pytest.approx(differences(case, place.keys[:-1], wall, step), rel=1e-3)
    radius = case.vehicle.stations.radius
    slope = effect_of_radius(case, np.ones_like(radius)).slope(exact_of(case)) * 1e-5
    keys = ("vehicle", "stations", "radius")
    assert slope == pytest.approx(differences(case, keys, radius, 1e-5 * radius), rel=2e-3)


def test_by_the_mass_of_the_whole_body(case):
    keys = ("vehicle", "stations", "mass_per_length", "initial")
    mass = case.vehicle.stations.mass_per_length["initial"]
    slope = effect_of_mass(case).slope(exact_of(case)) * 1e-4
    assert slope == pytest.approx(differences(case, keys, mass, 1e-4 * mass), rel=3e-4)
