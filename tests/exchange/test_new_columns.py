"""The columns of shear, rotary inertia, foundations, water and damping in every format."""

import meshio
import numpy as np
import pytest
from scipy.io import loadmat

from antinode import solve_modes
from antinode.beam.beam import Beam
from antinode.exchange.inputs import Choices, read_beam
from antinode.exchange.outputs import Modes, write_beam, write_modes

NAMES = (
    "shear_stiffness",
    "rotary_inertia_per_length",
    "foundation_stiffness",
    "added_mass_per_length",
    "loss_factor",
)


def beam(how="step", **more):
    """A beam with all of them, of which one part is rigid in shear."""
    return Beam.from_stations(
        [0.0, 1.0, 3.0], [8.0, 6, 7], [4e4, 5e4, 6e4], [2e7, 2e7, 1e7], [900.0, 400, 0],
        interpolation=how,
        shear_stiffness=[np.inf if how == "step" else 4e5, 3e5, 2e5],
        rotary_inertia_per_length=[0.02, 0.0, 0.03], foundation_stiffness=[0.0, 2e3, 1e3],
        added_mass_per_length=[2.0, 0.0, 1.0], loss_factor=[0.01, 0.02, 0.0], **more,
    )  # fmt: skip


@pytest.mark.parametrize("ending", ["toml", "csv", "xlsx"])
@pytest.mark.parametrize("how", ["step", "linear", "log"])
def test_tables_give_the_beam_back(how, ending, tmp_path):
    for more in ({}, {"theory": "euler_bernoulli"}, {"shear_form": "engesser"}):
        own, path = beam(how, **more), tmp_path / f"beam.{ending}"
        notes = write_beam(path, own, ending)
        again = read_beam(path, ending, Choices()).beam
        for name in NAMES:
            np.testing.assert_allclose(getattr(again, name), getattr(own, name), rtol=1e-15)
        kept = (again.theory, again.shear_form) == (own.theory, own.shear_form)
        assert kept or any(value in note for value in more.values() for note in notes)


def test_matlab_has_them_and_the_theory(tmp_path):
    path, result = tmp_path / "m.mat", solve_modes(beam(shear_form="engesser"), 2)
    write_modes(path, Modes(result, result.to_dict()))
    data = loadmat(path, squeeze_me=True)
    assert (str(data["theory"]), str(data["shear_form"])) == ("timoshenko", "engesser")
    for name in NAMES:
        assert name in data["stations"].dtype.names
    np.testing.assert_array_equal(data["stations"]["shear_stiffness"].item(), [np.inf, 3e5, 3e5])


def test_paraview_has_them_and_says_what_it_has_not(tmp_path):
    path, result = tmp_path / "m.vtu", solve_modes(beam("linear", shear_form="engesser"), 2)
    notes = write_modes(path, Modes(result, result.to_dict()))
    assert any("engesser" in note for note in notes)
    cells = meshio.read(path).cell_data
    for name, unit in zip(NAMES, ("N", "kg m", "N/m^2", "kg/m", "1"), strict=True):
        assert f"{name} [{unit}]" in cells
    stiff = cells["shear_stiffness [N]"][0]
    assert 2e5 < np.min(stiff) < np.max(stiff) < 4e5


def test_a_universal_file_says_that_it_holds_modes_alone(tmp_path):
    path, result = tmp_path / "m.uff", solve_modes(beam(), 2)
    notes = write_modes(path, Modes(result, result.to_dict()))
    assert any("properties of the beam" in note for note in notes)
