"""How long one solve takes in a running process, and how long a cold start: records, no limits.

python benchmarks/single_solve.py        writes benchmarks/results.json
"""

import datetime
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np

from antinode import Beam, solve_modes

HERE = Path(__file__).resolve().parent
STARTS = 9


def stepped_beam(segments):
    """Free-free beam, EI and m stepped over a smooth course, N stepped from 13 to 50 kN."""
    x = np.linspace(0.0, 6.0, segments + 1)
    s = (x[:-1] + x[1:]) / 12
    m = 330 * np.exp(-4 * (s - 0.45) ** 2)
    EI = 4e5 * np.exp(-3 * (s - 0.3) ** 2)
    return Beam.from_stations(x, m, EI, None, 13e3 + 37e3 * s)


def milliseconds(run, times):
    """Median and smallest time of a call [ms], after one that is not counted."""
    run()
    taken = []
    for _ in range(times):
        start = time.perf_counter()
        run()
        taken.append(1e3 * (time.perf_counter() - start))
    return {"median_ms": round(statistics.median(taken), 2), "least_ms": round(min(taken), 2)}


def solves():
    """First six bending modes of a stepped beam, shapes and certificates included."""
    rows = {}
    for segments, times in ((100, 51), (1000, 15), (10_000, 5)):
        beam = stepped_beam(segments)
        rows[f"{segments} segments"] = milliseconds(
            lambda beam=beam: solve_modes(beam, 6, families=("bending",)), times
        )
    return rows


def starts():
    """Median wall time of fresh processes [s]: the main job, and the imports it is held against."""
    antinode = Path(sys.executable).with_name("antinode")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([antinode, "init", folder], check=True, capture_output=True)
        commands = {
            "antinode modes": [antinode, "modes", f"{folder}/case.toml"],
            "antinode modes --plot": [antinode, "modes", f"{folder}/case.toml", "--plot",
                                      f"{folder}/modes.png"],
            "import numpy, scipy.linalg": [sys.executable, "-c", "import numpy, scipy.linalg"],
        }  # fmt: skip
        rows = {name: [] for name in commands}
        for _ in range(STARTS + 1):  # in turn, so that a busy machine slows all alike
            for name, command in commands.items():
                start = time.perf_counter()
                subprocess.run(command, check=True, capture_output=True)
                rows[name].append(time.perf_counter() - start)
    return {name: {"median_s": round(statistics.median(t[1:]), 3)} for name, t in rows.items()}


def machine():
    return {
        "date": f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}",
        "cpu_count": os.cpu_count(),
        "python": platform.python_version(),
        **{name: version(name) for name in ("antinode", "numpy", "scipy")},
    }


def main():
    results = {"machine": machine(), "single_solve": solves(), "cold_start": starts()}
    text = json.dumps(results, indent=2)
    print(text)
    (HERE / "results.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
