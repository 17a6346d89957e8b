"""Studies of a vehicle on the water's stiffness: each case as alone, and as dense matrices."""

import numpy as np
import pytest

import antinode as an
from antinode.study.cases.reasons import FLUTTERS, GROWS, NOT_PROVEN, failed
from antinode.study.design.file import KINDS
from antinode.vehicle.refusals import FINS, OUT_OF_RANGE
from cli_run import run
from water_elements import case_of, dense

SPEED = 65.0, 80.0, 80.0, -5.0, 110.0
FIN = 5.0, 5.0, 7.0, 5.0, 5.0  # the third is off the body
OUTPUTS = ("frequency_hz", "error_hz", "growth_rate_per_s", "damping_ratio", "kind", "proven")
SOLVED = 0, 1, 4


@pytest.fixture(scope="module")
def starter(tmp_path_factory):
    folder = tmp_path_factory.mktemp("water")
    run("init", "--example", "sweep", folder)
    return folder / "case.toml"


@pytest.fixture(scope="module")
def study(starter):
    return an.Study(
        case=case_of(starter),
        inputs=[
            {"key": "condition.speed", "values": SPEED},
            {"key": "condition.fin_position", "values": FIN},
        ],
        design={"kind": "zip"},
        solve={"modes": 4},
        outputs=(*OUTPUTS, "F_PY"),
        run={"chunk": 2},
    )


@pytest.fixture(scope="module")
def swept(study):
    return an.sweep(study)


@pytest.mark.parametrize("row", SOLVED)
def test_cases_are_as_they_are_alone_and_as_dense_matrices(starter, swept, row):
    case = case_of(starter, speed=SPEED[row])
    modes = [m for m in an.solve_modes(case, 4, families=["bending"]).modes if m.number][:4]
    own = swept.isel(case=row)
    for name in OUTPUTS[:4]:
        alone = np.array([getattr(m, name) for m in modes], dtype=float)
        np.testing.assert_allclose(own[name], alone, rtol=1e-12, atol=1e-14)
    assert [KINDS[int(k)] for k in own.kind] == [m.kind for m in modes]
    assert own.proven == 1
    assert float(own.F_PY) == case.loads.F_PY
    exact = dense(case)
    for hz, growth in zip(own.frequency_hz.values, own.growth_rate_per_s.values, strict=True):
        s = complex(growth, 2 * np.pi * np.nan_to_num(hz))
        assert np.min(np.abs(exact - s)) <= 2e-7 * abs(exact[5])


def test_what_has_no_answer_says_why_and_the_rest_goes_on(swept):
    assert swept.reason.values.tolist() == [FLUTTERS, GROWS, FINS, OUT_OF_RANGE, FLUTTERS]
    for row in np.flatnonzero(failed(swept.reason.values)):
        assert all(np.isnan(swept[name][row]).all() for name in (*OUTPUTS, "F_PY"))
        assert swept.warned[row] == 0


def test_limits_of_the_tangents_stand_beside_the_numbers(swept):
    told = {w["message"]: w["count"] for w in swept.attrs["warnings"]}
    assert sum(n for text, n in told.items() if "touches on one side" in text) == 2
    assert sum(n for text, n in told.items() if "f L/V is above 0.3" in text) == 3
    assert not any("hydrodynamic stiffness" in each for each in swept.attrs["not_modelled"])
    assert any(each.startswith("added mass") for each in swept.attrs["not_modelled"])


def test_a_pool_and_a_store_tell_the_same_bits(study, tmp_path):
    few = study.model_copy(
        update={
            "solve": study.solve.model_copy(update={"modes": 1}),
            "run_table": study.run_table.model_copy(update={"chunk": 4}),
        }
    )
    found = an.sweep(few)
    pool = few.model_copy(update={"run_table": few.run_table.model_copy(update={"chunk": 2})})
    stored = an.sweep(pool, tmp_path / "store", workers=2)
    for name in (*OUTPUTS, "F_PY", "reason", "warned", "shape", "tracked_mode"):
        np.testing.assert_array_equal(stored[name].values, found[name].values)


def test_shapes_of_complex_modes_are_told_in_phase(starter, swept):
    case = case_of(starter, speed=80.0)
    result = an.solve_modes(case, 4, families=["bending"])
    modes = [m for m in result.modes if m.number][:4]
    for k, mode in enumerate(modes):
        Y = np.interp(swept.point, result.x, mode.phasors[:, 0].real) + 1j * np.interp(
            swept.point, result.x, mode.phasors[:, 0].imag
        )
        own = swept["shape"].values[1, k]
        likeness = abs(np.vdot(Y, own)) ** 2 / np.vdot(Y, Y).real / (own @ own)
        # what is out of phase is at most this much of the whole
        least = np.min(np.abs(Y @ Y)) / np.vdot(Y, Y).real
        assert likeness >= (1 + least) / 2 - 1e-3


def test_a_list_that_is_not_proven_is_no_answer(tmp_path):
    """Half of the stiffness lost beside a dashpot: no bound proves the list, and none is given."""
    (tmp_path / "beam.toml").write_text(BEAM)
    study = an.Study(
        case=an.load_beam(tmp_path / "beam.toml"),
        inputs=[{"key": "dashpots.0.translational", "values": [1e-3, 1.0]}],
        outputs=OUTPUTS,
        solve={"modes": 3},
    )
    found = an.sweep(study)
    assert found.reason.values.tolist() == [NOT_PROVEN] * 2
    assert found.proven.values.tolist() == [0, 0]
    assert np.isnan(found.frequency_hz).all()
    assert found.attrs["failed"] == 2


BEAM = """
[beam]
ends = { left = "clamped" }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
loss_factor = [0.5, 0.5]
[[beam.dashpots]]
x = 1
translational = 1.0
"""
