"""A vehicle whose stations tell its torsion: modes, derivatives, sweeps, and what is refused."""

from importlib.resources import files

import numpy as np
import pytest

from antinode import InputError, load_case, solve_modes
from antinode.study.design.subject import with_value
from antinode.study.eigenvalues import eigenvalues_of
from antinode.vehicle.effects import by_logarithm

STARTER = files("antinode.examples") / "starter"


def twisting(folder, how="step", **left_out):
    """The starter's case with both columns, written as a file."""
    case = load_case(str(STARTER / "case.toml"))
    stations = case.vehicle.stations
    columns = {
        name: column.tolist() for name, column, _ in stations.columns() if name not in left_out
    }
    GJ, polar = (
        stations.bending_stiffness / 1.3,
        stations.radius**2 * 200 * (2 + np.sin(stations.x)),
    )
    columns |= {"x": stations.x.tolist(), "torsional_stiffness": GJ.tolist()}
    if "polar_inertia_per_length" not in left_out:
        columns["polar_inertia_per_length"] = polar.tolist()
    header, rows = ",".join(columns), zip(*columns.values(), strict=True)
    lines = [header, *(",".join(map(repr, row)) for row in rows)]
    (folder / "stations.csv").write_text("\n".join(lines))
    text = (STARTER / "case.toml").read_text()
    (folder / "case.toml").write_text(text.replace('= "step" ', f'= "{how}" ', 1))
    return folder / "case.toml"


@pytest.mark.parametrize("how", ["step", "linear", "log"])
def test_derivatives_by_the_columns(tmp_path, how):
    case = load_case(twisting(tmp_path, how))
    (solved,) = eigenvalues_of([case], [{"torsion": 3}], 4)
    exact = solved.sensitivity("torsion")
    stations = case.vehicle.stations
    weights, h = np.cos(np.arange(len(stations.x))), 1e-5
    for name in ("torsional_stiffness", "polar_inertia_per_length"):
        changed = [
            with_value(
                case,
                ("vehicle", "stations", name),
                getattr(stations, name) * np.exp(step * weights),
            )
            for step in (-h, h)
        ]
        low, high = (
            one.modes["torsion"].omega2 for one in eigenvalues_of(changed, [{"torsion": 3}] * 2, 4)
        )
        slope = weights @ by_logarithm(case, (name,), exact)
        assert slope == pytest.approx((high - low) / (2 * h), rel=2e-5)


def test_mass_and_thrust_do_not_move_torsion(tmp_path):
    case = load_case(twisting(tmp_path))
    (solved,) = eigenvalues_of([case], [{"torsion": 2}], 2)
    exact = solved.sensitivity("torsion")
    assert not np.any(by_logarithm(case, ("mass_per_length", "initial"), exact))
    assert not np.any(exact.by_thrust)


def test_a_rigid_rotation_and_the_same_frequencies_under_any_load(tmp_path):
    path = twisting(tmp_path)
    result = solve_modes(load_case(path), 2)
    assert [m.name for m in result.family("torsion")] == [
        "rigid axial rotation", "torsion 1", "torsion 2",
    ]  # fmt: skip
    faster = solve_modes(load_case(path, ["condition.thrust=90 kN"]), 2)
    assert np.array_equal(result.frequencies_hz("torsion"), faster.frequencies_hz("torsion"))


def test_one_column_without_the_other(tmp_path):
    with pytest.raises(InputError, match="polar_inertia_per_length is missing: give both, or"):
        load_case(twisting(tmp_path, polar_inertia_per_length=None))
