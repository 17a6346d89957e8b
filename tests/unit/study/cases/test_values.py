"""One value that no body can have is NaN with a reason; the other cases are as they would be."""

import numpy as np
import pytest

import antinode as an
from antinode.study.sweep.sweep import sweep
from cli_run import run
from study_text import study

ROWS = "vehicle.stations.bending_stiffness.3"


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    folder = tmp_path_factory.mktemp("values")
    run("init", folder)
    return an.load_case(folder / "case.toml")


@pytest.mark.parametrize(
    ("key", "bad"),
    [
        ("bending_stiffness", -0.5),
        ("bending_stiffness", 0.0),
        ("bending_stiffness", 1e305),
        ("mass_per_length", -2.0),
        ("axial_stiffness", -1e-3),
        (ROWS, -1.0),
    ],
)
def test_a_bad_sample_ends_nothing(case, key, bad):
    good = [1.0, 1.1] if key != ROWS else [2e7, 3e7]
    text = 'inputs = [{{ key = "{}", values = {} }}]\nsolve.modes = 2'
    alone = sweep(study(case, text.format(key, good)))
    found = sweep(study(case, text.format(key, [good[0], bad, good[1]])))
    assert found.reason.values.tolist() == [0, 10, 0]
    assert np.isnan(found.frequency_hz.values[1]).all()
    assert found.attrs["failed"] == 1
    np.testing.assert_allclose(
        found.frequency_hz.values[[0, 2]], alone.frequency_hz.values, rtol=1e-7
    )


def test_a_wide_distribution_counts_what_it_loses(case):
    text = """
    inputs = [{ key = "bending_stiffness", distribution = "normal", sd = 0.5 }]
    design = { kind = "sobol", number = 128 }
    solve.modes = 1
    """
    found = sweep(study(case, text))
    bad = found.bending_stiffness.values <= 0
    assert 0 < bad.sum() < 20
    assert found.reason.values[bad].tolist() == [10] * int(bad.sum())
    assert (found.reason.values[~bad] != 10).all()


def test_a_column_that_is_zero_at_the_nose_may_be(case, tmp_path):
    run("init", tmp_path / "v")
    rows = (tmp_path / "v" / "stations.csv").read_text()
    settings = ["vehicle.interpolation=linear"]
    header = next(line for line in rows.splitlines() if line.startswith("x"))
    column = header.split(",").index("radius [mm]")
    lines = rows.splitlines()
    first = lines.index(header) + 1
    cells = lines[first].split(",")
    cells[column] = "0"
    lines[first] = ",".join(cells)
    (tmp_path / "v" / "stations.csv").write_text("\n".join(lines) + "\n")
    nosed = an.load_case(tmp_path / "v" / "case.toml", settings)
    assert nosed.vehicle.stations.radius[0] == 0
    text = 'inputs = [{ key = "radius", values = [1, 1.01] }]\nsolve.modes = 1'
    assert sweep(study(nosed, text)).reason.values.tolist() == [0, 0]
