"""Type checkers see the package: a typed script passes under mypy --strict, wrong ones do not."""

import os
import re
import subprocess
import sys
from pathlib import Path

import antinode

TESTS = Path(__file__).resolve().parents[1]
SOURCE = Path(antinode.__file__).parent


def checked(name, folder):
    """What mypy says of a script, as a user without this project's settings runs it."""
    settings = folder / "mypy.ini"
    ignored = ("pandas", "xarray", "pyuff", "openpyxl", "nicegui", "matplotlib", "h5py")
    lines = ["[mypy]\nstrict = true\nfollow_imports = silent\n"]
    lines += [f"[mypy-{module}.*]\nignore_missing_imports = true\n" for module in ignored]
    settings.write_text("\n".join(lines))
    command = [sys.executable, "-m", "mypy", "--config-file", settings, "--cache-dir"]
    command += [TESTS.parent / ".mypy_cache" / "of_tests", TESTS / name]
    where = {**os.environ, "MYPYPATH": str(SOURCE.parent)}
    done = subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, check=False, env=where
    )
    return done.stdout


def test_the_package_says_that_it_is_typed():
    assert (SOURCE / "py.typed").is_file()


def test_a_typed_script_passes(tmp_path):
    said = checked("typed_example.py", tmp_path)
    assert said.startswith("Success"), said


def test_each_wrong_line_is_seen(tmp_path):
    lines = (TESTS / "wrong_example.py").read_text(encoding="utf-8").splitlines()
    wrong = {k for k, line in enumerate(lines, 1) if line.endswith("# wrong")}
    said = checked("wrong_example.py", tmp_path)
    assert {int(n) for n in re.findall(r"wrong_example\.py:(\d+): error", said)} == wrong, said
