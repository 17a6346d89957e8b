"""MYSTRAN and CalculiX: run on a deck, what they find; and what the head of a deck expects."""

import os
import re
import shutil
import subprocess

import numpy as np
import pytest

MYSTRAN = os.environ.get("ANTINODE_MYSTRAN") or shutil.which("mystran")
CCX = shutil.which("ccx")

needs_mystran = pytest.mark.skipif(
    MYSTRAN is None, reason="MYSTRAN is neither on the path nor in ANTINODE_MYSTRAN"
)
needs_ccx = pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not on the path")


def run_mystran(path):
    """Eigenvalues, or load factors, that MYSTRAN prints."""
    _run([MYSTRAN, path.name], path)
    text = path.with_suffix(".F06").read_text(errors="replace")
    assert "*ERROR" not in text, text[text.index("*ERROR") :][:500]
    table = text[text.index("R E A L   E I G E N V A L U E S") :].partition("LINK")[0]
    rows = re.findall(r"^ +\d+ +\d+ +(-?[\d.]+E[+-]\d+)", table, re.M)
    return np.array([float(value) for value in rows])


def run_ccx(path):
    """Eigenvalues, or load factors, that CalculiX prints."""
    done = _run([CCX, "-i", path.stem], path)
    assert done.returncode == 0, done.stdout[-500:]
    text = path.with_suffix(".dat").read_text()
    table = text.partition("P A R T I C I P A T I O N")[0]
    rows = re.findall(r"^ +\d+ +(-?[\d.]+E[+-]\d+)(?: +\S+){0,3}$", table, re.M)
    return np.array([float(value) for value in rows])


def _run(command, path):
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    options = {"cwd": path.parent, "capture_output": True, "text": True, "timeout": 300}
    return subprocess.run(command, env=environment, check=False, **options)


def expected(path):
    """Of a deck's head: name, value of the mesh, value of the beam; eigenvalues or load factors."""
    number = r"(omega2 \S+|[\d.]+(?:e[+-]\d+)?)"
    rows = re.findall(rf"^(?:\$|\*\*) (.{{26}}) *{number} +{number}$", path.read_text(), re.M)
    return [(name.strip(), _value(name, a), _value(name, b)) for name, a, b in rows]


def _value(name, cell):
    if name.startswith("buckling"):
        return float(cell)
    if cell.startswith("omega2"):
        return float(cell.split()[1])
    return (2 * np.pi * float(cell)) ** 2


def worst(found, rows):
    """Largest distance of an expected value from the nearest one found, in itself or in the first.

    Rigid modes count in the first elastic one.
    """
    values = np.array([value for _, value, _ in rows])
    scale = np.maximum(np.abs(values), np.min(np.abs(values[np.abs(values) > 0])))
    near = np.min(np.abs(np.asarray(found)[:, None] - values), axis=0)
    return float(np.max(near / scale))
