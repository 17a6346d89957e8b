"""Beams from what people have: stations, numbers, texts with units, pandas and xarray."""

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

from antinode import Beam, Dashpot, Ends, InputError, Joint, PointMass, Spring, natural_frequencies

M, EI = [10.0, 9.0, 8.0], [3e6, 2.5e6, 2e6]
X = [0.0, 4.0, 10.0]
LINEAR = Beam.from_stations(X, M, EI, interpolation="linear")
KILO = ["3 MN m^2", "2500 kN m^2", 2e6]
UREG = pint.UnitRegistry()
FRAME = pd.DataFrame({"x": X, "mass_per_length": M, "bending_stiffness": EI})
IN_KN = pd.Series([3e3, 2.5e3, 2e3])
IN_KN.attrs["units"] = "kN m^2"
IN_MM = FRAME.assign(x=1000 * FRAME.x)
IN_MM.attrs["units"] = {"x": "mm"}


@pytest.mark.parametrize(
    "columns",
    [
        {"x": X, "mass_per_length": M, "bending_stiffness": EI},
        {"x": ["0", "400 cm", "10 m"], "mass_per_length": M, "bending_stiffness": KILO},
        {"x": [[0.0], [4.0], [10.0]], "mass_per_length": np.c_[M], "bending_stiffness": EI},
        {"x": X, "mass_per_length": [[10, 9], [9, 8]], "bending_stiffness": EI},
        dict(FRAME),
        FRAME,
        IN_MM,
        FRAME.astype({"x": "object"}),
        {**FRAME, "bending_stiffness": IN_KN},
        {**FRAME, "x": xr.DataArray([0.0, 4e3, 1e4], dims="x", attrs={"units": "mm"})},
        {**FRAME, "mass_per_length": np.array(M) / 1000 * UREG.tonne / UREG.m},
        {**FRAME, "bending_stiffness": np.array(["3e6", "2.5 MN m^2", "2e6"])},
    ],
)
def test_the_same_beam_however_its_columns_are_given(columns):
    beam = Beam(**columns, interpolation="linear")
    np.testing.assert_allclose(beam.x, LINEAR.x, rtol=1e-15)
    for name in ("mass_per_length", "bending_stiffness", "axial_force"):
        np.testing.assert_allclose(getattr(beam, name), getattr(LINEAR, name), rtol=1e-15)


def test_one_number_holds_for_the_whole_beam():
    beam = Beam(x=[0, 10], mass_per_length=10, bending_stiffness="1 MN m^2", axial_force="-2 kN")
    assert beam == Beam([0, 10], [[10, 10]], [[1e6, 1e6]], axial_force=[[-2e3, -2e3]])
    beta = 4.730040744862704
    (f,) = natural_frequencies(Beam([0, 10], [10, 10], [1e6, 1e6]), 1).frequencies_hz
    np.testing.assert_allclose(f, beta**2 / (2 * np.pi) * np.sqrt(1e6 / (10 * 10**4)), rtol=1e-10)


def test_steps_take_a_value_for_each_interval_or_a_last_row_that_closes_the_table():
    by_interval = Beam(X, [10, 9], [3e6, 2e6])
    assert by_interval == Beam(X, [10, 9, 9], [3e6, 2e6, 2e6])
    np.testing.assert_array_equal(by_interval.mass_per_length, [[10, 10], [9, 9]])


def test_a_last_row_that_would_be_lost_is_refused():
    with pytest.raises(InputError, match=r"mass_per_length is 9, then 8 .* interpolation='linear'"):
        Beam(X, M, 1.0)
    assert Beam.from_stations(X, M, 1.0) == Beam(X, M[:2], 1.0)  # there the rule is the caller's


def test_two_rows_at_one_place_are_a_jump():
    beam = Beam([0, 4, 4, 10], [10, 9, 5, 4], 1e6, interpolation="linear")
    np.testing.assert_array_equal(beam.x, [0, 4, 10])
    np.testing.assert_array_equal(beam.mass_per_length, [[10, 9], [5, 4]])
    with pytest.raises(InputError, match="x must increase"):  # a table says itself where it jumps
        Beam([0, 4, 4, 10], [10, 9, 5, 4], np.ones((3, 2)), interpolation="linear")


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ({"mass_per_length": [1, 2]}, r"\(2,\), but x has 3 stations"),
        ({"mass_per_length": "10 kg"}, "'kg' is no unit of kg/m"),
        ({"mass_per_length": ["10 kg/m", "heavy", 9]}, "row 2 is 'heavy'"),
        ({"mass_per_length": [10, None, 9]}, "an array of real numbers"),
        ({"mass_per_length": 10 * UREG.kg}, "mass_per_length is .*Cannot convert"),
        ({"mass_per_length": xr.DataArray(M, attrs={"units": "kg"})}, "no unit of kg/m"),
        ({"mass_per_length": np.ma.masked_equal(M, 9)}, "row 2 is masked"),
        ({"mass_per_length": pd.Series([10, np.nan, 9])}, "interval 1 has nan"),
        ({"mass_per_length": np.ones((3, 2))}, r"2 intervals need shape \(2, 2\)"),
        ({"loss_factor": "1 kg"}, "pure number"),
    ],
)
def test_what_is_no_column_is_refused_in_one_sentence(columns, words):
    with pytest.raises(InputError, match=words) as told:
        Beam(**{**FRAME, **columns}, interpolation="linear")
    assert "\n" not in str(told.value)


def test_attachments_take_texts_with_units():
    assert PointMass("90 cm", "20 kg", offset="-10 cm") == PointMass(0.9, 20.0, offset=-0.1)
    assert Spring("1 m", "2 kN/m", "inf", coupling="3 kN") == Spring(1.0, 2e3, np.inf, coupling=3e3)
    assert Joint(1, "1e-6 rad/(N m)", "1 mm/kN") == Joint(1.0, 1e-6, 1e-6)
    assert Dashpot(2 * UREG.m, "3 N s/m") == Dashpot(2.0, 3.0)
    with pytest.raises(InputError, match=r"mass of a point mass is '20 m'.*no unit of kg"):
        PointMass(0, "20 m")
    beam = Beam(X, 1, 1, ends=Ends("clamped")).with_attachments(PointMass("5 m", "2 kg"))
    assert beam.mass == pytest.approx(12.0, rel=1e-15)
