"""What is released works where there is no clone: built, checked, installed, run."""

import sys
import zipfile
from pathlib import Path

import pytest

from installed import run


def test_both_archives_are_as_an_index_wants_them(installed):
    pytest.importorskip("twine")
    files = installed.archives.iterdir()
    said = run(sys.executable, "-m", "twine", "check", "--strict", *files, where=installed.archives)
    assert said.count("PASSED") == 2


def test_the_wheel_holds_the_package_alone_with_its_data(installed):
    (wheel,) = installed.archives.glob("*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0].split("-")[0] for name in names} == {"antinode"}
    for wanted in ("py.typed", "show/antinode.mplstyle", "examples/starter/case.toml"):
        assert f"antinode/{wanted}" in names


def test_it_runs_where_there_is_no_clone(installed, cold, tmp_path):
    """With the code that it compiled itself, among its own files."""
    python = installed.python
    home_of = run(python, "-c", "import antinode; print(antinode.__file__)", where=tmp_path)
    assert Path(home_of.strip()).is_relative_to(installed.site)
    made = {path.name for path in cold.cache.glob("kernel*.bin")}
    assert made
    assert {path.name for path in cold.cache.glob("kernel*.lock")} == {f"{n}.lock" for n in made}
    run(python, "-m", "antinode", "init", "demo", where=tmp_path)
    said = run(python, "-m", "antinode", "modes", "demo/case.toml", "--plot", "m.png",
               where=tmp_path)  # fmt: skip
    assert "bending 1" in said
    assert (tmp_path / "m.png").stat().st_size > 10_000
    assert "all checks passed" in run(python, "-m", "antinode", "verify", where=tmp_path)
    assert made <= {path.name for path in cold.cache.glob("kernel*.bin")}
    assert len(list(cold.cache.glob("kernel*.bin"))) <= 3  # parts, each made once
