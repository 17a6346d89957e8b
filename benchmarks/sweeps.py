"""Sweeps end to end: wall time and memory of `antinode sweep` into a store, on this machine.

    python benchmarks/sweeps.py [--cases 1000000] [--workers 2] [--only loads|columns]

Each study runs in processes of its own, from the start of the command to the finished store. Memory
is the largest sum of the resident sets of all its processes (shared pages counted in each).
"""

import argparse
import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
from datetime import date
from importlib.metadata import version
from pathlib import Path

HERE = Path(__file__).resolve().parent
RECORD = HERE / "sweeps.md"
PAGE = os.sysconf("SC_PAGE_SIZE")

LOADS = """
case = "case.toml"
inputs = [
  { key = "condition.speed", low = "60 m/s", high = "130 m/s" },
  { key = "condition.cavitation_number", low = 0.012, high = 0.06 },
  { key = "condition.cavitator_angle", low = "0 deg", high = "15 deg" },
  { key = "condition.thrust", low = "0 kN", high = "200 kN" },
  { key = "condition.fin_position", low = "3.5 m", high = "5.9 m" },
]
design = { kind = "sobol", number = NUMBER }
"""
COLUMNS = """
case = "case.toml"
inputs = [
  { key = "condition.speed", low = "60 m/s", high = "130 m/s" },
  { key = "condition.thrust", low = "0 kN", high = "150 kN" },
  { key = "mass_per_length", control_points = 5, distribution = "lognormal", sd = 0.05 },
  { key = "bending_stiffness", control_points = 5, distribution = "lognormal", sd = 0.1 },
]
design = { kind = "sobol", number = NUMBER }
"""
STUDIES = {"loads": LOADS, "columns": COLUMNS}


def command():
    return [sys.executable, "-c", "from antinode.cli import main; main()"]


def descendants(root):
    """Process ids of a process and all below it."""
    parents = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            parents[int(entry.name)] = int(fields[1])
    found = {root}
    while True:
        more = {pid for pid, parent in parents.items() if parent in found} - found
        if not more:
            return found
        found |= more


def resident(root):
    total = 0
    for pid in descendants(root):
        try:
            total += int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
        except OSError:
            continue
    return total


def measure(name, cases, workers):
    """Run one study; return its wall time, memory and size."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        subprocess.run([*command(), "init", folder], check=True, capture_output=True)
        (place / "study.toml").write_text(STUDIES[name].replace("NUMBER", str(cases)))
        arguments = ["sweep", place / "study.toml", "-o", place / "s.zarr", "--json"]
        arguments += ["--workers", workers]
        start, most = time.perf_counter(), 0
        with subprocess.Popen(
            [*command(), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        ) as process:
            while process.poll() is None:
                most = max(most, resident(process.pid))
                time.sleep(0.1)
            seconds = time.perf_counter() - start
            result = json.loads(process.stdout.read())
        size = sum(f.stat().st_size for f in (place / "s.zarr").rglob("*") if f.is_file())
        shutil.rmtree(place / "s.zarr")
    row = {
        "study": name,
        "cases": cases,
        "workers": workers,
        "seconds": round(seconds, 1),
        "cases_per_second": round(cases / seconds),
        "memory_gib": round(most / 2**30, 3),
        "store_mb": round(size / 1e6, 1),
        "failed": result["failed"],
        "past_buckling": result["past_buckling"],
    }
    print(row, flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=1_000_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--only", choices=STUDIES)
    arguments = parser.parse_args()
    plan = [
        ("loads", max(1, arguments.cases // 10)),
        ("loads", arguments.cases),
        ("columns", max(1, arguments.cases // 10)),
        ("columns", arguments.cases),
    ]
    rows = [
        measure(name, cases, arguments.workers)
        for name, cases in plan
        if arguments.only in (None, name)
    ]
    if arguments.only is None:
        RECORD.write_text(record(rows))


WORDS = {
    "loads": "loads alone: speed, sigma, cavitator angle, thrust, fin position",
    "columns": "speed, thrust, mass and stiffness at 5 control points each",
}


PAGE_TEXT = """# Sweeps

`python benchmarks/sweeps.py`: `antinode sweep` from the start of the command to the finished store,
Sobol samples around the starter vehicle, 6 certified frequencies with errors a case. Memory is the
largest sum of the resident sets of all processes.

| what varies | cases | processes | seconds | cases a second | memory | store | failed |
|---|---|---|---|---|---|---|---|
{table}

Goals: a million cases of loads within 25 s and of mass and stiffness within 60 s on two quiet
processors, memory that does not grow with the number of cases. The first is missed.

{when}
"""


def record(rows):
    """The record as a page."""
    table = [
        f"| {WORDS[r['study']]} | {r['cases']:,} | {r['workers']} | {r['seconds']:.0f} | "
        f"{r['cases_per_second']:,} | {r['memory_gib']:.2f} GiB | {r['store_mb']:.0f} MB | "
        f"{r['failed']} |"
        for r in rows
    ]
    versions = ", ".join(f"{name} {version(name)}" for name in ("numpy", "numba", "zarr"))
    machine = f"{os.cpu_count()} processors, shared and busy; Python {platform.python_version()}"
    when = f"{machine}, {versions}; {date.today().isoformat()}."
    return PAGE_TEXT.format(table="\n".join(table), when=when)


if __name__ == "__main__":
    main()
