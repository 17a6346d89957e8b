"""Formulas: their values by hand, and what is refused in one sentence."""

import numpy as np
import pytest

import antinode as an
from antinode.study.answers.formula import read_formula

UNITS = {
    "speed": "m/s",
    "thrust": "N",
    "EI at 3 m": "1",
    "frequency_hz": "Hz",
    "omega2": "rad^2/s^2",
}
OF_MODES, MODES = ("frequency_hz", "omega2"), ("bending 1", "bending 2")
COLUMNS = {
    "speed": np.array([60.0, 80.0, 100.0]),
    "thrust": np.array([1e4, 8e4, 9e4]),
    "EI at 3 m": np.array([0.9, 1.0, 1.1]),
    "frequency_hz": np.array([[3.0, 9.0], [np.nan, 8.0], [2.0, 7.0]]),
    "omega2": np.array([[4.0, 9.0], [-1.0, 9.0], [1.0, 9.0]]),
}


def read(text):
    return read_formula(text, UNITS, OF_MODES, MODES)


@pytest.mark.parametrize(
    ("text", "values", "unit"),
    [
        ("f2 - f1", [6, np.nan, 5], "Hz"),
        ("2*speed + 1", [121, 161, 201], ""),
        ("-speed", [-60, -80, -100], "m/s"),
        ("thrust/1e3 ** 1", [10, 80, 90], ""),
        ("EI_at_3_m", [0.9, 1, 1.1], "1"),
        ("sqrt(omega2[1])", [2, np.nan, 1], ""),
        ('omega2["bending 2"]', [9, 9, 9], "rad^2/s^2"),
        ("max(f1, f2, 8.5)", [9, np.nan, 8.5], ""),
        ("min(speed, 2 * speed)", [60, 80, 100], ""),
        ("max(f1, f2)", [9, np.nan, 7], "Hz"),
    ],
)
def test_numbers(text, values, unit):
    formula = read(text)
    assert not formula.is_condition
    assert formula(COLUMNS) == pytest.approx(values, nan_ok=True)
    assert formula.unit == unit


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("speed > 70", [False, True, True]),
        ('thrust < "80.5 kN"', [True, True, False]),
        ('"70 m/s" < speed <= 80', [False, True, False]),
        ("f1 > 2.5 or speed == 100", [True, False, True]),
        ("not speed > 70 and f2 > 1", [True, False, False]),
    ],
)
def test_conditions(text, values):
    formula = read(text)
    assert formula.is_condition
    assert formula(COLUMNS).tolist() == values


def test_what_is_not_known_is_told():
    assert read("f1 > 1 or speed > 0").known(COLUMNS).tolist() == [True, False, True]


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("1 / (speed - 80) > 0", [True, False, True]),  # x / 0 is no number, and no large one
        ("-1 / (speed - 80)", [True, False, True]),
        ("(speed - 80) / (speed - 80) > 0 or speed > 0", [True, False, True]),
        ("log(speed - 80) < 5", [False, False, True]),
        ("sqrt(speed - 80) >= 0 or thrust > 0", [False, True, True]),
        ("min(1 / (speed - 80), 3) < 4", [True, False, True]),
        ("exp(100 * speed) > 1", [False, False, False]),
        ("speed > 1 / 0", [False, False, False]),
    ],
)
def test_arithmetic_without_a_result_is_not_known(text, known):
    assert read(text).known(COLUMNS).tolist() == known


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("sped > 1", "did you mean speed"),
        ("__import__('os').system('x')", "the functions of a formula are"),
        ("speed.real", "Attribute has no place"),
        ("(lambda: 1)()", "the functions of a formula are"),
        ("[1, 2]", "List has no place"),
        ("speed if thrust else 1", "IfExp has no place"),
        ("speed >", "cannot be read"),
        ("omega2", "say which"),
        ("speed[1]", "leave out the brackets"),
        ("f3", "no mode 3; take 1 to 2"),
        ("f0", "no mode 0"),
        ("1 + 2", "names no input or output"),
        ('speed > "3 kg"', "3 kg"),
        ('speed * 2 > "3 m/s"', "beside one name"),
        ("speed and thrust", "take conditions"),
        ("(speed > 1) + 1", "a condition is no number"),
        ("speed & 1", "arithmetic of a formula"),
        ("speed in thrust", "comparisons of a formula"),
        ("sin(speed, thrust)", "takes one number"),
        ("+".join(["speed"] * 300), "characters"),
        ("(" * 60 + "speed" + ")" * 60 + "**2" * 60, "nested"),
        ("speed + 1" + "0" * 400, "too large"),
        ("True", "no number"),
    ],
)
def test_what_is_no_formula_is_refused(text, words):
    with pytest.raises(an.InputError, match="formula"):
        read(text)
    with pytest.raises(an.InputError) as told:
        read(text)
    assert words in str(told.value)
