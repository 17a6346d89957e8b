"""Spoilt files end in a result or in one sentence; a missing extra says how to add it."""

import random
import sys
import warnings

import numpy as np
import pytest

from antinode.exchange.outputs import Modes, write_beam, write_modes
from cli_run import refused, run
from exchange.conversions import example, solved
from exchange.test_measurements import responses, write_frf
from exchange.test_nastran import BAR
from exchange.test_sections import BMODES, TOWER

RUNS = 25


def spoilt(content, rng):
    """Bytes with a few pieces cut out, doubled, swapped or replaced."""
    data = bytearray(content)
    for _ in range(rng.randint(1, 4)):
        if not data:
            break
        a = rng.randrange(len(data))
        b = min(len(data), a + rng.choice([1, 1, 2, 8, 60, 2000]))
        kind = rng.randrange(5)
        if kind == 0:
            del data[a:]
        elif kind == 1:
            del data[a:b]
        elif kind == 2:
            data[a:a] = data[a:b]
        elif kind == 3:
            data[a:b] = bytes(rng.randrange(256) for _ in range(b - a))
        else:
            data[a:b] = rng.choice([b"1.e999", b"-1", b"nan", b"inf", b",,", b"\n", b"9" * 40])
    return bytes(data)


def valid(name, folder):
    """A sound file of a format."""
    path = folder / f"sound.{name}"
    if name in ("csv", "xlsx"):
        write_beam(path, example("tower"), name)
    elif name == "bdf":
        path.write_text(BAR)
    elif name == "nas":
        write_modes(path, Modes(solved("shaft"), {}))
    elif name == "dat":
        path.write_text(TOWER)
    elif name == "secs.dat":
        path.write_text(BMODES)
    elif name == "uff":
        write_modes(path, Modes(solved("shaft"), {}))
    else:
        f = np.arange(0, 80, 0.5)
        write_frf(path, f, responses(f))
    return path


@pytest.mark.parametrize("name", ["csv", "xlsx", "bdf", "nas", "dat", "secs.dat", "uff", "unv"])
def test_spoilt_files(name, tmp_path):
    sound = valid(name, tmp_path)
    rng = random.Random(f"{name} 1")
    ending = ".csv" if name in ("uff", "unv") else ".toml"
    done = 0
    for k in range(RUNS):
        path = tmp_path / f"spoilt{k}.{name}"
        path.write_bytes(spoilt(sound.read_bytes(), rng))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ended = run("convert", path, tmp_path / f"out{k}{ending}", "--length", "80m")
        if ended.code == 0:
            done += 1
            assert (tmp_path / f"out{k}{ending}").exists()
        else:
            refused(ended, code=ended.code)
            assert ended.code == 2, ended
            assert not (tmp_path / f"out{k}{ending}").exists()
    assert done < RUNS


@pytest.mark.parametrize(
    ("module", "arguments"),
    [
        ("openpyxl", ["mast.toml", "mast.xlsx"]),
        ("openpyxl", ["mast.xlsx", "mast2.toml"]),
        ("pyuff", ["m.uff", "m.csv"]),
    ],
)
def test_a_missing_extra(module, arguments, tmp_path, monkeypatch):
    write_beam(tmp_path / "mast.toml", example("beam"), "toml")
    write_beam(tmp_path / "mast.xlsx", example("beam"), "xlsx")
    write_modes(tmp_path / "m.uff", Modes(solved("shaft"), {}))
    monkeypatch.setitem(sys.modules, module, None)
    ended = run("convert", *(tmp_path / name for name in arguments))
    refused(ended, module, "pip install 'antinode[exchange]'")


class TestCommand:
    def test_help(self):
        ended = run("convert", "--help")
        assert ended.code == 0
        assert "antinode convert beam.toml beam.bdf" in ended.out

    def test_wrong_requests(self, tmp_path):
        mast = tmp_path / "mast.toml"
        write_beam(mast, example("beam"), "toml")
        refused(run("convert", mast, tmp_path / "a.doc"), "a.doc", "--to")
        refused(run("convert", tmp_path / "a.doc", mast), "a.doc", "--from")
        refused(run("convert", mast, mast), "is the input")
        refused(run("convert", mast, tmp_path / "a.bdf", "--to", "nastan"), "did you mean nastran")
        refused(run("convert", mast, tmp_path / "a", "--to", "sections"), "sections")
        refused(run("convert", mast, tmp_path / "a", "--from", "vtk", "--to", "csv"), "vtk")
        refused(run("convert", mast, tmp_path / "no" / "a.csv"), "no folder")
        refused(run("convert", mast, tmp_path / "a.csv", "--plane", "3"), "--plane 3")
        refused(run("convert", mast, tmp_path / "a.csv", "--units", "inch"), "inch")
        refused(run("convert", tmp_path / "missing.bdf", mast), "no such file")
        refused(run("convert", mast, tmp_path / "a.csv", "--set", "beam.nam=x"), "nam")

    def test_formats_by_name(self, tmp_path):
        mast = tmp_path / "mast.toml"
        write_beam(mast, example("beam"), "toml")
        assert run("convert", mast, tmp_path / "deck.txt", "--to", "nastran").code == 0
        assert (tmp_path / "deck.txt").read_text().endswith("ENDDATA\n")
        back = run("convert", tmp_path / "deck.txt", tmp_path / "b.csv", "--from", "nastran")
        assert back.code == 0
        assert "# interpolation" in (tmp_path / "b.csv").read_text()

    @pytest.mark.parametrize("ending", ["xlsx", "mat", "vtu", "uff", "bdf", "nc", "json", "csv"])
    def test_modes_and_beam_write_them_too(self, ending, tmp_path):
        run("init", tmp_path, "--beam")
        out = tmp_path / f"out.{ending}"
        ended = run("beam", tmp_path / "beam.toml", "--modes", "1", "-o", out)
        assert ended.code == 0, ended
        assert out.stat().st_size > 100
        assert ended.err.endswith(f"wrote {out}\n")
