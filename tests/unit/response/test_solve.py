"""A body that grows by itself: said before any number of it, and no verdict."""

import pytest

from cli_run import run

BEAM = """
[beam]
ends = { left = "clamped", right = "free", right_follower = SHARE }
[beam.stations]
x = [0, 1]
mass_per_length = [1, 1]
bending_stiffness = [1, 1]
axial_force = [N, N]
"""
RESPONSE = """
[response]
of = "beam.toml"
kind = "KIND"
[damping]
loss_factor = 0.02
[frequency]
from = "0.2 Hz"
to = "20 Hz"
points = 20
[[forces]]
x = 1
direction = "lateral"
FORCE
[[outputs]]
x = 1
quantity = "displacement"
"""
FORCE = {"harmonic": 'amplitude = "1 N"', "random": 'psd = "psd.csv"'}
EQUIPMENT = '[[equipment]]\nname = "gyro"\nx = 1\nmass = 0.1\nallowed = "allowed.csv"\n'


def asked(folder, N, share, kind, more=""):
    beam = BEAM.replace("N, N", f"{N}, {N}").replace("SHARE", str(share))
    (folder / "beam.toml").write_text(beam)
    text = RESPONSE.replace("KIND", kind).replace("FORCE", FORCE[kind]) + more
    (folder / "response.toml").write_text(text)
    (folder / "psd.csv").write_text("frequency [Hz], psd [N^2/Hz]\n0.1, 1\n30, 1\n")
    (folder / "allowed.csv").write_text("frequency [Hz], amplitude [m/s^2]\n0.1, 1e9\n30, 1e9\n")
    return run("response", folder / "response.toml")


@pytest.mark.parametrize(("kind", "share"), [("harmonic", 0.0), ("random", 1.0)])
def test_what_grows_by_itself_is_said(tmp_path, kind, share):
    ended = asked(tmp_path, 25.0, share, kind)
    assert ended.code == 0
    assert "not stable under its axial force" in " ".join(ended.out.split())
    assert "not stable" not in asked(tmp_path, 2.0, share, kind).out


def test_a_loss_makes_it_flutter_below_the_load_without_one(tmp_path):
    """Beck's column flutters at 20.05; with internal damping from about 11 (Ziegler, 1952)."""
    for N, grows in ((15.0, True), (8.0, False)):
        ended = asked(tmp_path, N, 1.0, "harmonic")
        assert ("dampers and feedback" in " ".join(ended.out.split())) == grows
        assert ended.code == 0
    assert asked(tmp_path, 15.0, 1.0, "harmonic", EQUIPMENT).code == 1


def test_no_verdict_on_what_grows(tmp_path):
    assert asked(tmp_path, 2.0, 0.0, "harmonic", EQUIPMENT).code == 0
    ended = asked(tmp_path, 25.0, 0.0, "harmonic", EQUIPMENT)
    assert ended.code == 1
    assert "no verdict on equipment" in ended.err


def test_the_attitude_of_a_free_body_is_said_and_leaves_the_verdict(tmp_path):
    asked(tmp_path, 2.0, 0.0, "harmonic", EQUIPMENT)
    beam = (tmp_path / "beam.toml").read_text().replace('"clamped"', '"free"')
    (tmp_path / "beam.toml").write_text(beam)
    ended = run("response", tmp_path / "response.toml")
    assert ended.code == 0
    assert "rigid rotation grows at" in " ".join(ended.out.split())
