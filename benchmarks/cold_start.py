"""Wall time of fresh processes."""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STARTS = 9


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
