"""Results as files: strict JSON, CSV with units, NetCDF; whole or not at all."""

import csv
import io
import json
import math

import numpy as np
import pytest

from antinode import InputError, solve_modes
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.beam.families import FAMILIES
from antinode.extras import import_extra
from antinode.show.tables import modal_table
from antinode.show.writing import check_output, to_json, write_result


@pytest.fixture(scope="module")
def result():
    """Modes of a free-free bar and beam in compression: rigid, divergent and elastic ones."""
    x, one = np.linspace(0, 1, 4), np.ones(4)
    beam = Beam.from_stations(x, one, one, 1e4 * one, 5 * one, ends=Ends(), name="bar")
    return solve_modes(beam, 3, unloaded=True)


class TestJson:
    def test_null_stands_for_what_is_not_finite(self):
        data = {"a": [math.nan, math.inf, -math.inf, 1.5], "b": {"c": np.float64("nan")}}
        assert json.loads(to_json(data)) == {"a": [None, None, None, 1.5], "b": {"c": None}}

    def test_numpy_becomes_plain(self):
        data = {
            "array": np.array([[1.0, np.nan], [3.0, 4.0]]),
            "integer": np.int64(3),
            "flag": np.bool_(True),
            "tuple": (1, "é", None, True),
            3: "key",
        }
        plain = json.loads(to_json(data))
        assert plain["array"] == [[1.0, None], [3.0, 4.0]]
        assert plain["integer"] == 3
        assert plain["flag"] is True
        assert plain["tuple"] == [1, "é", None, True]
        assert plain["3"] == "key"

    def test_numbers_keep_all_digits(self):
        assert json.loads(to_json([0.1, 1 / 3, 1e-300, 2.0**60])) == [0.1, 1 / 3, 1e-300, 2.0**60]

    def test_what_json_does_not_have_is_an_error(self):
        with pytest.raises(TypeError):
            to_json({"a": object()})


class TestTable:
    def test_one_row_a_mode_with_units_in_the_header(self, result):
        rows = list(csv.DictReader(io.StringIO(modal_table(result))))
        assert [row["name"] for row in rows] == [mode.name for mode in result.modes]
        for row, mode in zip(rows, result.modes, strict=True):
            assert float(row["omega2 [rad^2/s^2]"]) == mode.omega2
            if mode.kind == "divergent":
                assert row["frequency_hz [Hz]"] == ""
                assert float(row["growth_rate_per_s [1/s]"]) == mode.growth_rate_per_s
            else:
                assert float(row["frequency_hz [Hz]"]) == mode.frequency_hz


class TestDataset:
    def test_every_number_has_its_unit(self, result):
        data = result.to_dataset()
        for name, variable in data.variables.items():
            if variable.dtype.kind == "f":
                assert "units" in variable.attrs, name
        assert data.attrs["title"] == "Natural modes of bar"

    def test_shapes_are_those_of_the_modes(self, result):
        data = result.to_dataset()
        for k, mode in enumerate(result.modes):
            for i, (symbol, *_) in enumerate(FAMILIES[mode.family].quantities):
                assert np.array_equal(data[symbol].values[k], mode.states[:, i])
        assert np.isnan(data["X"].sel(mode="bending 1")).all()

    def test_there_and_back_through_a_file(self, result, tmp_path):
        import xarray

        path = tmp_path / "modes.nc"
        write_result(path, {}, str, result.to_dataset)
        with xarray.open_dataset(path, engine="h5netcdf") as read:
            xarray.testing.assert_identical(read.load(), result.to_dataset())


class TestWriting:
    def test_a_failure_leaves_the_old_file_and_nothing_else(self, tmp_path):
        path = tmp_path / "x.csv"
        path.write_text("old")

        def fails():
            raise OSError(28, "No space left on device")

        with pytest.raises(InputError, match="No space left on device"):
            write_result(path, {}, fails, fails)
        assert [p.name for p in tmp_path.iterdir()] == ["x.csv"]
        assert path.read_text() == "old"

    def test_a_bug_while_writing_leaves_nothing_either(self, tmp_path):
        def fails(path):
            path.write_text("half")
            raise RuntimeError

        class Half:
            def to_netcdf(self, path, engine):
                fails(path)

        with pytest.raises(RuntimeError):
            write_result(tmp_path / "x.nc", {}, str, Half)
        assert list(tmp_path.iterdir()) == []

    @pytest.mark.parametrize(
        ("name", "words"),
        [
            ("x", "the ending"),
            ("x.xlsx", "allowed are .csv, .json, .nc"),
            ("no/x.csv", "there is no folder"),
            ("folder.csv", "this is a folder"),
            ("file/x.csv", "there is no folder"),
            ("x" * 300 + ".csv", "too long"),
            ("table.csv", "an input"),
        ],
    )
    def test_a_bad_name_is_refused_beforehand(self, tmp_path, name, words):
        (tmp_path / "folder.csv").mkdir()
        (tmp_path / "file").write_text("")
        (tmp_path / "table.csv").write_text("x [m],mass_per_length [kg/m]\n0,1\n1,1\n")
        with pytest.raises(InputError) as refusal:
            check_output(tmp_path / name, (".csv", ".json", ".nc"))
        assert words in str(refusal.value)

    def test_endings_in_capitals_are_known(self, tmp_path):
        write_result(tmp_path / "X.JSON", {"a": 1}, str, dict)
        assert json.loads((tmp_path / "X.JSON").read_text()) == {"a": 1}


def test_a_missing_library_names_the_command_that_adds_it():
    with pytest.raises(InputError, match=r"pip install 'antinode\[dataset\]'"):
        import_extra("no_such_library", "dataset")
