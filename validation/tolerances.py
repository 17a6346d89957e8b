"""Is every frequency within the tolerance asked for? Random steep tables against hp elements.

Draws beams with steep tables (tests/tables.py), solves each family for three tolerances, and
compares every mode with hp finite elements (tests/hp_beam.py) that share nothing with the solver
and agree with themselves on a second mesh to far better. Error and estimate are relative to the
frequency (or rate of growth); the estimate is the part of `error_hz` that stands for what varies
inside segments. Rigid modes at exactly zero have neither.

    python validation/tolerances.py --cases 200 --seed 2026
"""

import argparse
import datetime
import multiprocessing
import os
import platform
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from importlib.metadata import version
from itertools import repeat
from pathlib import Path
from typing import NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

import hp_beam  # noqa: E402
from tables import draw_beam  # noqa: E402

TOLERANCES = (1e-4, 1e-6, 1e-8)
SEEN = 1e-11  # true errors below this one do not judge an estimate
MODES = 6


class Row(NamedTuple):
    """One mode of one beam at one tolerance."""

    case: int
    family: str
    index: int
    tolerance: float
    error: float
    estimate: float
    bound: float
    spread: float
    segments: int
    seconds: float


def judge(seed, case, tolerances=TOLERANCES):
    """Rows of every mode of one beam at all tolerances."""
    import antinode as an

    beam, rows = draw_beam(seed, case), []
    for family in ("bending", "longitudinal"):
        reference = None
        for tolerance in tolerances:
            start = time.process_time()
            result = an.solve_modes(beam, MODES, tolerance=tolerance, families=(family,))
            seconds = time.process_time() - start
            modes = sorted(result.modes, key=lambda mode: mode.bracket_omega2)
            reference = reference or hp_beam.reference(beam, len(modes), family)
            for k, mode in enumerate(modes):
                if mode.omega2 == 0.0:
                    continue
                rows.append(
                    Row(case, family, k + 1, tolerance, *_errors(mode, reference, k),
                        float(reference.spread[k]), result.segments[family], seconds)
                )  # fmt: skip
    return rows


def _errors(mode, reference, k):
    """True error, estimate of the discretisation, and whole bound, relative to the frequency."""
    exact = reference.omega2[k]
    low, high = mode.bracket_omega2
    estimate = mode.error_omega2 - max(mode.omega2 - low, high - mode.omega2)
    values = mode.omega2 - exact, estimate, mode.error_omega2
    return [float(abs(value) / abs(exact) / 2) for value in values]


def run(seed, cases, jobs):
    """Rows of all cases, in order."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        rows = []
        for case, found in enumerate(pool.map(judge, repeat(seed), range(cases), chunksize=4)):
            rows += found
            if case % 20 == 19:
                print(f"{case + 1} of {cases}", file=sys.stderr)
    return rows


def ratios(rows):
    """Estimate over true error wherever the latter can be seen."""
    return np.array([row.estimate / row.error for row in rows if row.error > SEEN])


def faults(rows):
    """Rows that break a promise, each with a word on it.

    An estimate may be as large as a hundred times the error of the mode or of a neighbour: by the
    error rule it keeps a hundredth of what a neighbour moved (`antinode.riccati.convergence`).
    """
    errors = {(row.case, row.family, row.tolerance, row.index): row.error for row in rows}
    for row in rows:
        beside = (row.index - 1, row.index, row.index + 1)
        near = max(errors.get((*row[:2], row.tolerance, k), 0.0) for k in beside)
        if row.error > row.tolerance:
            yield f"error {row.error:.2e} above the tolerance", row
        if row.error > row.bound:
            yield f"error {row.error:.2e} above the bound {row.bound:.2e}", row
        if row.error > SEEN and row.estimate < 0.1 * row.error:
            yield f"estimate over error {row.estimate / row.error:.3g}", row
        if near > SEEN and row.estimate > 100 * near:
            yield f"estimate over the largest error beside {row.estimate / near:.3g}", row


def record(rows, cases, seed, seconds, jobs):
    """The record as Markdown."""
    bad = list(faults(rows))
    shares = {
        "logarithmic between stations": np.mean([c % 2 == 0 for c in range(cases)]),
        "linear": np.mean([c % 2 == 1 for c in range(cases)]),
        "properties over all three decades": np.mean([c % 4 == 0 for c in range(cases)]),
    }
    beams = [draw_beam(seed, case) for case in range(cases)]
    shares |= {
        "with attachments": np.mean([len(b.attachments) > 0 for b in beams]),
        "with an axial force": np.mean([not b.is_unloaded for b in beams]),
        "accelerated or under gravity": np.mean([b.axial_acceleration != 0 for b in beams]),
        "free-free": np.mean([(b.ends.left, b.ends.right) == ("free", "free") for b in beams]),
    }
    lines = [
        "# Tolerances and estimates on random steep tables",
        "",
        " ".join(__doc__.split("\n\n")[1].split("\n")),
        "",
        f"- {datetime.date.today()}, Python {platform.python_version()}, "
        f"antinode {version('antinode')}, numpy {version('numpy')}, scipy {version('scipy')}",
        f"- command: `python validation/tolerances.py --cases {cases} --seed {seed}`, "
        f"{seconds:.0f} s with {jobs} processes",
        f"- {cases} beams, {len(rows)} modes; disagreement of the reference's two meshes: "
        f"at most {max(row.spread for row in rows):.0e}",
        f"- **faults: {len(bad)}**",
        "",
        "| share of the beams | |",
        "|---|---|",
        *(f"| {name} | {share:.0%} |" for name, share in shares.items()),
        "",
        "| family | tolerance | modes | worst error / tolerance | estimate / error: least | median "
        "| most | of modes | worst error / bound "
        "| segments: median | most | CPU s: median | most |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for family in ("bending", "longitudinal"):
        for tolerance in TOLERANCES:
            some = [r for r in rows if (r.family, r.tolerance) == (family, tolerance)]
            if some:
                lines.append(f"| {family} | {tolerance:.0e} | {_line(some, tolerance)} |")
    lines.append("")
    lines += [f"- case {r.case}, {r.family} {r.index}, {r.tolerance:.0e}: {t}" for t, r in bad]
    return "\n".join(lines).rstrip() + "\n"


def _line(rows, tolerance):
    q = ratios(rows)
    q = q if len(q) else np.array([np.nan])
    segments, seconds = ([getattr(r, name) for r in rows] for name in ("segments", "seconds"))
    return " | ".join(
        [
            str(len(rows)),
            f"{max(r.error for r in rows) / tolerance:.2g}",
            f"{q.min():.2g}",
            f"{np.median(q):.2g}",
            f"{q.max():.2g}",
            str(len(q)),
            f"{max(r.error / r.bound for r in rows):.2g}",
            f"{np.median(segments):.0f}",
            str(max(segments)),
            f"{np.median(seconds):.2f}",
            f"{max(seconds):.1f}",
        ]
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count()))
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).with_suffix(".md"))
    options = parser.parse_args()
    start = time.perf_counter()
    rows = run(options.seed, options.cases, options.jobs)
    text = record(rows, options.cases, options.seed, time.perf_counter() - start, options.jobs)
    options.output.write_text(text)
    print(text)
    return 1 if any(faults(rows)) else 0


if __name__ == "__main__":
    sys.exit(main())
