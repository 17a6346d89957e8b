"""The vehicle's tables: what they refuse, and what they mean between the stations."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from antinode.beam.mass import MassDistribution
from antinode.errors import InputError
from antinode.vehicle.condition import OperatingCondition, Water
from antinode.vehicle.hydrodynamics.cavitation_number import resolve_cavitation
from antinode.vehicle.options import Model
from antinode.vehicle.vehicle import FinSet, Stations, Vehicle


def table(**changes):
    columns = {
        "x": [0, 1, 3],
        "mass_per_length": [100, 200, 400],
        "mass_per_length:burnt": [50, 300, 100],
        "bending_stiffness": [1e5, 4e5, 4e5],
        "axial_stiffness": [1e8, 2e8, 2e8],
        "radius": [0.05, 0.2, 0.2],
    }
    return {**columns, **changes}


def vehicle(interpolation="step", **changes):
    return Vehicle(
        stations=table(**changes), cavitator={"diameter": "80 mm"}, interpolation=interpolation
    )


class TestStationsRefuse:
    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"x": [0, 2, 1]}, ["x: rows 2 and 3", "received 2, then 1 m", "sort the rows"]),
            ({"x": [0, 1, 1]}, ["x: rows 2 and 3", "received 1, then 1 m", "duplicate"]),
            ({"x": [0, math.nan, 2]}, ["x, row 2", "nan", "finite"]),
            ({"x": [0]}, ["x: received 1 row;", "at least two"]),
            ({"x": []}, ["x: received 0 rows", "at least two"]),
            ({"mass_per_length": [1, 0, 1]}, ["mass_per_length, row 2", "received 0", "kg/m"]),
            ({"mass_per_length:burnt": [1, 1, -2]}, ["mass_per_length:burnt, row 3", "-2"]),
            ({"bending_stiffness": [1, -3, 1]}, ["bending_stiffness, row 2", "-3", "N m^2"]),
            ({"axial_stiffness": [0, 1, 1]}, ["axial_stiffness, row 1", "greater than 0 N"]),
            ({"radius": [0.1, math.inf, 1]}, ["radius, row 2", "inf", "finite"]),
            ({"radius": [0.1, 0.1, 0]}, ["radius, row 3", "received 0"]),
            ({"radius": [0.0, 0.1, 0.1]}, ["radius, row 1", "step", "linear"]),
            ({"wall": [0.01, 0, 0.01]}, ["wall, row 2", "received 0"]),
            ({"radius": [0.1, 0.1]}, ["radius: received 2 rows", "x has 3"]),
            ({"radius": 0.1}, ["needs a list of numbers"]),
            ({"radius": [0.1, "1 kg", 0.1]}, ["row 2", "'1 kg'", "no unit of m"]),
            ({"radius": [0.1, None, 0.1]}, ["row 2", "needs a number"]),
            ({"x": [1, 2, 3]}, ["x, row 1", "received 1 m", "nose is at 0"]),
            ({"mass_per_length:initial": [1, 1, 1]}, ["same mass state"]),
            ({"colour": [1, 1, 1]}, ["colour"]),
        ],
    )
    def test_wrong_column(self, changes, words):
        with pytest.raises(InputError) as caught:
            vehicle(**changes)
        for word in words:
            assert word in str(caught.value)

    def test_missing_column(self):
        columns = table()
        del columns["radius"]
        with pytest.raises(InputError, match="radius"):
            Stations(**columns)
        with pytest.raises(InputError, match="mass_per_length"):
            Stations(**{key: value for key, value in table().items() if "mass" not in key})

    def test_a_pointed_nose_only_where_the_radius_is_interpolated(self):
        assert vehicle("linear", radius=[0, 0.2, 0.2]).radius_at(0.5) == 0.1

    def test_units_arrays_and_equality(self):
        a = Stations(**table(x=["0 m", "100 cm", 3.0]))
        assert a == Stations(**table(x=np.array([0, 1, 3])))
        assert a != Stations(**table(x=[0, 1, 4]))
        with pytest.raises(ValueError, match="read-only"):
            a.x[0] = 1

    def test_schema_and_dump(self):
        assert "stations" in Vehicle.model_json_schema()["properties"]
        assert vehicle().model_dump()["stations"]["x"] == [0.0, 1.0, 3.0]


class TestBetweenStations:
    def test_step(self):
        section = vehicle().section([0, 0.5, 1, 3])
        assert section.mass_per_length.tolist() == [[100, 100], [100, 100], [200, 200]]
        assert section.radius[:, 0].tolist() == [0.05, 0.05, 0.2]
        assert vehicle().radius_at([0.999, 1, 3]).tolist() == [0.05, 0.2, 0.2]

    def test_linear(self):
        section = vehicle("linear").section([0, 0.5, 1, 3])
        assert section.mass_per_length.tolist() == [[100, 150], [150, 200], [200, 400]]

    def test_log(self):
        section = vehicle("log").section([0, 0.5, 1, 3])
        # half way between 1e5 and 4e5 on a log scale: 2e5; the radius stays linear
        np.testing.assert_allclose(section.bending_stiffness[0], [1e5, 2e5], rtol=1e-14)
        np.testing.assert_allclose(section.radius[0], [0.05, 0.125], rtol=1e-14)

    def test_optional_columns(self):
        assert vehicle().section([0, 1, 3]).wall is None
        section = vehicle(wall=[0.01, 0.02, 0.02]).section([0, 1, 3])
        assert section.wall.tolist() == [[0.01, 0.01], [0.02, 0.02]]

    def test_mass_states(self):
        # half burnt: (100+50)/2, (200+300)/2, (400+100)/2
        assert vehicle().mass_per_length(0.5).tolist() == [75, 250, 250]
        assert vehicle().mass_per_length(1).tolist() == [50, 300, 100]

    def test_three_mass_states_are_piecewise_linear(self):
        body = vehicle(**{"mass_per_length:empty": [10, 100, 50]})
        assert body.mass_per_length(0.5).tolist() == [50, 300, 100]
        # three quarters of the way: half way between burnt and empty
        assert body.mass_per_length(0.75).tolist() == [30, 200, 75]

    @pytest.mark.parametrize("interpolation", ["step", "linear", "log"])
    def test_moments_against_quadrature(self, interpolation):
        x, m = np.array([0.0, 1.0, 3.0]), np.array([100.0, 200.0, 50.0])
        ends = np.stack([m[:-1], m[:-1] if interpolation == "step" else m[1:]], axis=1)
        mass = MassDistribution(x, ends, interpolation)

        def value(s):
            if interpolation == "step":
                return 100.0 if s < 1 else 200.0
            if interpolation == "linear":
                return float(np.interp(s, x, m))
            return math.exp(np.interp(s, x, np.log(m)))

        for end in (0.4, 1.0, 2.3, 3.0):
            for p in range(3):
                inner = [1.0] if end > 1 else None
                expected = quad(lambda s, p=p: value(s) * s**p, 0, end, points=inner)[0]
                assert mass.moments(end)[p] == pytest.approx(expected, rel=1e-12)


class TestAngles:
    @pytest.mark.parametrize(
        ("angle", "words"),
        [
            (10, ["received 10", "-1.047 and 1.047 rad (60 deg", "'10 deg'?"]),
            ("70 deg", ["received 70 deg", "60 deg"]),
        ],
    )
    def test_degrees_typed_as_radians(self, angle, words):
        with pytest.raises(InputError) as caught:
            OperatingCondition(speed=80, cavitation_number=0.02, cavitator_angle=angle)
        for word in words:
            assert word in str(caught.value)
        assert ("deg'?" in str(caught.value)) == (angle == 10)

    def test_limits_are_inside(self):
        for angle in ("60 deg", "-60 deg"):
            OperatingCondition(speed=80, cavitation_number=0.02, cavitator_angle=angle)
        with pytest.raises(InputError, match="'20 deg'"):
            OperatingCondition(speed=80, cavitation_number=0.02, body_angle=20)
        with pytest.raises(InputError, match="'45 deg'"):
            FinSet(roll_angles=[45], tip_radius=0.3, thickness=0.01)


class TestCavitationNumber:
    water = Water(density=1000, gravity=10, atmospheric_pressure=1e5, vapour_pressure=2e3)

    def resolve(self, **values):
        return resolve_cavitation(OperatingCondition(**values), self.water)

    def test_equation_1(self):
        # p = 1e5 + 1000*10*5 = 1.5e5; q = 1000*20^2/2 = 2e5; (1.5e5 - 2e3)/2e5 = 0.74
        assert self.resolve(speed=20, depth=5).sigma == pytest.approx(0.74, rel=1e-14)
        # with 1.1e5 Pa in the cavity: 4e4/2e5
        state = self.resolve(speed=20, depth=5, cavity_pressure=1.1e5)
        assert state.sigma == pytest.approx(0.2, rel=1e-14)

    def test_sigma_alone_implies_nothing(self):
        assert self.resolve(speed=160, cavitation_number=0.02) == (0.02, None, None)

    def test_sigma_and_depth_imply_the_cavity_pressure(self):
        # 1.5e5 - 0.2*2e5 = 1.1e5
        state = self.resolve(speed=20, depth=5, cavitation_number=0.2)
        assert state.cavity_pressure == pytest.approx(1.1e5)
        assert self.resolve(speed=20, depth=5, cavitation_number=0.2, cavity_pressure=1.1e5)

    def test_sigma_and_cavity_pressure_imply_the_depth(self):
        # 1.1e5 + 0.2*2e5 = 1.5e5, which is 5 m deep
        state = self.resolve(speed=20, cavitation_number=0.2, cavity_pressure=1.1e5)
        assert state.depth == pytest.approx(5)

    @pytest.mark.parametrize(
        ("values", "words"),
        [
            # 1.5e5 - 0.9*2e5 = -3e4
            ({"depth": 5, "cavitation_number": 0.9}, ["-30000 Pa", "at least 0"]),
            (
                {"depth": 5, "cavitation_number": 0.2, "cavity_pressure": 1e5},
                ["110000 Pa", "cavity_pressure = 100000 Pa", "leave out"],
            ),
            # 1e4 + 0.2*2e5 = 5e4 < 1e5
            ({"cavitation_number": 0.2, "cavity_pressure": 1e4}, ["50000 Pa", "below"]),
            # (3.5e5 - 2e3)/2e5 = 1.74
            ({"depth": 25}, ["1.74", "between 0 and 1"]),
            ({"depth": 5, "cavity_pressure": 2e5}, ["-0.25", "between 0 and 1"]),
        ],
    )
    def test_contradictions(self, values, words):
        with pytest.raises(InputError) as caught:
            self.resolve(speed=20, **values)
        for word in words:
            assert word in str(caught.value)

    @pytest.mark.parametrize(
        "values",
        [
            {"cavitation_number": 0},
            {"cavitation_number": 1},
            {"cavitation_number": -0.1},
            {"depth": -1},
            {},
            {"cavitation_number": 0.1, "thrust": -1},
            {"cavitation_number": 0.1, "burn_fraction": 1.1},
            {"cavitation_number": 0.1, "speed": 0},
            {"cavitation_number": math.nan},
            {"cavitation_number": 0.1, "sped": 3},
        ],
    )
    def test_refused(self, values):
        with pytest.raises(InputError):
            OperatingCondition(**({"speed": 20} | values))

    def test_defaults_are_fresh_water_at_20_C(self):
        water = Water()
        assert (water.density, water.dynamic_viscosity) == (998.2, 1.002e-3)
        assert (water.vapour_pressure, water.gravity) == (2339, 9.80665)


def test_every_model_option_is_described():
    for name, field in Model.model_fields.items():
        assert field.description, name
