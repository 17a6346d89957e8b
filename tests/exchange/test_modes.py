"""Modes in the formats of other programs, opened by readers that are not ours."""

import json

import meshio
import numpy as np
import openpyxl
import pytest
import pyuff
import xarray as xr
from scipy.io import loadmat

from antinode import InputError
from antinode.exchange.outputs import Modes, check_modal_output, write_modes
from antinode.exchange.vtk import array_name
from exchange.conversions import solved

NAMES = ("starter", "everything")


def written(name, path):
    """Write the modes of an example; return the result."""
    result = solved(name)
    write_modes(path, Modes(result, result.to_dict()))
    return result


@pytest.mark.parametrize("name", NAMES)
def test_matlab(name, tmp_path):
    result = written(name, tmp_path / "modes.mat")
    data = loadmat(tmp_path / "modes.mat", squeeze_me=True)
    hz = [m.frequency_hz for m in result.modes]
    np.testing.assert_array_equal(data["frequency_hz"], hz)
    assert data["mode_name"].tolist() == [m.name for m in result.modes]
    np.testing.assert_array_equal(data["x"], result.x)
    for k, mode in enumerate(result.modes):
        shape = data["Y" if mode.family == "bending" else "X"][:, k]
        np.testing.assert_array_equal(shape, mode.shape)
        assert np.all(np.isnan(data["X" if mode.family == "bending" else "Y"][:, k]))
    assert "mass_per_length" in data["stations"].dtype.names


@pytest.mark.parametrize("name", NAMES)
def test_paraview(name, tmp_path):
    result = written(name, tmp_path / "modes.vtu")
    mesh = meshio.read(tmp_path / "modes.vtu")
    np.testing.assert_array_equal(mesh.points[:, 0], result.x)
    (cells,) = mesh.cells
    assert cells.type == "line"
    assert np.all(np.diff(result.x[cells.data], axis=1) > 0)
    for mode in result.modes:
        key = f"{array_name(mode)} [m]"
        column = 1 if mode.family == "bending" else 0
        np.testing.assert_array_equal(mesh.point_data[key][:, column], mode.shape)
    beam = result.beam
    mass = mesh.cell_data["mass_per_length [kg/m]"][0] @ np.diff(result.x[cells.data], axis=1)
    points = sum(getattr(item, "mass", 0.0) for item in beam.attachments)
    assert mass[0] == pytest.approx(beam.mass - points, rel=2e-3)


@pytest.mark.parametrize("name", NAMES)
def test_universal_file(name, tmp_path):
    result = written(name, tmp_path / "modes.uff")
    file = pyuff.UFF(str(tmp_path / "modes.uff"))
    sets = file.read_sets()
    kept = [m for m in result.modes if m.omega2 >= 0]
    assert [s["type"] for s in sets] == [164, 15, 82, *[55] * len(kept)]
    assert (sets[0]["units_code"], sets[0]["length"]) == (1, 1.0)
    x = np.array(sets[1]["x"])
    np.testing.assert_allclose(x, np.unique(result.x), rtol=1e-5, atol=1e-9)
    np.testing.assert_array_equal(sets[2]["nodes"], sets[1]["node_nums"])
    first = np.append([True], np.diff(result.x) > 0)
    for mode, data in zip(kept, sets[3:], strict=True):
        assert data["freq"] == pytest.approx(mode.frequency_hz, rel=1e-5)
        assert data["modal_m"] == pytest.approx(mode.modal_mass, rel=1e-5)
        assert data["id1"].strip() == mode.name
        component = data["r2" if mode.family == "bending" else "r1"]
        np.testing.assert_allclose(component, mode.shape[first], rtol=1e-5, atol=1e-9)


def test_netcdf_and_json(tmp_path):
    result = written("starter", tmp_path / "modes.nc")
    with xr.open_dataset(tmp_path / "modes.nc", engine="h5netcdf") as data:
        np.testing.assert_array_equal(data.omega2, [m.omega2 for m in result.modes])
    written("starter", tmp_path / "modes.json")
    modes = json.loads((tmp_path / "modes.json").read_text())["modes"]
    assert [m["omega2"] for m in modes] == [m.omega2 for m in result.modes]


def test_workbook(tmp_path):
    result = written("starter", tmp_path / "modes.xlsx")
    book = openpyxl.load_workbook(tmp_path / "modes.xlsx")
    rows = list(book["modes"].iter_rows(values_only=True))
    column = rows[0].index("omega2 [rad^2/s^2]")
    omega2 = [row[column] for row in rows[1:]]
    np.testing.assert_allclose(omega2, [m.omega2 for m in result.modes], rtol=1e-15)
    shapes = np.array(list(book["Y"].iter_rows(min_row=2, values_only=True)))
    np.testing.assert_allclose(shapes[:, 0], result.x, rtol=1e-15)
    np.testing.assert_allclose(shapes[:, 1], result.modes[0].shape, rtol=1e-15)


def test_an_unknown_ending_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"allowed are \.csv, \.json, \.nc, \.xlsx"):
        check_modal_output(tmp_path / "modes.doc")
