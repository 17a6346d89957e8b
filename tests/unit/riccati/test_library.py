"""The file of compiled code: made once, by whoever comes first, and made anew when damaged."""

import subprocess
import sys
import time
from pathlib import Path

import pytest

import antinode as an
from antinode.modes import backends
from antinode.riccati.lanes import library


@pytest.fixture
def made(monkeypatch, tmp_path):
    """An empty folder for the code; "compiling" copies what this process has loaded."""
    code, built = library._code("roots"), []

    def build(_part, target):
        built.append(target)
        Path(target).write_bytes(code)

    monkeypatch.setenv("ANTINODE_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(library, "_build", build)
    return built


def test_it_is_made_once(made, tmp_path):
    code = library._code("roots")
    assert library._code("roots") == code
    assert len(made) == 1
    assert [path.suffix for path in sorted(tmp_path.iterdir())] == [".bin", ".lock"]


@pytest.mark.parametrize(
    "spoil", [lambda b: b[:-9], lambda b: b"", lambda b: b[:99] + b"x" + b[99:]]
)
def test_a_damaged_file_is_made_anew(made, tmp_path, spoil):
    code = library._code("roots")
    (file,) = tmp_path.glob("*.bin")
    file.write_bytes(spoil(file.read_bytes()))
    assert library._code("roots") == code
    assert len(made) == 2
    assert library._read(file) == code


def test_every_part_has_a_file_of_its_own(made, tmp_path):
    library._code("roots")
    library._code("shapes")
    names = [path.name.split("-")[1] for path in sorted(tmp_path.glob("*.bin"))]
    assert names == ["roots", "shapes"]
    assert len(made) == 2


def test_other_sources_and_processors_have_files_of_their_own(monkeypatch):
    key = library._key()
    monkeypatch.setattr(library.platform, "python_version", lambda: "9.9.9")
    assert library._key() != key


def test_a_folder_that_is_not_writable_is_passed_over(made, monkeypatch, tmp_path):
    """A file where the folder should be: not even the owner of everything can write there."""
    wrong, right = tmp_path / "file", tmp_path / "folder"
    wrong.write_text("")
    monkeypatch.setattr(library, "_folders", lambda: iter((wrong / "sub", right)))
    library._code("roots")
    assert [path.suffix for path in sorted(right.iterdir())] == [".bin", ".lock"]
    assert len(made) == 1


def test_a_folder_that_the_user_chose_must_be_writable(made, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ANTINODE_CACHE_DIR", str(tmp_path / "file" / "sub"))
    with pytest.raises(library.LibraryError, match="ANTINODE_CACHE_DIR"):
        library._code("roots")


def test_a_compiler_that_fails_is_told_in_a_sentence(monkeypatch, tmp_path):
    monkeypatch.setenv("ANTINODE_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(library, "_loaded", {})
    monkeypatch.setattr(library, "__package__", "antinode.no_such_room")
    with pytest.raises(an.ComputationError, match="could not be compiled") as error:
        backends.choose("numba")
    assert "No module named" in str(error.value)
    assert 'backend="numpy"' in str(error.value)
    assert not list(tmp_path.glob("*.bin"))


def test_what_takes_long_is_told(made, monkeypatch, capfd):
    build = library._build
    monkeypatch.setattr(library, "_build", lambda *asked: (time.sleep(0.2), build(*asked)))
    monkeypatch.setattr(library, "_PATIENCE", 0.0)
    library._code("roots")
    told = capfd.readouterr().err.splitlines()
    assert "compiling" in told[0]
    assert "compiled the batch kernel in" in told[-1]


def test_what_is_quick_is_not_told(made, capfd):
    library._code("roots")
    assert capfd.readouterr().err == ""


TOGETHER = """
import sys, time
from pathlib import Path
from antinode.riccati.lanes import library

code = library._code("roots")
folder = Path(sys.argv[1])
library._folders = lambda: iter((folder,))

def build(_part, target):
    with (folder / "built").open("a") as log:
        log.write("once ")
    time.sleep(0.5)
    Path(target).write_bytes(code)

library._build = build
while not (folder / "go").exists():
    time.sleep(0.01)
assert library._code("roots") == code
"""


def test_processes_that_start_together_make_it_once(tmp_path):
    command = [sys.executable, "-c", TOGETHER, str(tmp_path)]
    running = [subprocess.Popen(command) for _ in range(4)]
    (tmp_path / "go").touch()
    assert [process.wait() for process in running] == [0] * 4
    assert (tmp_path / "built").read_text() == "once "


def test_a_small_problem_is_solved_before_anything_is_compiled(tmp_path):
    """`antinode beam` on a fresh install: by numpy, openly."""
    beam = tmp_path / "beam.toml"
    beam.write_text(
        "[beam]\nstations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1] }\n"
    )
    code = f"from antinode.cli import main; main(['beam', {str(beam)!r}])"
    environment = {"ANTINODE_CACHE_DIR": str(tmp_path / "cache"), "PYTHONPATH": ":".join(sys.path)}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert not (tmp_path / "cache").exists()


def test_the_choice_goes_by_size():
    assert backends.for_one(100, 6) == "numpy"
    assert backends.for_one(3000, 20) == "numba"
