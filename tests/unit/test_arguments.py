"""Arguments of Python callers: words, counts, arrays; and values that compare and hash."""

import numpy as np
import pytest

from antinode import (
    Beam,
    BeamBatch,
    Ends,
    InputError,
    natural_frequencies,
    solve_many,
    solve_modes,
)
from antinode.beam.attachments import PointMass

ONE = np.ones(3)
X = np.array([0.0, 0.4, 1.0])


def beam(**more):
    return Beam.from_stations(X, ONE, ONE, **more)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: beam(interpolation="Step"), "'step', 'linear', 'log'"),
        (lambda: Beam(X, np.ones((2, 2)), np.ones((2, 2)), interpolation="cubic"), "'linear'"),
        (lambda: Ends("Clamped"), "'clamped', 'pinned'"),
        (lambda: Ends(None), "'clamped', 'pinned'"),
        (lambda: Ends("free", right_axial="Fixed"), "'free', 'fixed'"),
        (lambda: Ends(left_torsion="clamped"), "'free', 'fixed'"),
        (lambda: solve_modes(beam(), normalisation="Mass"), "'amplitude', 'mass'"),
        (lambda: solve_modes(beam(), normalisation=None), "'amplitude', 'mass'"),
        (lambda: solve_modes(beam(), method="TMM"), "'riccati', 'tmm'"),
        (lambda: solve_modes(beam(), backend="Numba"), "'numpy', 'numba'"),
        (lambda: solve_modes(beam(), families=["Torsion"]), "'longitudinal', 'torsion'"),
    ],
)
def test_unknown_words_raise_with_those_allowed(call, words):
    with pytest.raises(InputError, match=words):
        call()


@pytest.mark.parametrize("modes", [2.5, 3.0, "3", None, 0, 501, np.float64(2.0)])
@pytest.mark.parametrize(
    "call",
    [
        lambda modes: solve_modes(beam(), modes),
        lambda modes: natural_frequencies(beam(), modes),
        lambda modes: BeamBatch(ONE, ONE, ONE, modes=modes),
    ],
)
def test_modes_are_a_whole_number(call, modes):
    with pytest.raises(InputError, match=r"modes is .*1 \.\.\. 500"):
        call(modes)


def test_counts_of_numpy_are_whole_numbers():
    assert natural_frequencies(beam(), np.int32(2)).omega2.shape == (2,)
    assert len(solve_many(BeamBatch(ONE, ONE, ONE, modes=np.uint8(2))).omega2[0]) == 2


@pytest.mark.parametrize("tolerance", ["1e-6", None, 1j, float("nan"), 0.0])
def test_tolerances_are_real_numbers_in_range(tolerance):
    for solve in (solve_modes, natural_frequencies):
        with pytest.raises(InputError, match="tolerance is"):
            solve(beam(), 2, tolerance=tolerance)


@pytest.mark.parametrize("column", [[1.0, 2.0, 3.0, 4.0], [1.0], np.ones((3, 2)), []])
@pytest.mark.parametrize("interpolation", ["step", "linear", "log"])
@pytest.mark.parametrize("name", ["mass_per_length", "bending_stiffness", "axial_force"])
def test_columns_of_another_length_are_refused(name, interpolation, column):
    columns = {"mass_per_length": ONE, "bending_stiffness": ONE, name: column}
    with pytest.raises(InputError, match=rf"{name} has shape .* x has 3 stations"):
        Beam.from_stations(X, **columns, interpolation=interpolation)


@pytest.mark.parametrize("name", ["x", "mass_per_length", "axial_stiffness", "radius_of_gyration"])
def test_masked_values_are_refused(name):
    masked = np.ma.masked_array([0.5, 1.0, 2.0], mask=[False, True, False])
    columns = {"x": X, "mass_per_length": ONE, "bending_stiffness": ONE, name: masked}
    with pytest.raises(InputError, match=f"{name}: row 2 is masked"):
        Beam.from_stations(**columns)
    clear = np.ma.masked_array(X + 1, mask=False)
    Beam.from_stations(**columns | {name: clear})


def test_masked_values_of_batches_and_tables_are_refused():
    masked = np.ma.masked_array(np.ones((2, 2)), mask=[[False, False], [True, False]])
    with pytest.raises(InputError, match="bending_stiffness: row 2 is masked"):
        BeamBatch(np.ones(2), np.ones(2), masked)
    with pytest.raises(InputError, match="mass_per_length: row 2 is masked"):
        Beam(X, masked, np.ones((2, 2)))


@pytest.mark.parametrize(
    "column", [["a", "b", "c"], [1j, 1.0, 1.0], [None, 1.0, 2.0], [[1], [2, 3]]]
)
def test_what_is_no_number_is_refused(column):
    with pytest.raises(InputError, match="mass_per_length is"):
        Beam.from_stations(X, column, ONE)
    with pytest.raises(InputError, match="length is"):
        BeamBatch(column, ONE, ONE)


def test_batches_own_their_arrays():
    length, force = np.ones(3), np.zeros((2, 3))
    batch = BeamBatch(length, ONE, ONE, force)
    before = solve_many(batch).omega2
    length[:], force[:] = 7.0, 1.0
    assert np.array_equal(solve_many(batch).omega2, before)
    with pytest.raises(ValueError, match="read-only"):
        batch.axial_force[0, 0] = 1.0


def test_views_of_writable_arrays_are_copied():
    """A read-only view does not keep its base from being written to."""
    base = np.ones(3)
    view = base[:]
    view.flags.writeable = False
    batch = BeamBatch(view, ONE, ONE)
    base[0] = 9.0
    assert batch.length[0, 0] == 1.0


def test_beams_compare_and_hash_by_value():
    assert beam() == beam()
    assert beam(name="other") != beam()
    assert beam(axial_force=[0.0, 0.0, 1.0], interpolation="linear") != beam()
    assert beam() != "beam"
    assert hash(beam()) == hash(beam(axial_force=[-0.0, -0.0, -0.0]))
    assert {beam(): 1, beam(axial_stiffness=ONE): 2}[beam()] == 1


def test_batches_and_results_compare_and_hash_by_value():
    batches = [BeamBatch(ONE, ONE, ONE, modes=2) for _ in range(2)]
    assert batches[0] == batches[1]
    assert batches[0] != BeamBatch(ONE, ONE, 2 * ONE, modes=2)
    for solve, other in (
        (lambda: solve_modes(beam(), 2), solve_modes(beam(), 3)),
        (lambda: natural_frequencies(beam(), 2), natural_frequencies(beam(), 3)),
        (lambda: solve_many(batches[0]), solve_many(BeamBatch(ONE, ONE, -ONE, modes=2))),
        (lambda: solve_modes(beam(), 2).modes[-1], solve_modes(beam(), 2).modes[-2]),
    ):
        assert solve() == solve()
        assert hash(solve()) == hash(solve())
        assert solve() != other


def test_families_are_names_each_once():
    one = solve_modes(beam(), 2, families="bending")
    assert one == solve_modes(beam(), 2, families=["bending", "bending"])
    with pytest.raises(InputError, match="families is empty"):
        solve_modes(beam(), families=())


def test_families_that_were_not_solved_are_named():
    result = solve_modes(beam(), 2)
    for ask in (lambda: result.at(0.5, "torsion"), lambda: result.frequencies_hz("longitudinal")):
        with pytest.raises(InputError, match="it has 'bending'"):
            ask()
    assert result.family("torsion") == ()
    with pytest.raises(InputError, match="allowed are 'bending'"):
        result.family("Bending")


@pytest.mark.parametrize("problem", ["beam.toml", None, 5])
@pytest.mark.parametrize("solve", [solve_modes, natural_frequencies])
def test_what_is_no_beam_is_refused(problem, solve):
    with pytest.raises(InputError, match="a Beam or a case is wanted"):
        solve(problem, 1)


def test_a_truth_value_is_no_count():
    with pytest.raises(InputError, match="whole number"):
        solve_modes(Beam.from_stations([0, 1], 1.0, 1.0), True)


@pytest.mark.parametrize("item", ["mass", [PointMass(0.5, 1.0)], PointMass([0.5], 1.0), None])
def test_what_no_beam_carries_is_refused(item):
    with pytest.raises(InputError, match=r"carries|give a number"):
        Beam.from_stations([0, 1], 1.0, 1.0).with_attachments(item)


def test_one_length_is_not_that_of_several_segments():
    with pytest.raises(InputError, match="shapes"):
        BeamBatch([1.0], [1.0], [1.0], [1.0, 2.0])
