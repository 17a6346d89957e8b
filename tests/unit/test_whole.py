"""Only plain files are replaced; links, pipes and files of several names are written through."""

import os
import subprocess
import sys
import threading

import pytest

from antinode.whole import write_file
from cli_run import refused, run


def text(content):
    return lambda path: path.write_text(content)


@pytest.fixture
def tower(tmp_path):
    assert run("init", tmp_path, "--example", "tower").code == 0
    return tmp_path / "beam.toml"


def test_a_plain_file_is_replaced_and_keeps_its_mode(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")
    path.chmod(0o640)
    before = path.stat().st_ino
    write_file(path, text("new"))
    assert path.read_text() == "new"
    assert path.stat().st_mode & 0o777 == 0o640
    assert path.stat().st_ino != before
    assert os.listdir(tmp_path) == ["a.txt"]


def test_what_fails_leaves_what_stood_there(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")

    def half(partial):
        partial.write_text("ne")
        raise OSError("full")

    with pytest.raises(OSError, match="full"):
        write_file(path, half)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_a_link_stays_a_link(tmp_path):
    other = tmp_path / "there"
    other.mkdir()
    (other / "real.txt").write_text("old")
    link = tmp_path / "link.txt"
    link.symlink_to(other / "real.txt")
    write_file(link, text("new"))
    assert link.is_symlink()
    assert (other / "real.txt").read_text() == "new"
    dangling = tmp_path / "dangling.txt"
    dangling.symlink_to(other / "born.txt")
    write_file(dangling, text("new"))
    assert dangling.is_symlink()
    assert (other / "born.txt").read_text() == "new"


def test_all_names_of_a_file_see_the_new_one(tmp_path):
    path, other = tmp_path / "a.txt", tmp_path / "b.txt"
    path.write_text("old")
    os.link(path, other)
    write_file(path, text("new"))
    assert other.read_text() == "new"


def test_a_pipe_stays_a_pipe(tmp_path, tower):
    pipe = tmp_path / "out.csv"
    os.mkfifo(pipe)
    found = []
    reader = threading.Thread(target=lambda: found.append(pipe.read_text()))
    reader.start()
    ended = run("beam", tower, "--modes", "1", "-o", pipe)
    reader.join(timeout=120)
    assert ended.code == 0
    assert pipe.is_fifo()
    assert found[0].startswith("family,number,name")


@pytest.mark.parametrize("redirected", ["pipe", "file"])
def test_standard_output(redirected, tmp_path, tower):
    command = [
        sys.executable,
        "-m",
        "antinode",
        "convert",
        str(tower),
        "/dev/stdout",
        "--to",
        "toml",
    ]
    kind = os.stat("/dev/stdout").st_mode
    if redirected == "pipe":
        out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    else:
        with (tmp_path / "out.txt").open("w") as file:
            subprocess.run(command, stdout=file, check=True)
        out = (tmp_path / "out.txt").read_text()
    assert out.startswith("[beam]")
    assert os.stat("/dev/stdout").st_mode == kind


def test_a_device_is_written_to_and_stays(tower):
    before = os.stat("/dev/null")
    assert run("convert", tower, "/dev/null", "--to", "csv").code == 0
    assert os.path.samestat(before, os.stat("/dev/null"))


def test_what_cannot_be_written_is_one_sentence(tmp_path, tower):
    loop = tmp_path / "loop.toml"
    loop.symlink_to(loop)
    refused(run("convert", tower, loop), "cannot be written")
