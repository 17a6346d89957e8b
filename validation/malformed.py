"""Malformed beam and case files: 10,000 of them, and what antinode says to each.

    python validation/malformed.py [--files 10000] [--seed 1]

Takes the examples that ship with antinode and spoils them: bytes flipped, lines dropped, doubled or
swapped, keys misspelt, values replaced by other types, other units, other signs, nan, inf, huge and
tiny numbers. Each file is loaded and solved for one mode. Allowed ends: a result, an input error or
a computation error. A file that is accepted is read a second time by other means: if it still has
an unknown key, or a mass, stiffness or station that no beam can have, the acceptance was wrong.
"""

from __future__ import annotations

import argparse
import collections
import itertools
import math
import random
import signal
import sys
import tempfile
import time
import tomllib
from datetime import UTC, datetime
from pathlib import Path

from antinode import (
    AntinodeError,
    ComputationError,
    InputError,
    load_beam,
    load_case,
    solve_modes,
)
from antinode.inputs.units import to_si

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "src" / "antinode" / "examples"
BEAMS = ("beam", "tower", "rocket", "drill_string", "shaft")
LIMIT = 2.0  # seconds for one file

VALUES = (
    "nan", "inf", "-inf", "0", "-1", "1e400", "-0.0", "1e-320", "1e308", "true", '""', '"abc"',
    '"5 kg"', '"3 parsec"', '"-2 m"', '"1e5"', "[]", "[1]", "{}", "[[1, 2]]", "1979-05-27",
    '"\\u0000"', '"10 deg"', "12", "3.5", '"nofile.csv"', "9" * 400,
    '"1 m; 2"', "[1, nan]", "0x10", "'..'",
)  # fmt: skip
KEYS = {
    "beam", "name", "interpolation", "stations", "x", "mass_per_length", "bending_stiffness",
    "axial_stiffness", "axial_force", "radius_of_gyration", "ends", "left", "right", "left_axial",
    "right_axial", "point_masses", "mass", "rotary_inertia", "offset", "springs", "translational",
    "rotational", "axial", "joints", "loads", "gravity", "acceleration", "point_forces", "force",
    "offset_weight", "masses", "burns", "solve", "modes", "tolerance", "vehicle", "cavitator",
    "diameter", "fins", "roll_angles", "tip_radius", "thickness", "lift_slope", "chord", "position",
    "deflection", "condition", "speed", "cavitation_number", "depth", "cavity_pressure",
    "cavitator_angle", "body_angle", "fin_position", "thrust", "burn_fraction", "water", "density",
    "dynamic_viscosity", "vapour_pressure", "atmospheric_pressure", "model", "radius", "wall",
    "gravity_rise", "gravity_rise_length", "gravity_rise_factor", "distortion",
    "distortion_factor", "fin_immersion", "fin_lift", "planing", "planing_angle",
    "planing_direction_width", "end_force", "torsional_stiffness", "polar_inertia_per_length",
    "left_torsion", "right_torsion", "torsional", "polar_inertia", "theory", "shear_form",
    "hydrodynamic_stiffness",
}  # fmt: skip


class HangError(Exception):
    """A file took longer than the limit."""


def spoil(text: str, rng: random.Random) -> str:
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        text = rng.choice((_bytes, _drop, _double, _swap, _misspell, _value, _value, _value, _cut))(
            text, rng
        )
    return text


def _bytes(text, rng):
    k = rng.randrange(max(len(text), 1))
    return text[:k] + chr(rng.choice((0, 10, 34, 44, 61, 91, 127, 233, 8364))) + text[k + 1 :]


def _drop(text, rng):
    lines = text.splitlines()
    if lines:
        del lines[rng.randrange(len(lines))]
    return "\n".join(lines)


def _double(text, rng):
    lines = text.splitlines()
    if lines:
        lines.insert(rng.randrange(len(lines)), rng.choice(lines))
    return "\n".join(lines)


def _swap(text, rng):
    lines = text.splitlines()
    if len(lines) > 1:
        i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
        lines[i], lines[j] = lines[j], lines[i]
    return "\n".join(lines)


def _misspell(text, rng):
    keyed = [line for line in text.splitlines() if "=" in line and not line.startswith("#")]
    if not keyed:
        return text
    line = rng.choice(keyed)
    k = rng.randrange(max(line.index("="), 1))
    return text.replace(line, line[:k] + rng.choice("abcxyz_") + line[k + rng.randrange(2) :], 1)


def _value(text, rng):
    """Replace one number, text or list after an equals sign, or inside a list or a cell."""
    places = [k for k, c in enumerate(text) if c in "=[,"]
    if not places:
        return text
    start = rng.choice(places) + 1
    end = start
    while end < len(text) and text[end] not in ",]\n#":
        end += 1
    return f"{text[:start]} {rng.choice(VALUES)}{text[end:]}"


def _cut(text, rng):
    return text[: rng.randrange(len(text))] if text else text


def verdict(kind: str, path: Path) -> str:
    """Return how antinode ended on a file."""
    signal.setitimer(signal.ITIMER_REAL, LIMIT)
    try:
        problem = load_beam(path) if kind == "beam" else load_case(path)
        solve_modes(problem, 1)
    except InputError as error:
        return "input error" if _is_sentence(str(error)) else "UNCLEAR"
    except ComputationError as error:
        return "computation error" if _is_sentence(str(error)) else "UNCLEAR"
    except AntinodeError:
        return "UNCLEAR"
    except HangError:
        return "HANG"
    except Exception as error:
        return f"TRACEBACK {type(error).__name__}: {str(error)[:80]}"
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    return "accepted" if _is_sound(path) else "WRONGLY ACCEPTED"


def _is_sentence(text: str) -> bool:
    return 10 < len(text) < 700 and "\n" not in text and "Traceback" not in text


def _is_sound(path: Path) -> bool:
    """Read an accepted file again: only known keys, and stations that a beam can have."""
    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    if set(_keys(tables)) - KEYS:
        return False
    body = tables.get("beam") or tables.get("vehicle")
    stations = body["stations"]
    if isinstance(stations, str):
        return True  # the CSV is spoilt apart; its own columns are checked by the loader's tests
    x = [to_si(v, "m") for v in stations["x"]]
    good = all(a < b for a, b in itertools.pairwise(x)) and all(map(math.isfinite, x))
    for name, unit in (("mass_per_length", "kg/m"), ("bending_stiffness", "N m^2")):
        values = [to_si(v, unit) for v in stations[name]]
        good &= all(0 < v < math.inf for v in values) and len(values) == len(x)
    return good


def _keys(table):
    for key, value in table.items():
        yield key.partition(":")[0]
        for inner in value if isinstance(value, list) else [value]:
            if isinstance(inner, dict):
                yield from _keys(inner)


def one_file(rng: random.Random, folder: Path) -> tuple[str, str]:
    """Write one spoilt file and return its kind and antinode's verdict."""
    kind = rng.choice(("beam", "beam", "case", "csv"))
    if kind == "beam":
        path = folder / "beam.toml"
        source = EXAMPLES / rng.choice(BEAMS) / "beam.toml"
        path.write_text(spoil(source.read_text("utf-8"), rng), "utf-8")
        return kind, verdict("beam", path)
    case, stations = ((EXAMPLES / "starter" / n).read_text("utf-8") for n in FILES)
    spoilt = (spoil(case, rng), stations) if kind == "case" else (case, spoil(stations, rng))
    for name, text in zip(FILES, spoilt, strict=True):
        (folder / name).write_text(text, "utf-8")
    return kind, verdict("case", folder / FILES[0])


FILES = ("case.toml", "stations.csv")
BAD = ("UNCLEAR", "HANG", "TRACEBACK", "WRONGLY ACCEPTED")


def run(files: int, seed: int) -> tuple[collections.Counter, list[str], float]:
    """Spoil and judge files; return counts, what went wrong, and the slowest."""
    signal.signal(signal.SIGALRM, _raise)
    counts: collections.Counter = collections.Counter()
    wrong, slowest = [], 0.0
    with tempfile.TemporaryDirectory() as name:
        for k in range(files):
            rng = random.Random(f"{seed}-{k}")
            start = time.perf_counter()
            kind, end = one_file(rng, Path(name))
            slowest = max(slowest, time.perf_counter() - start)
            counts[kind, end.split(":")[0]] += 1
            if end.startswith(BAD):
                wrong.append(f"{seed}-{k} ({kind}): {end}")
    return counts, wrong, slowest


def _raise(*_):
    raise HangError


def record(files, seed, counts, wrong, slowest, seconds):
    lines = [
        "# Malformed files",
        "",
        f"`python validation/malformed.py --files {files} --seed {seed}`, "
        f"{datetime.now(UTC):%Y-%m-%d}, {seconds:.0f} s; slowest file {slowest:.2f} s.",
        "",
        "| kind of file | end | files |",
        "|---|---|---|",
        *(f"| {kind} | {end} | {n} |" for (kind, end), n in sorted(counts.items())),
        "",
        f"Tracebacks, hangs over {LIMIT:g} s, unclear sentences, wrong acceptances: {len(wrong)}.",
        *(f"- {line}" for line in wrong[:50]),
    ]
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    start = time.perf_counter()
    counts, wrong, slowest = run(given.files, given.seed)
    text = record(given.files, given.seed, counts, wrong, slowest, time.perf_counter() - start)
    print(text)
    if given.files >= 10_000:
        (ROOT / "validation" / "malformed.md").write_text(text, "utf-8")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
