"""Numbers with units: what is converted, what is refused, and that nothing takes for ever."""

import math
from functools import cached_property

import pint
import pytest
from pydantic import ConfigDict, Field, ValidationError

from antinode.errors import InputError
from antinode.inputs.known_units import FACTORS
from antinode.inputs.units import Angle, Force, Frozen, Length, Number, to_si, unit_factor


class Sample(Frozen):
    length: Length = Field(1.0, gt=0)
    angle: Angle = 0.0
    force: Force = 0.0
    ratio: Number = 0.0


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("80 mm", "m", 0.08),
        ("80mm", "m", 0.08),
        (" 80  mm ", "m", 0.08),
        ("0.08", "m", 0.08),
        (0.08, "m", 0.08),
        (3, "m", 3.0),
        ("10 deg", "rad", math.radians(10)),
        ("50 kN", "N", 5e4),
        ("630 rpm", "Hz", 10.5),
        ("66 rad/s", "Hz", 66 / (2 * math.pi)),
        ("360 deg/s", "Hz", 1.0),
        ("120 1/min", "Hz", 2.0),
        ("9.5 GN", "N", 9.5e9),
        ("1.5 kN m^2", "N m^2", 1500.0),
        ("1.5 kN·m²", "N m^2", 1500.0),
        ("1.5 kN*m**2", "N m^2", 1500.0),
        ("1 t/m", "kg/m", 1000.0),
        ("-9.80665 m/s^2", "m/s^2", -9.80665),
        ("-9.80665 m s⁻²", "m/s^2", -9.80665),
        ("1e-7 rad/(N m)", "rad/(N m)", 1e-7),
        ("2.3e7 kg m^2", "kg m^2", 2.3e7),
        ("1 mPa s", "Pa s", 1e-3),
        ("1 bar", "Pa", 1e5),
        ("36 km/h", "m/s", 10.0),
        ("2 %", "", 0.02),
        ("inf", "N/m", math.inf),
        ("-inf m", "m", -math.inf),
    ],
)
def test_converts(text, unit, value):
    assert to_si(text, unit) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("written", "unit"), [(w, u) for u, known in FACTORS.items() for w in known]
)
def test_what_is_known_without_pint_is_what_pint_says(written, unit):
    registry = pint.get_application_registry()
    quantity = registry.Quantity(1.0, registry.parse_units(written))
    asked = quantity.to(unit or "dimensionless").magnitude
    assert unit_factor(written, unit) == pytest.approx(asked, rel=3e-16)


@pytest.mark.parametrize(
    ("value", "unit", "words"),
    [
        ("80 kg", "m", "'kg' is no unit of m"),
        ("80 mm 3", "m", "'mm 3' is no unit of m"),
        ("80 foo", "m", "'foo' is no unit of m"),
        ("0.02 m", "", "without a unit"),
        ("mm", "m", "needs a number, or a text with a unit such as '1 m'"),
        ("", "m", "needs a number"),
        (" ", "m", "needs a number"),
        ("fast", "m/s", "needs a number"),
        ("fast", "", "needs a number"),
        (True, "m", "needs a number"),
        (None, "m", "needs a number"),
        ([1.0], "m", "needs a number"),
        ({"a": 1}, "m", "needs a number"),
        (1j, "m", "needs a number"),
        (b"1 m", "m", "needs a number"),
        (10**400, "m", "below 1e308"),
        ("1 " + 100 * "m", "m", "at most 80"),
        ("20 degC", "K", "no unit of K"),  # an offset, not a factor
        ("3 dB", "", "without a unit"),  # a logarithm
        ("1 [length]", "m", "no unit"),
        ("1 m; import os", "m", "no unit"),
        ("__import__('os') m", "m", "needs a number"),
    ],
)
def test_refuses(value, unit, words):
    with pytest.raises(ValueError, match=r".") as refusal:
        to_si(value, unit)
    assert words in str(refusal.value)


@pytest.mark.parametrize(
    "power", ["m^9^9^9^9", "m**9**9**9", "m^(9^9^9)", "m⁹^9⁹⁹", "m^99999999", "(" * 70 + "m"]
)
def test_powers_of_powers_are_refused_at_once(power):
    with pytest.raises(ValueError, match="no unit of m"):
        unit_factor(power, "m")


@pytest.mark.parametrize("value", [math.nan, "nan", "nan mm", math.inf, "1e400 m"])
def test_a_model_refuses_what_is_not_finite(value):
    with pytest.raises(InputError, match="finite number"):
        Sample(length=value)


class Support(Frozen):
    model_config = ConfigDict(allow_inf_nan=True)
    stiffness: Force = 0.0


def test_where_infinity_is_allowed_nan_is_not():
    assert Support(stiffness="inf").stiffness == math.inf
    for wrong in (math.nan, "nan", "nan N"):
        with pytest.raises(InputError, match="finite number"):
            Support(stiffness=wrong)


def test_a_model_holds_si_floats():
    sample = Sample(length="80 mm", angle="90 deg", force=3, ratio="0.5")
    assert sample.model_dump() == {
        "length": 0.08,
        "angle": pytest.approx(math.pi / 2),
        "force": 3.0,
        "ratio": 0.5,
    }
    assert all(type(value) is float for value in sample.model_dump().values())


def test_a_model_is_frozen():
    with pytest.raises(ValidationError, match="frozen"):
        Sample().length = 2.0


def test_the_schema_allows_a_number_and_a_text_and_tells_the_unit():
    schema = Sample.model_json_schema()["properties"]["length"]
    assert schema["unit"] == "m"
    number, text = schema["anyOf"]
    assert number["type"] == "number"
    assert number["exclusiveMinimum"] == 0
    assert text["type"] == "string"
    assert "[m]" in number["description"]
    assert "'1 m'" in text["description"]


class Doubled(Frozen):
    length: Length

    @cached_property
    def twice(self) -> float:
        return 2 * self.length


def test_a_copy_forgets_what_followed_from_the_old_values():
    one = Doubled(length=1)
    assert one.twice == 2
    assert one.model_copy(update={"length": 3.0}).twice == 6
    assert one.twice == 2


@pytest.mark.parametrize(("text", "unit"), [("50 deg", ""), ("80 rad m/s", "m/s"), ("5 rad", "m")])
def test_an_angle_is_no_number_of_another_unit(text, unit):
    with pytest.raises(ValueError, match="pure number" if not unit else "no unit of"):
        to_si(text, unit)


class Whole(Frozen):
    sample: Sample = Sample()
    name: str = ""


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Sample(length="steel"), "Sample(...): length is 'steel'; it needs a number"),
        (lambda: Sample(lenght=1), "unknown key lenght; did you mean length?"),
        (lambda: Whole(sample={"length": "x"}), "Whole(...): sample.length is 'x'"),
        (lambda: Sample(length="1 kg"), "no unit of m"),
        (lambda: Whole(name=3, sample=4), "(1 more problem after this one)"),
    ],
)
def test_python_callers_are_told_in_one_sentence(make, words):
    with pytest.raises(InputError) as caught:
        make()
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "pydantic" not in str(caught.value)
    assert caught.value.__cause__ is None
