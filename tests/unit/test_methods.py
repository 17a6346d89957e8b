"""Methods by name: each is a function above its class, and type checkers see the same ones."""

import ast
import inspect
from pathlib import Path

import numpy as np
import pytest

import antinode as an
from antinode import methods
from antinode.exchange.convert import convert_file
from antinode.modes.solve import solve_modes

TABLES = [
    value
    for value in vars(methods).values()
    if inspect.isclass(value) and value.__name__.endswith("Methods")
]
TREE = ast.parse(Path(methods.__file__).read_text(encoding="utf-8"))
OWN_ONLY = {"__repr__", "__str__"}
"""What type checkers know of every object."""


def entries(table):
    return {name: m for name, m in vars(table).items() if isinstance(m, methods.Method)}


def told(table):
    """What type checkers are told: names, and the functions written out."""
    node = next(n for n in TREE.body if isinstance(n, ast.ClassDef) and n.name == table.__name__)
    names = {}
    for branch in (n for n in node.body if isinstance(n, ast.If)):
        if ast.unparse(branch.test) != "TYPE_CHECKING":
            continue
        for statement in branch.body:
            if isinstance(statement, ast.FunctionDef):
                names[statement.name] = statement
            elif isinstance(statement, ast.Assign):
                names[statement.targets[0].id] = statement.value
    return names


@pytest.mark.parametrize("table", TABLES)
def test_every_name_leads_to_a_function_whose_docstring_is_the_method_s(table):
    for name, method in entries(table).items():
        function = getattr(table, name)
        assert callable(function), f"{table.__name__}.{name}"
        assert function.__name__ == method.function
        assert function.__doc__


@pytest.mark.parametrize("table", TABLES)
def test_type_checkers_are_told_of_the_same_functions(table):
    names = told(table)
    assert names.keys() == entries(table).keys() - OWN_ONLY
    for name, value in names.items():
        function = getattr(table, name)
        if isinstance(value, ast.FunctionDef):
            given = [a.arg for a in (*value.args.args, *value.args.kwonlyargs)][1:]
            assert given == list(inspect.signature(function).parameters)[1:], name
        else:
            assert value.attr == function.__name__


def beam():
    return an.Beam([0, 2], 3.0, 500.0, axial_stiffness=1e6, ends=an.Ends("clamped"), name="rod")


def test_a_method_is_the_function():
    own = beam()
    assert own.modes.__func__ is solve_modes
    assert own.modes(2).frequencies_hz().tolist() == solve_modes(own, 2).frequencies_hz().tolist()
    assert own.frequencies(1).omega2 == pytest.approx(own.modes(1).mode("bending", 1).omega2)
    pressed = an.Beam([0, 2], 3.0, 500.0, axial_force=1.0, ends=an.Ends("clamped"))
    np.testing.assert_allclose(pressed.buckling().load_factor, np.pi**2 * 500 / 16, rtol=1e-9)
    (first,) = pressed.stability(400.0).to_dataframe().load_factor
    np.testing.assert_allclose(first, np.pi**2 * 500 / 16, rtol=1e-8)
    assert "modes" in dir(own)


def test_a_beam_comes_back_from_its_table():
    table = beam().to_dataframe()
    assert an.Beam(**table, ends=an.Ends("clamped"), name="rod") == beam()
    assert table.attrs["units"]["bending_stiffness"] == "N m^2"
    jump = an.Beam([0, 1, 1, 2], [3, 2, 5, 4], 500.0, interpolation="linear")
    assert list(jump.to_dataframe().x) == [0, 1, 1, 2]
    assert an.Beam(**jump.to_dataframe(), interpolation="linear") == jump


def test_what_is_saved_is_read_again(tmp_path):
    assert beam().save(tmp_path / "rod.toml") == ()
    again = an.load_beam(tmp_path / "rod.toml")
    assert again.beam() == beam()
    again.modes(1).save(tmp_path / "modes.csv")
    assert (tmp_path / "modes.csv").read_text().startswith("family,number,name,kind,frequency_hz")
    convert_file(tmp_path / "rod.toml", tmp_path / "rod.bdf", units="mm-t-s")
    assert an.load_beam(tmp_path / "rod.toml").beam() == beam()
    with pytest.raises(an.InputError, match=r"\.bdf holds its modes: beam\.modes\(\)\.save"):
        beam().save(tmp_path / "rod.bdf")
    with pytest.raises(an.InputError, match="units is 'mm'"):
        beam().modes(1).save(tmp_path / "rod.bdf", units="mm")


def test_a_response_without_a_file_is_that_of_the_file(tmp_path):
    tables = {
        "frequency": {"from": "1 Hz", "to": "20 Hz", "points": 50},
        "damping": {"loss_factor": 0.02},
        "forces": [{"x": "2 m", "amplitude": "1 N"}],
        "outputs": [{"x": "2 m", "quantity": "displacement"}],
    }
    found = beam().response("harmonic", **tables)
    beam().save(tmp_path / "rod.toml")
    (tmp_path / "response.toml").write_text(
        "damping.loss_factor = 0.02\n"
        'response = { of = "rod.toml", kind = "harmonic" }\n'
        'frequency = { from = "1 Hz", to = "20 Hz", points = 50 }\n'
        '[[forces]]\nx = "2 m"\namplitude = "1 N"\n'
        '[[outputs]]\nx = "2 m"\nquantity = "displacement"\n'
    )
    np.testing.assert_array_equal(
        found.values, an.solve_response(tmp_path / "response.toml").values
    )
    assert next(iter(found.to_dataframe().columns)) == "frequency [Hz]"
    with pytest.raises(an.InputError, match=r"'1 kg'.*no unit of N"):
        beam().response("harmonic", **tables | {"forces": [{"x": 2, "amplitude": "1 kg"}]})
    with pytest.raises(an.InputError, match="nothing drives the beam"):
        beam().response("harmonic", **tables | {"forces": []})


def test_a_vehicle_has_its_methods(tmp_path):
    an.write_example("starter", tmp_path)
    case = an.load_case(tmp_path / "case.toml")
    assert case.loads() is case.loads
    table = case.loads().to_dataframe()
    N = case.loads.axial_force([0.0, case.vehicle.length])
    np.testing.assert_array_equal(table.N.iloc[[0, -1]], N)
    assert {"u_Y", "M_bent"} <= set(case.to_dataframe().columns)
    assert case.statics().x[0] == 0.0
    case.save(tmp_path / "loads.csv")
    assert case.modes(1).to_dataframe().loc["bending 1", "frequency_hz"] > 0


def test_a_study_runs(tmp_path):
    an.write_example("sweep", tmp_path)
    study = an.load_study(tmp_path / "study.toml", ["inputs.0.number=3", "solve.modes=1"])
    found = study.run()
    assert dict(found.sizes)["case"] == 6
    assert study.run_table.chunk == 4096
    assert study.plot(found).size


@pytest.mark.parametrize("name", an.__all__)
def test_every_public_name_is_there(name):
    assert getattr(an, name) is not None
