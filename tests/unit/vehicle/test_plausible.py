"""Numbers that hardly any vehicle has are doubted, case by case, with what was likely missed."""

import math
import re

import numpy as np
import pytest

import antinode as an
from antinode.errors import InputError
from antinode.vehicle.case import Case
from antinode.vehicle.loads import compute_loads
from antinode.vehicle.many_loads import loads_of_many
from vehicles import condition, vehicle

STATIONS = {
    "mass_per_length": [200, 300, 500, 400, 350, 300, 300],
    "bending_stiffness": [4e5] * 7,
    "axial_stiffness": [4e8] * 7,
}
QUIET = {"cavitation_number": 0.015}


def told(body, **values):
    return compute_loads(body, condition(**(QUIET | values))).warnings


def times(name, factor):
    return {name: [factor * value for value in STATIONS[name]]}


def test_a_usual_vehicle_is_not_doubted():
    assert told(vehicle()) == ()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (times("mass_per_length", 1e-3), ("mean density", "not the kg of each piece")),
        (times("mass_per_length", 1e3), ("mean density", "mass_per_length")),
        (times("bending_stiffness", 1e6), ("radius of gyration", "not N mm^2")),
        (times("axial_stiffness", 1e-3), ("radius of gyration", "axial_stiffness [N]")),
        ({"fins": [{"tip_radius": 15.0}]}, ("reach 15 m out", "tip_radius")),
        ({"fins": [{}, {"tip_radius": 350.0, "position": 4.0}]}, ("set 2", "350 m")),
    ],
)
def test_missed_units_of_the_vehicle(changes, words):
    text = " ".join(told(vehicle(**changes)))
    for word in words:
        assert word in text


def test_a_body_faster_than_sound_in_water():
    assert "2500 m/s, faster than sound" in " ".join(told(vehicle(), speed=2500))
    assert "faster than sound" not in " ".join(told(vehicle(), speed=1400))


def test_the_mean_density_is_that_of_cones():
    """A cone of 90 kg/m^3: linear radius, mass as its area."""
    x = np.linspace(0, 3, 601)
    radius = 0.05 + 0.05 * x
    columns = {"x": x, "mass_per_length": 90 * math.pi * radius**2, "radius": radius}
    others = {"bending_stiffness": np.full(601, 1e4), "axial_stiffness": np.full(601, 1e8)}
    body = vehicle(fins=(), interpolation="linear", **columns, **others)
    text = " ".join(told(body, fin_position=2.0))
    assert "density of the body is 90 kg/m^3" in text


def test_doubts_of_many_cases_are_those_of_each():
    case = Case(vehicle=vehicle(), condition=condition(**QUIET))
    tips = np.array([0.35, 2.9, 3.1, 15.0])
    speeds = np.array([80.0, 80.0, 1600.0, 80.0])
    numbers = {("vehicle", "fins", 0, "tip_radius"): tips, ("condition", "speed"): speeds}
    warnings = {w.quantity: w for w in loads_of_many(case.many(numbers, 4)).warnings}
    assert warnings["tip_radius of the fins [m]"].concerns.tolist() == [False, False, True, True]
    assert warnings["speed [m/s]"].concerns.tolist() == [False, False, True, False]
    assert not warnings["mean density of the body [kg/m^3]"].concerns.any()


@pytest.mark.parametrize("speed", [3e4, 8e4, 1e6])
def test_a_speed_of_another_world_ends_in_a_sentence(speed):
    """In Python too, where no file was checked: a solution would take for ever."""
    case = Case(vehicle=vehicle(), condition=condition(speed=speed))
    for ask in (case.beam, lambda: an.solve_modes(case, 2), lambda: an.natural_frequencies(case)):
        with pytest.raises(InputError, match=re.escape(f"at {speed:g} m/s") + ".*diverge"):
            ask()


def test_a_thrust_of_another_world_ends_in_a_sentence():
    case = Case(vehicle=vehicle(), condition=condition(thrust=5e9))
    with pytest.raises(InputError, match="modes diverge"):
        an.solve_modes(case, 2)


def test_a_last_row_that_is_not_used():
    """A stepped table holds each row up to the next one; the repeated row loses nothing."""
    columns = {"bending_stiffness": [4e5] * 6 + [1e5]}
    (text,) = told(vehicle(**columns))
    assert "bending_stiffness stays that of the row before up to the end" in text
    assert told(vehicle(**columns, interpolation="linear")) == ()
