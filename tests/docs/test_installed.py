"""What is released works where there is no clone: built, checked, installed, run."""

import os
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def run(*command, where, **more):
    """Run a command outside the clone, without its paths; return what it printed."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "VIRTUAL_ENV"))}
    done = subprocess.run(
        [str(part) for part in command],
        cwd=where,
        env=kept | more,
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """The wheel and the source archive, built by this interpreter's hatchling."""
    pytest.importorskip("hatchling")
    folder = tmp_path_factory.mktemp("dist")
    run(sys.executable, "-m", "hatchling", "build", "-d", folder, where=ROOT)
    return folder


def test_both_archives_are_as_an_index_wants_them(built):
    pytest.importorskip("twine")
    said = run(sys.executable, "-m", "twine", "check", "--strict", *built.iterdir(), where=built)
    assert said.count("PASSED") == 2


def test_the_wheel_holds_the_package_alone_with_its_data(built):
    (wheel,) = built.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0].split("-")[0] for name in names} == {"antinode"}
    for wanted in ("py.typed", "show/antinode.mplstyle", "examples/starter/case.toml"):
        assert f"antinode/{wanted}" in names


def test_it_runs_where_there_is_no_clone(built, tmp_path):
    (wheel,) = built.glob("*.whl")
    home = tmp_path / "env"
    venv.create(home, with_pip=False)
    scripts = home / ("Scripts" if os.name == "nt" else "bin")
    python = next(path for path in scripts.iterdir() if path.stem == "python")
    site = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))",
                    where=tmp_path).strip())  # fmt: skip
    zipfile.ZipFile(wheel).extractall(site)
    libraries = f"import site; site.addsitedir({sysconfig.get_path('purelib')!r})\n"
    (site / "libraries.pth").write_text(libraries)
    work = tmp_path / "work"
    work.mkdir()
    where = {"where": work, "XDG_CACHE_HOME": str(tmp_path / "cache")}
    home_of = run(python, "-c", "import antinode; print(antinode.__file__)", **where)
    assert Path(home_of.strip()).is_relative_to(site)
    run(python, "-m", "antinode", "init", "demo", **where)
    said = run(python, "-m", "antinode", "modes", "demo/case.toml", "--plot", "m.png", **where)
    assert "bending 1" in said
    assert (work / "m.png").stat().st_size > 10_000
    assert "all checks passed" in run(python, "-m", "antinode", "verify", **where)
