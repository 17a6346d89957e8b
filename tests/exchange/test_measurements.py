"""Measured modes and frequency responses become observations that identify takes."""

import json
import math
import tomllib

import numpy as np
import pytest
import pyuff

from antinode import InputError
from antinode.exchange.outputs import Modes, write_modes
from antinode.exchange.uff.frf import find_modes
from antinode.exchange.uff.reader import read_measurements
from antinode.exchange.units import MM_T_S
from antinode.study.identify.file import ObservationRow, load_identification
from cli_run import refused, run
from exchange.conversions import solved

HZ = np.array([12.0, 31.5, 58.3])
ZETA = np.array([0.004, 0.008, 0.005])
PLACES = np.linspace(0, 3, 7)


def shapes():
    """Three shapes at seven places."""
    return np.cos(np.outer(PLACES / 3 * np.pi, [1, 2, 3]))


def responses(f, noise=0.0, seed=0):
    """Displacements of all places by a force at the first one, with noise of the largest."""
    s, w = 2j * np.pi * f[:, None], 2 * np.pi * HZ
    H = (shapes()[0] / (w**2 + 2 * ZETA * w * s + s**2)) @ shapes().T
    rng = np.random.default_rng(seed)
    e = rng.normal(size=(2, *H.shape))
    return H + noise * np.max(np.abs(H), axis=0) * (e[0] + 1j * e[1]) / math.sqrt(2)


def write_frf(path, f, H, kind=8, binary=0, **more):
    """Write responses by pyuff, with their nodes."""
    file = pyuff.UFF(str(path))
    n = len(PLACES)
    file.write_sets(
        pyuff.prepare_15(
            node_nums=list(range(1, n + 1)), def_cs=[0] * n, disp_cs=[0] * n, color=[8] * n,
            x=list(PLACES), y=[0.0] * n, z=[0.0] * n,
        ), "overwrite",
    )  # fmt: skip
    for k in range(n):
        data = {
            "type": 58, "func_type": 4, "rsp_node": k + 1, "rsp_dir": 2, "ref_node": 1,
            "ref_dir": 2, "data": H[:, k], "x": f, "id1": "response", "rsp_ent_name": "NONE",
            "ref_ent_name": "NONE", "binary": binary, "ordinate_spec_data_type": kind,
            "abscissa_spec_data_type": 18, "orddenom_spec_data_type": 13, **more,
        }  # fmt: skip
        file.write_sets(data, "add")


def checked(rows):
    """The rows, as identify's model takes them."""
    return [ObservationRow.model_validate(row) for row in rows]


@pytest.mark.parametrize("name", ["starter", "everything"])
def test_our_own_modes_come_back(name, tmp_path):
    result = solved(name)
    write_modes(tmp_path / "modes.uff", Modes(result, {}))
    (row,), _ = read_measurements(tmp_path / "modes.uff")
    checked([row])
    for family in ("bending", "longitudinal"):
        np.testing.assert_allclose(row[family], result.frequencies_hz(family), rtol=1e-5)
    for shape in row["shapes"]:
        x, family, number = np.array(shape["x"]), shape["family"], shape["number"]
        index = [m.number for m in result.family(family)].index(number)
        wanted = result.at(np.clip(x, *result.beam.x[[0, -1]]), family)[:, index, 0]
        u = np.array(shape["displacement"])
        assert (u @ wanted) ** 2 / (u @ u) / (wanted @ wanted) > 0.99


def complex_modes(path):
    """Complex modes along z, written by pyuff: bending in x, one in y, one along z, one rigid."""
    file = pyuff.UFF(str(path))
    nodes = np.arange(1, 6)
    z = np.linspace(0, 4000, 5)
    file.write_sets(
        {"type": 2411, "node_nums": nodes, "def_cs": np.zeros(5), "disp_cs": np.zeros(5),
         "color": np.zeros(5), "x": np.zeros(5), "y": np.zeros(5), "z": z},
        "overwrite",
    )  # fmt: skip
    bump = np.sin(np.pi * z / 4000)
    for number, (hz, component) in enumerate([(0.0, 0), (20.0, 0), (25.0, 1), (90.0, 2)], 1):
        parts = [np.zeros(5, dtype=complex) for _ in range(3)]
        parts[component] = bump * np.exp(0.7j)
        lam = 2 * np.pi * hz * (-0.01 + 1j * math.sqrt(1 - 1e-4))
        data = pyuff.prepare_55(
            model_type=1, analysis_type=3, data_ch=2, spec_data_type=8, load_case=1,
            mode_n=number, eig=complex(lam), modal_a=1 + 0j, modal_b=1 + 0j,
            r1=parts[0], r2=parts[1], r3=parts[2], node_nums=nodes,
            data_type=5, n_data_per_node=3,
        )  # fmt: skip
        file.write_sets(data, "add")


def test_complex_modes_along_another_axis_in_millimetres(tmp_path):
    complex_modes(tmp_path / "m.unv")
    (row,), notes = read_measurements(tmp_path / "m.unv", MM_T_S)
    assert row["bending"] == pytest.approx([20.0], rel=1e-5)
    assert row["longitudinal"] == pytest.approx([90.0], rel=1e-5)
    assert [s["x"] for s in row["shapes"]] == [[0, 1, 2, 3, 4]] * 2
    u = np.array(row["shapes"][0]["displacement"])
    np.testing.assert_allclose(u / u[2], np.sin(np.pi * np.arange(5) / 4), atol=1e-5)
    assert any("rigid" in note for note in notes)
    assert any("other plane" in note for note in notes)
    (row,), _ = read_measurements(tmp_path / "m.unv", MM_T_S, 2)
    assert row["bending"] == pytest.approx([25.0], rel=1e-5)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")  # pyuff's writer
@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.parametrize("kind", [8, 11, 12])
@pytest.mark.parametrize("binary", [0, 1])
def test_frequency_responses_become_rows(kind, binary, tmp_path):
    f = np.arange(0, 80, 0.05)
    H = responses(f) * (2j * np.pi * f[:, None]) ** {8: 0, 11: 1, 12: 2}[kind]
    write_frf(tmp_path / "frf.uff", f, H, kind, binary)
    rows, notes = read_measurements(tmp_path / "frf.uff")
    assert "3 modes from 7 frequency responses" in notes[-1]
    for k, row in enumerate(checked(rows)):
        assert row.bending[:k] == (None,) * k
        assert row.bending[k] == pytest.approx(HZ[k], abs=max(4 * row.sd, 1e-6 * HZ[k]))
        assert row.sd < 1e-3 * HZ[k]
        (shape,) = row.shapes
        u, wanted = np.array(shape.displacement), shapes()[:, k]
        assert (u @ wanted) ** 2 / (u @ u) / (wanted @ wanted) > 0.99


def test_the_stated_uncertainty_is_that_of_the_frequencies():
    f = np.arange(1, 80, 0.05)
    ratios = []
    for seed in range(6):
        peaks = find_modes(f, responses(f, 0.01, seed))
        assert len(peaks) == 3
        ratios += [(p.frequency_hz - hz) / p.sd_hz for p, hz in zip(peaks, HZ, strict=True)]
    assert 0.2 < np.sqrt(np.mean(np.square(ratios))) < 1.5
    assert np.max(np.abs(ratios)) < 4


def test_close_modes_widen_the_stated_uncertainty():
    f = np.arange(5, 20, 0.02)
    s = 2j * np.pi * f[:, None]
    w = 2 * np.pi * np.array([12.0, 12.6])
    H = (np.array([1, 1]) / (w**2 + 0.012 * w * s + s**2)) @ np.array([[1, 1], [1, -1]])
    for peak, hz in zip(find_modes(f, H), [12.0, 12.6], strict=True):
        assert abs(peak.frequency_hz - hz) < max(3 * peak.sd_hz, 1e-3)


def test_noise_alone_has_no_modes():
    f = np.arange(1, 40, 0.1)
    rng = np.random.default_rng(3)
    H = rng.normal(size=(len(f), 3)) + 1j * rng.normal(size=(len(f), 3))
    assert find_modes(f, H) == ()


@pytest.mark.parametrize("ending", ["toml", "csv", "json"])
def test_convert_writes_what_identify_reads(ending, tmp_path):
    f = np.arange(0, 80, 0.1)
    write_frf(tmp_path / "frf.uff", f, responses(f, 1e-3))
    out = tmp_path / f"observed.{ending}"
    ended = run("convert", tmp_path / "frf.uff", out)
    assert ended.code == 0, ended
    assert ended.err.endswith(f"wrote {out}\n")
    if ending == "csv":
        run("init", tmp_path)
        (tmp_path / "identify.toml").write_text(
            'case = "case.toml"\nobservations = "observed.csv"\n'
            '[[parameters]]\nkey = "vehicle.cavitator.diameter"\n'
        )
        rows = load_identification(tmp_path / "identify.toml").observations
    else:
        read = tomllib.loads if ending == "toml" else json.loads
        rows = checked(read(out.read_text())["observations"])
    for k, row in enumerate(rows):
        assert row.bending[k] == pytest.approx(HZ[k], abs=5 * row.sd)
        assert bool(row.shapes) == (ending != "csv")


class TestRefusals:
    def test_a_beam_cannot_come_of_measurements(self, tmp_path):
        write_modes(tmp_path / "m.uff", Modes(solved("starter"), {}))
        refused(run("convert", tmp_path / "m.uff", tmp_path / "m.bdf"), "observations", "nastran")

    def test_neither_modes_nor_responses(self, tmp_path):
        path = tmp_path / "m.uff"
        path.write_text(
            "    -1\n    15\n         1         0         0         8  1.0 0.0 0.0\n    -1\n"
        )
        refused(run("convert", path, tmp_path / "o.csv"), "neither modes")

    def test_no_universal_file(self, tmp_path):
        path = tmp_path / "m.uff"
        path.write_text("x,y\n1,2\n")
        refused(run("convert", path, tmp_path / "o.csv"), str(path), "universal file")

    def test_different_lines(self, tmp_path):
        f = np.arange(1, 20, 0.1)
        write_frf(tmp_path / "a.uff", f, responses(f))
        write_frf(tmp_path / "b.uff", f[:-5], responses(f[:-5]))
        text = (tmp_path / "a.uff").read_text() + (tmp_path / "b.uff").read_text()
        (tmp_path / "c.uff").write_text(text)
        with pytest.raises(InputError, match="different lines"):
            read_measurements(tmp_path / "c.uff")
