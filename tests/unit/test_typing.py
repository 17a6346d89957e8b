"""Type checkers see the package: a typed script passes under mypy --strict, wrong ones do not."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import antinode

TESTS = Path(__file__).resolve().parents[1]
SOURCE = Path(antinode.__file__).parent
TYPED, WRONG = "typed_example.py", "wrong_example.py"


@pytest.fixture(scope="module")
def said(tmp_path_factory):
    """What mypy says of both scripts, as a user without this project's settings runs it."""
    settings = tmp_path_factory.mktemp("typing") / "mypy.ini"
    ignored = ("pandas", "xarray", "pyuff", "openpyxl", "nicegui", "matplotlib", "h5py")
    lines = ["[mypy]\nstrict = true\nfollow_imports = silent\n"]
    lines += [f"[mypy-{module}.*]\nignore_missing_imports = true\n" for module in ignored]
    settings.write_text("\n".join(lines))
    command = [sys.executable, "-m", "mypy", "--config-file", settings, "--cache-dir"]
    command += [TESTS.parent / ".mypy_cache" / "of_tests", TESTS / TYPED, TESTS / WRONG]
    where = {**os.environ, "MYPYPATH": str(SOURCE.parent)}
    done = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, check=False, env=where
    )
    return done.stdout + done.stderr


def test_the_package_says_that_it_is_typed():
    assert (SOURCE / "py.typed").is_file()


def test_a_typed_script_passes(said):
    assert "checked 2 source files" in said, said
    assert TYPED not in said, said


def test_each_wrong_line_is_seen(said):
    lines = (TESTS / WRONG).read_text(encoding="utf-8").splitlines()
    wrong = {k for k, line in enumerate(lines, 1) if line.endswith("# wrong")}
    assert {int(n) for n in re.findall(rf"{WRONG}:(\d+): error", said)} == wrong, said
    assert said.count(": error") == len(wrong), said
