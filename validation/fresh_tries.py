"""Tries of someone who does not know the code and wants it to fail: what antinode says to each.

    python validation/fresh_tries.py [--write]

`fresh_tries.txt` has one a line: what must happen (refused, or accepted: somebody looked), what is
tried on, and the try itself as JSON texts. A beam file, a table, a study, a response, a column that
may flutter, a drawing is spoilt in one place; inputs are added to a study of a beam file; a command
line is given; a line of Python is run. A refusal is one sentence without a traceback.
With --write the verdicts are written anew, to be looked at.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import shlex
import sys
import tempfile
import warnings
from collections import Counter
from pathlib import Path

import antinode as an
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.axial import AxialLoads, PointForce, apply_loads
from antinode.cli import main as antinode

TRIES = Path(__file__).with_suffix(".txt")
BEAM = """[beam]
name = "b"
interpolation = "linear"
stations = { x = [0, 2, 4], mass_per_length = [10, 8, 6], bending_stiffness = [4e4, 3e4, 2e4], \
axial_stiffness = [4e7, 3e7, 2e7], axial_force = [100, 50, 0] }
[beam.ends]
left = "clamped"
[[beam.point_masses]]
x = 4
mass = 5
[[beam.springs]]
x = 2
translational = 1000
[beam.loads]
gravity = -9.81
[solve]
modes = 2
"""
TABLE = "x [m],mass_per_length [kg/m],bending_stiffness [N m^2]\n0,10,4e4\n2,8,3e4\n4,8,3e4\n"
STUDY = 'case = "case.toml"\nsolve.modes = 2\n'
MAST = 'case = "b.toml"\nsolve.modes = 2\n'
COLUMN = """[beam]
stations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1], \
axial_force = [1, 1] }
[beam.ends]
left = "clamped"
right_follower = 0.8
"""
DRAWING = """[beam]
interpolation = "linear"
stations = { x = [0, 2], outer_diameter = ["40 mm", "60 mm"], wall = ["3 mm", "3 mm"] }
[beam.material]
youngs_modulus = "210 GPa"
density = "7850 kg/m^3"
[beam.ends]
left = "clamped"
"""
RESPONSE = """[response]
of = "b.toml"
kind = "harmonic"
[damping]
loss_factor = 0.02
[frequency]
from = "1 Hz"
to = "50 Hz"
points = 10
[[forces]]
x = 4
amplitude = "1 N"
[[outputs]]
x = 4
quantity = "displacement"
"""
NOISE = "Traceback", "pydantic", "bug in antinode", "Value error"


def command(*arguments: str) -> tuple[int, str]:
    """Run antinode; return exit code and what it says on stderr but for progress."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            antinode(list(arguments))
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 1
    said = [line for line in err.getvalue().splitlines() if line.startswith("antinode: ")]
    return code, "\n".join(line for line in said if "compil" not in line)


def spoilt(name: str, text: str, old: str, new: str) -> tuple[int, str]:
    count = -1 if old == "," else 1
    Path(name).write_text(text.replace(old, new, count), encoding="utf-8")
    return command("beam", name)


def studied(text: str, line: str) -> tuple[int, str]:
    Path("s.toml").write_text(text if text.startswith("#raw") else STUDY + text, encoding="utf-8")
    name, *more = shlex.split(line) or ["sweep"]
    return command(name, "s.toml", *more)


def changed(name: str, text: str, old: str, new: str, *more: str) -> tuple[int, str]:
    """Run a command on a file that is spoilt in one place."""
    assert old in text, old
    Path("f.toml").write_text(text.replace(old, new, 1), encoding="utf-8")
    return command(name, "f.toml", *more)


def python(line: str) -> tuple[int, str]:
    beam = an.Beam.from_stations([0, 1], 1.0, 1.0)
    known = {**vars(an), "an": an, "b": beam, "B": an.Beam.from_stations, "E": an.Ends}
    known |= {"PointMass": PointMass, "Spring": Spring, "Joint": Joint, "np": __import__("numpy")}
    known |= {"AxialLoads": AxialLoads, "PointForce": PointForce, "apply_loads": apply_loads}
    try:
        eval(line, known)
    except an.AntinodeError as error:
        return error.exit_code, f"antinode: {error}"
    except (AttributeError, TypeError, ValueError) as error:  # what Python says of any object
        return 3, f"antinode: {error}"
    return 0, ""


def verdict(kind: str, cells: list[str]) -> str:
    """Return "accepted", "refused", or what is wrong with the refusal."""
    if kind == "beam file":
        code, said = spoilt("t.toml", BEAM, *cells)
    elif kind == "table":
        code, said = spoilt("t.csv", TABLE, *cells)
    elif kind == "study":
        code, said = studied(*cells)
    elif kind == "response":
        code, said = changed("response", RESPONSE, *cells)
    elif kind == "stability":
        code, said = changed("stability", COLUMN, *cells)
    elif kind == "drawing":
        code, said = changed("beam", DRAWING, *cells)
    elif kind == "beam study":
        code, said = changed("sweep", MAST + cells[0], "solve.modes = 2", "solve.modes = 2")
    elif kind == "python":
        code, said = python(*cells)
    else:
        code, said = command(*shlex.split(cells[0]))
    if code == 0:
        return "accepted"
    clear = 20 < len(said) < 700 and "\n" not in said and not any(n in said for n in NOISE)
    return "refused" if clear else f"unclear ({code}): {said[:200]}"


def tries() -> list[tuple[str, str, list[str]]]:
    """Return what must happen, on what, and the try."""
    found = []
    for line in TRIES.read_text("utf-8").splitlines():
        wanted, kind, *cells = line.split("\t")
        found.append((wanted, kind, [json.loads(cell) for cell in cells]))
    return found


def run(chosen: list[tuple[str, str, list[str]]]) -> list[str]:
    """Try; return the verdicts."""
    found, here = [], Path.cwd()
    with tempfile.TemporaryDirectory() as name, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        os.chdir(name)
        try:
            command("init", ".")
            command("init", "--beam", ".")
            Path("b.toml").write_text(BEAM, encoding="utf-8")
            found = [verdict(kind, cells) for _, kind, cells in chosen]
        finally:
            os.chdir(here)
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true")
    write = parser.parse_args().write
    chosen = tries()
    found = run(chosen)
    wrong = 0
    for (wanted, kind, cells), got in zip(chosen, found, strict=True):
        if got != wanted:
            wrong += 1
            print(f"{kind} {cells}: wanted {wanted}, got {got}")
    for (kind, got), n in sorted(
        Counter(zip((k for _, k, _ in chosen), found, strict=True)).items()
    ):
        print(f"{kind}: {n} {got}")
    if write:
        rows = zip(chosen, found, strict=True)
        text = ("\t".join([got, k, *map(json.dumps, cells)]) for (_, k, cells), got in rows)
        TRIES.write_text("\n".join(text) + "\n", "utf-8")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
