"""Physics as switches, what a beam carries, panels beside the function: without a browser."""

import math
import tomllib

import numpy as np
import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed (extra web)")

from antinode import Beam, natural_frequencies
from antinode.app.attached import KINDS, added, attached, entries, removed
from antinode.app.compute import Answer, full_answer, quick_answer
from antinode.app.inputs import sliders
from antinode.app.panels.compare import compare_data, snapshot
from antinode.app.panels.effects import effects_data, ends_data
from antinode.app.panels.frequencies import frequencies_data
from antinode.app.panels.mode import energies, mode_data
from antinode.app.panels.modes import modes_data
from antinode.app.panels.sketch import sketch_data
from antinode.app.panels.stability import stability_data
from antinode.app.physics import changes_of, switches
from antinode.app.quick import quick_modes
from antinode.app.save import case_toml
from antinode.app.source import read_example
from antinode.app.state import File, State, View, with_changes
from antinode.beam.ends import Ends


def example(name):
    return State(read_example(name))


def turned(state, key, position):
    """The state with a switch in a position."""
    return state.changed(changes_of(key, position, state.original))


def position(state, key):
    """Where a switch stands."""
    found = switches(state.problem, state.beam, state.original)
    return next(s.position for s in found if s.key == key)


@pytest.mark.parametrize(
    ("key", "where", "told"),
    [
        ("theory", "euler_bernoulli", {"theory": "euler_bernoulli"}),
        ("forces", "thrust", {"end_force": "fixed_direction", "thrust_follows": 1.0}),
        ("forces", "none", {"end_force": "fixed_direction"}),
        ("water", "tangent", {"hydrodynamic_stiffness": "tangent"}),
        ("added", "on", {"fin_added_mass": "plate", "planing_added_mass": "wedge"}),
    ],
)
def test_a_switch_of_a_vehicle_is_what_its_file_says(key, where, told):
    state = turned(example("starter"), key, where)
    assert position(state, key) == where
    model = tomllib.loads(case_toml(state))["model"]
    assert told.items() <= model.items()
    first = position(example("starter"), key)
    assert position(turned(state, key, first), key) == first


def test_each_choice_of_the_end_forces_stands_beside_the_others():
    """The table's other columns are what the page computes when it is switched there."""
    state = example("starter")
    table = ends_data(full_answer(state))
    assert table["columns"][1] == "thrust and cavitator follow [Hz]"
    for column, where in ((2, "none"), (3, "thrust")):
        own = full_answer(turned(state, "forces", where)).full
        shown = [float(row[column].split()[0]) for row in table["rows"]]
        np.testing.assert_allclose(shown, own.frequencies_hz(), rtol=1e-5)


def test_each_effect_is_the_ratio_of_two_solutions():
    state = example("starter")
    table = effects_data(full_answer(state))
    k = table["columns"].index("ends that follow")
    follow, fixed = (
        natural_frequencies(s.beam, 1, tolerance=1e-8).frequencies_hz[0]
        for s in (state, turned(state, "forces", "none"))
    )
    assert table["rows"][0][k]["text"] == f"{follow / fixed - 1:+.2%}"
    assert table["rows"][0][k]["share"] == pytest.approx(1.0)  # the largest of all


def test_added_mass_has_its_switch_and_its_bar():
    dry = example("starter")
    tables = with_changes(dry.file.tables, {"model.fin_added_mass": "plate_one_face"})
    for first in (dry, State(File(tables, "one face"))):
        wet = turned(first, "added", "on")
        table = effects_data(full_answer(wet))
        k = table["columns"].index("added mass")
        f, g = (
            natural_frequencies(s.beam, 1, tolerance=1e-8).frequencies_hz[0]
            for s in (wet, turned(wet, "added", "off"))
        )
        assert table["rows"][0][k]["text"] == f"{f / g - 1:+.2%}"
        assert -2e-3 < f / g - 1 < -5e-4
    assert wet.problem.model.fin_added_mass == "plate_one_face"
    assert wet.problem.model.planing_added_mass == "none"


def test_the_waters_stiffness_has_complex_modes_and_says_what_it_leaves_out():
    plain = example("starter").changed({"solve.modes": 1, "model.theory": "euler_bernoulli"})
    state = turned(plain, "water", "tangent")
    answer = full_answer(state)
    data = frequencies_data(answer, state.view)
    assert data["damped"]
    assert not any("hydrodynamic" in words for words in data["left_out"])
    modes = [m for m in answer.full.family("bending") if m.number]
    assert {"divergent", "elastic", "overdamped"} == {m.kind for m in modes}
    for row, mode in zip(data["rows"], modes, strict=True):
        if mode.kind == "elastic":
            assert float(row["text"]) == pytest.approx(mode.frequency_hz, rel=1e-5)
            shown, true = row["damping"].rstrip("%"), 100 * mode.damping_ratio
        else:
            assert row["text"] == mode.kind
            shown, true = row["damping"].split()[0], mode.eigenvalue.real
        assert float(shown) == pytest.approx(true, rel=1e-2)
    assert "complex" in effects_data(answer)["notes"][0]
    beside = ends_data(answer)  # contact on and off stand where the ends do
    assert beside["columns"][2:] == ["contact off [Hz]", "without [Hz]", "contact ends [g]"]
    (row,) = beside["rows"]
    steady = next(m for m in modes if m.kind == "elastic")
    assert float(row[1]) == pytest.approx(steady.frequency_hz, rel=1e-5)
    assert float(row[2]) < float(row[1]) < float(row[3])
    assert "hydrodynamic stiffness and damping" in str(
        frequencies_data(quick_answer(example("starter")), state.view)["left_out"]
    )


def beam_state(**table):
    """A beam of EI = 8, m = 2, L = 3, with foundation and an axial force."""
    stations = {
        "x": [0.0, 3.0],
        "mass_per_length": [2.0, 2.0],
        "bending_stiffness": [8.0, 8.0],
        "axial_force": [1.0, 1.0],
        "foundation_stiffness": [50.0, 50.0],
    }
    return State(File({"beam": {"stations": stations, **table}}, "b.toml"))


def test_switches_of_a_beam():
    state = beam_state(ends={"left": "clamped"})
    keys = [s.key for s in switches(state.problem, state.beam, state.original)]
    assert keys == ["left", "right", "right_force", "foundation_stiffness"]
    # on a foundation k the square of every omega is larger by k/m (N = 0)
    still = state.changed({"beam.stations.axial_force": None})
    with_, without = (
        natural_frequencies(s.beam, 3, tolerance=1e-9).omega2
        for s in (still, turned(still, "foundation_stiffness", "off"))
    )
    np.testing.assert_allclose(with_ - without, 50.0 / 2.0, rtol=1e-6)
    off = turned(state, "foundation_stiffness", "off")
    assert turned(off, "foundation_stiffness", "on").beam == state.beam
    follows = turned(state, "right_force", "1")
    assert follows.beam.following() == (0.0, 1.0)
    held = turned(follows, "right", "pinned")  # a force turns with a free end only
    assert held.beam.ends == Ends("clamped", "pinned")


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_attached_moves_the_frequencies_and_can_be_taken_out(kind):
    state = beam_state(ends={"left": "clamped"})
    changes, number = added(state, kind)
    there = state.changed(changes)
    (path, name), *more = attached(there).items()
    assert (name, more) == (f"{kind} 1", [])
    assert number.startswith(path)
    assert entries(there, KINDS[kind])[0]["x"] == 1.5
    item = next(i for i in sketch_data(quick_answer(there), "SI")["items"])
    assert (item["path"], item["x"]) == (f"{path}.x", 1.5)
    before, after = (quick_modes(s.beam, 2).omega2 for s in (state, there))
    assert abs(after[0] / before[0] - 1) > 1e-6
    out = there.changed(removed(there, path))
    assert attached(out) == {}
    assert out.beam == state.beam
    assert tomllib.loads(case_toml(there))["beam"]["stations"]  # it can be saved


def test_a_second_one_goes_where_there_is_room_and_keeps_what_was_moved():
    state = beam_state(ends={"left": "clamped"})
    state = state.changed(added(state, "mass")[0]).changed({"beam.point_masses.0.x": 2.0})
    state = state.changed(added(state, "mass")[0])
    assert [mass["x"] for mass in entries(state, "point_masses")] == [2.0, 1.0]
    state = state.changed(removed(state, "beam.point_masses.0"))
    assert [mass.x for mass in state.problem.table.point_masses] == [1.0]


def test_quick_modes_of_a_damped_beam_are_its_complex_ones():
    state = beam_state(dashpots=[{"x": 2.0, "translational": 1.0}])
    quick, full = quick_answer(state), full_answer(state)
    np.testing.assert_allclose(quick.quick.omega2, full.quick.omega2, rtol=1e-3)
    assert full.full.is_complex


def test_a_number_from_the_list_has_a_slider():
    state = example("starter")
    plain = sliders(state.problem, state.original)
    more = sliders(state.problem, state.original, ("water.density", "nothing.there"))
    assert [i.path for i in more] == [*(i.path for i in plain), "water.density"]
    assert state.viewed(sliders=("water.density",)).query()["sliders"] == '["water.density"]'


def test_snapshots_lie_side_by_side():
    state = example("starter")
    changed = turned(state, "theory", "euler_bernoulli").changed({"condition.thrust": 60e3})
    first = snapshot("A", state, full_answer(state))
    now = snapshot("now", changed, full_answer(changed))
    table = compare_data([first], now, "bending")
    assert table["columns"] == ["mode", "A", "now"]
    a, b = (full_answer(s).full.frequencies_hz() for s in (state, changed))
    assert table["rows"][0] == [
        "1",
        f"{a[0]:.6g}",
        f"{b[0]:.6g} ({b[0] / a[0] - 1:+.2%})",
    ]
    assert ["thrust", "50000 N", "60000 N"] in table["rows"]
    assert ["theory", "Timoshenko", "Euler-Bernoulli"] in table["rows"]
    assert len(table["rows"]) == 6 + 2  # nothing else differs


def test_stability_of_a_column_is_eulers():
    """Pinned, N = 1: divergence at pi^2 EI/L^2; no load, no answer."""
    plain = beam_state(ends={"left": "pinned", "right": "pinned"})
    column = turned(plain, "foundation_stiffness", "off")
    row = stability_data(quick_answer(column))["rows"][0]
    assert row[0] == "divergence"
    assert float(row[1]) == pytest.approx(math.pi**2 * 8.0 / 9.0, rel=1e-5)
    loose = column.changed({"beam.stations.axial_force": None})
    assert "no axial force" in stability_data(quick_answer(loose))["notes"][0]


def test_quick_modes_with_shear_and_ends_that_follow_say_how_wrong_they_are():
    x = np.array([0.0, 1.0, 2.0, 3.0])
    beam = Beam.from_stations(
        x,
        mass_per_length=[2.0, 1.0, 3.0, 1.0],
        bending_stiffness=[8.0, 5.0, 6.0, 2.0],
        shear_stiffness=[90.0, 60.0, 70.0, 40.0],
        axial_force=[0.0, 0.3, 0.6, 1.0],
        interpolation="linear",
        ends=Ends(right_follower=1.0),
    )
    quick, exact = quick_modes(beam, 4), natural_frequencies(beam, 4, tolerance=1e-9)
    assert np.all(np.abs(quick.omega2 / exact.omega2 - 1) < 2e-4)
    assert np.all(np.abs(quick.omega2 - exact.omega2) < 3 * quick.error + 1e-9 * exact.omega2)


def test_complex_modes_move_as_they_do():
    """A dashpot at the top: places do not pass through zero together, and turn is the phasors'."""
    changes, _ = added(example("beam"), "dashpot")
    answer = quick_answer(example("beam").changed(changes))
    curves = modes_data(answer, View(modes=(1, 2)))["curves"]
    for k, curve in enumerate(curves):
        points = np.array(curve["points"], dtype=float)
        assert points.shape[1] == 3
        amplitude = np.hypot(points[:, 1], points[:, 2])
        assert np.max(amplitude) == pytest.approx(1.0, rel=1e-3)
        phasors = np.abs(answer.quick.phasors[:, k, 0])
        there = np.interp(points[:, 0], answer.quick.x, phasors / np.max(phasors))
        np.testing.assert_allclose(amplitude, there, atol=2e-3)
        assert np.max(np.abs(points[:, 2])) > 1e-4  # it travels
    plain = modes_data(quick_answer(example("beam")), View(modes=(1,)))
    assert len(plain["curves"][0]["points"][0]) == 2


def test_energies_of_a_mode_balance_and_a_cantilevers_moment_is_at_its_foot():
    """What bends, shears and rests, with the axial force's work, is what moves."""
    beam = Beam.from_stations(
        [0.0, 1.0, 2.5, 4.0],
        mass_per_length=[2.0, 1.0, 3.0, 1.0],
        bending_stiffness=[8.0, 5.0, 6.0, 2.0],
        shear_stiffness=[60.0, 40.0, 50.0, 30.0],
        rotary_inertia_per_length=[0.02, 0.01, 0.02, 0.01],
        foundation_stiffness=[0.3, 0.1, 0.2, 0.2],
        axial_force=[0.4, 0.4, 0.4, 0.4],
        interpolation="step",
        ends=Ends(left="clamped"),
    )
    quick = quick_modes(beam, 3)
    answer = Answer(example("beam").problem, beam, quick)
    for k in range(3):
        x, states, omega2 = quick.x, quick.states[:, k], float(quick.omega2[k])
        parts, labels = energies(answer, "bending", x, states, omega2)
        h = np.diff(x)[:, None] / 2
        whole = {name: float(np.sum(h * values)) for name, values in parts.items()}
        assert set(whole) == {"kinetic", "bending", "shear", "foundation", "axial force"}
        kinetic = whole.pop("kinetic")
        assert sum(whole.values()) == pytest.approx(kinetic, rel=2e-3)
        strain = sum(v for name, v in whole.items() if name != "axial force")
        assert strain == pytest.approx(1.0)
        assert labels["shear"] == f"shear {100 * whole['shear']:.3g} %"
    data = mode_data(answer, View(body=1))
    moment = data["curves"][0]["lines"][0]["points"]
    assert abs(moment[0][1]) == 1.0
    assert abs(moment[-1][1]) < 1e-6
    assert data["heading"].startswith("bending 1, ")
