"""Stated errors of peaks and rms against the true ones: ``python validation/response_errors.py``.

Shock spectra, with ``python validation/response_errors.py 12 shock``.

Beams that vary inside their intervals, with shear, axial force and a mass, damping ratios from 1e-4
to 0.05, grids of 5 to 60 frequencies that meet no resonance. The truth is the same response at a
tolerance of 1e-9, whose own error is stated too, its peaks found anew.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

import antinode as an
from antinode.response.file import Problem, ResponseFile
from antinode.response.solve import solve_response

SEED = 1824


def drawn(rng: np.random.Generator) -> an.Beam:
    """Return a tapered beam with much on it."""
    x = np.concatenate([[0], np.sort(rng.uniform(0.1, 0.9, 2)), [1]])
    size = np.exp(rng.normal(0, 0.4, 4))
    beam = an.Beam.from_stations(
        x,
        size,
        size * np.exp(rng.normal(0, 0.4, 4)),
        ends=an.Ends(
            *[("clamped", "free"), ("pinned", "pinned"), ("free", "free")][rng.integers(3)]
        ),
        shear_stiffness=200 * size if rng.random() < 0.5 else None,
        axial_force=rng.uniform(-3, 0.3),
        interpolation="linear",
    )
    return beam.with_attachments(an.PointMass(float(rng.uniform(0.2, 0.8)), 0.3 * rng.random()))


def asked(rng: np.random.Generator, kind: str) -> dict[str, Any]:
    """Return the tables of a response."""
    low, high = 0.3, float(rng.choice([4.0, 12.0, 40.0]))
    return {
        "response": {"of": "beam", "kind": kind, "tolerance": float(rng.choice([1e-3, 1e-6]))},
        "damping": {"loss_factor": float(2 * np.exp(rng.uniform(np.log(1e-4), np.log(0.05))))},
        "frequency": {"from": low, "to": high, "points": int(rng.integers(5, 60))},
        "forces": [
            {"x": 0.77, "amplitude": 1.0, "psd": {"frequency": [0.1, 50], "level": [1.0, 1.0]}}
        ],
        "outputs": [
            {"x": 0.41, "quantity": "acceleration"},
            {"x": 0.63, "quantity": "bending_moment"},
        ],
        "random": {"envelope": False},
        "equipment": [{"name": "box", "x": 0.41, "allowed": allowed(rng, low, high)}],
    }


def allowed(rng: np.random.Generator, low: float, high: float) -> dict[str, Any]:
    """Return a curve with kinks and slopes."""
    kinks = np.sort(rng.uniform(np.log(low), np.log(high), int(rng.integers(0, 5))))
    f = np.exp(np.concatenate([[np.log(low)], kinks, [np.log(high)]]))
    return {"frequency": f.tolist(), "level": np.exp(rng.normal(0, 2, len(f))).tolist()}


def shaken(rng: np.random.Generator) -> dict[str, Any]:
    """Return the tables of a shock, in steps that are long or short beside what moves."""
    shape = ["half_sine", "triangle", "smooth_rise"][rng.integers(3)]
    pulse = {"shape": shape, "height": 1.0, "duration": float(rng.uniform(0.02, 0.3))}
    return {
        "response": {"of": "beam", "kind": "shock"},
        "damping": {"loss_factor": float(2 * np.exp(rng.uniform(np.log(1e-3), np.log(0.05))))},
        "frequency": {"from": 0.5, "to": 30.0, "points": int(rng.integers(5, 12))},
        "time": {"to": 1.0, "step": float(rng.choice([2e-2, 5e-3, 1e-3]))},
        "forces": [{"x": 0.77, "history": pulse}],
        "outputs": [
            {"x": 0.41, "quantity": "acceleration"},
            {"x": 0.63, "quantity": "bending_moment"},
        ],
    }


def solved(beam: an.Beam, tables: dict[str, Any], kind: str) -> Any:
    """Return the response of a beam."""
    own = tables | {"response": tables["response"] | {"kind": kind}}
    problem = Problem(ResponseFile.model_validate(own), beam, Path(), "drawn", "numba")
    return solve_response(problem)


def shocked(beam: an.Beam, tables: dict[str, Any]) -> tuple[list[float], list[float]]:
    """Return true over stated errors of shock spectra, and stated over their largest.

    The truth has three times as many modes, an eighth of the step, and fewer chords.
    """
    ours = solved(beam, tables, "shock")
    fine = {
        "response": tables["response"] | {"modes": min(3 * ours.count, 300)},
        "time": tables["time"] | {"step": tables["time"]["step"] / 8},
    }
    truth = solved(beam, tables | fine, "shock")
    ratios = np.abs(ours.srs - truth.srs) / ours.off
    return ratios.ravel().tolist(), (ours.off / ours.srs).ravel().tolist()


def compared(beam: an.Beam, tables: dict[str, Any]) -> tuple[list[float], list[float]]:
    """Return true over stated errors of every peak, or rms; and of the margin of equipment."""
    fine = tables | {"response": tables["response"] | {"tolerance": 1e-9}}
    ours, truth = (
        solve_response(Problem(ResponseFile.model_validate(t), beam, Path(), "drawn", "numba"))
        for t in (tables, fine)
    )
    found = []
    for row in range(2):
        if tables["response"]["kind"] == "random":
            a, b = ours.statistics[row], truth.statistics[row]
            found.append(abs(a.rms - b.rms) / (a.error + b.error))
            continue
        a, b = (max((p.size for p in r.peaks[row]), default=np.nan) for r in (ours, truth))
        if np.isfinite(a) or np.isfinite(b):
            found.append(abs(a - b) / (ours.peak_error[row] + truth.peak_error[row]))
    a, b = (result.verdicts[0] for result in (ours, truth))
    return found, [abs(a.margin_db - b.margin_db) / (a.error_db + b.error_db)]


def run(number: int, seed: int = SEED) -> dict[str, np.ndarray]:
    """Compare so many beams; return the ratios by kind."""
    kinds = ("harmonic", "random")
    found: dict[str, list[float]] = {k: [] for k in (*kinds, *(f"{k}, margin" for k in kinds))}
    for index in range(number):
        for kind in kinds:
            rng = np.random.default_rng([seed, index])
            numbers, margin = compared(drawn(rng), asked(rng, kind))
            found[kind] += numbers
            found[f"{kind}, margin"] += margin
    return {kind: np.array(rows) for kind, rows in found.items()}


def run_shocks(number: int, seed: int = SEED) -> tuple[np.ndarray, np.ndarray]:
    """Compare shock spectra of so many beams; return ratios, and stated over the spectrum."""
    ratios, stated = [], []
    for index in range(number):
        rng = np.random.default_rng([seed, index])
        own = shocked(drawn(rng), shaken(rng))
        ratios += own[0]
        stated += own[1]
    return np.array(ratios), np.array(stated)


if __name__ == "__main__":
    if sys.argv[2:] == ["shock"]:
        ratios, stated = run_shocks(int(sys.argv[1]))
        print(
            f"shock: {len(ratios)} numbers, true over stated error: "
            f"median {np.median(ratios):.2g}, largest {np.max(ratios):.3g}, "
            f"{np.count_nonzero(~(ratios <= 1))} above 1; stated "
            f"over the spectrum: median {np.median(stated):.2g}"
        )
        sys.exit()
    for kind, ratios in run(int(sys.argv[1]) if len(sys.argv) > 1 else 40).items():
        print(
            f"{kind}: {len(ratios)} numbers, true over stated error: median "
            f"{np.median(ratios):.2g}, largest {np.max(ratios):.3g}, "
            f"{np.count_nonzero(~(ratios <= 1))} above 1"
        )
