"""A vehicle and a condition that tests change as they need."""

from antinode.vehicle.condition import OperatingCondition
from antinode.vehicle.vehicle import Vehicle


def vehicle(fins=({},), interpolation="step", **changes):
    columns = {
        "x": [0, 0.4, 1, 2, 3, 4.5, 6],
        "mass_per_length": [200, 300, 500, 400, 350, 300, 300],
        "bending_stiffness": [4e5] * 7,
        "axial_stiffness": [4e8] * 7,
        "radius": [0.04, 0.1, 0.17, 0.19, 0.19, 0.19, 0.19],
    }
    fin = {"roll_angles": ["45 deg", "135 deg"], "tip_radius": 0.35, "thickness": "15 mm"}
    return Vehicle(
        stations=columns | changes,
        cavitator={"diameter": 0.08},
        interpolation=interpolation,
        fins=[fin | changed for changed in fins],
    )


def condition(**changes):
    values = {
        "speed": 80,
        "cavitation_number": 0.02,
        "cavitator_angle": "10 deg",
        "fin_position": 5,
        "thrust": 5e4,
    }
    return OperatingCondition(**(values | changes))
