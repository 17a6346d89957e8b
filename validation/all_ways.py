"""Does every way of solving state errors that are true? Random beams against 32 digits.

Draws beams of every kind (tests/all_beams.py) and solves each in every way: `solve_modes`,
`natural_frequencies` and the page's quick solve by either backend, `solve_many` where nothing
varies inside segments, and `buckling`; and sweeps the starter vehicle. Every number is compared
with Taylor series in pairs of doubles (tests/many_digits.py), which share nothing with the solver.
A fault is an error above the stated one, a mode that is missing or does not exist, or a bracket
whose counts are not true.
A way may also decline, by a warning that the tolerance is out of reach or by an error; that is no
fault, and is counted.

    python validation/all_ways.py --cases 1000 --seed 2026
"""

import argparse
import datetime
import multiprocessing
import os
import platform
import subprocess
import sys
import tempfile
import time
import tomllib
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from importlib.metadata import version
from itertools import repeat
from pathlib import Path
from typing import NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from all_beams import FORCES, INTERPOLATIONS, draw, kind_of  # noqa: E402
from many_digits import ManyDigits, TooFineError, critical_load, eigenvalue  # noqa: E402

MODES = 6
TOLERANCES = (1e-6, 1e-4, 1e-8)
LOAD = 0  # index of a critical load factor
_ROOM = 4e-16  # relative, of a reference in doubles


class Claim(NamedTuple):
    """What a way says of one eigenvalue: the `index`-th of all, or a load factor."""

    index: int
    value: float
    error: float


class Row(NamedTuple):
    """One claim beside the truth; `truth` is NaN where there is none (`words` tell)."""

    case: int
    way: str
    index: int
    tolerance: float
    value: float
    error: float
    truth: float
    words: str = ""

    @property
    def ratio(self):
        """True error over the stated one, less what the reference's own rounding may make."""
        off = abs(self.value - self.truth) - _ROOM * abs(self.truth)
        return max(off, 0.0) / self.error if self.error > 0 else (np.inf if off > 0 else 0.0)


# --- the ways ---------------------------------------------------------------------------------


def _modes(beam, tolerance, name):
    import antinode as an

    result = an.solve_modes(beam, MODES, tolerance=tolerance, families=("bending",), backend=name)
    declined = any("do not reach the tolerance" in w for w in result.warnings)
    modes = sorted(result.modes, key=lambda mode: (mode.bracket_omega2, mode.omega2))
    return [Claim(k + 1, m.omega2, m.error_omega2) for k, m in enumerate(modes)], declined


def _frequencies(beam, tolerance, name):
    import antinode as an

    found = an.natural_frequencies(beam, MODES, tolerance=tolerance, backend=name)
    return _indexed(found.omega2, found.error_omega2, found.counts), False


def _indexed(omega2, error, counts):
    """Claims by their counts: modes that share a bracket have consecutive indices."""
    below = counts[:, 0].tolist()
    indices = [low + 1 + k - below.index(low) for k, low in enumerate(below)]
    return [Claim(*row) for row in zip(indices, omega2.tolist(), error.tolist(), strict=True)]


def _many(beam, name):
    import antinode as an

    tables = (beam.mass_per_length, beam.bending_stiffness, beam.axial_force)
    batch = an.BeamBatch(np.diff(beam.x), *(t[:, 0] for t in tables), beam.ends, MODES)
    found = an.solve_many(batch, backend=name)
    if not np.isfinite(found.omega2).all():
        return f"declined: {found.why(0)}"
    return _indexed(found.omega2[0], found.error_omega2[0], found.counts[0]), False


def _quick(beam):
    from antinode.app import quick

    found = quick.quick_modes(beam, MODES)
    same, _ = _frequencies(beam, quick.TOLERANCE, "numba")  # it tells no counts of its own
    values = zip(same, found.omega2.tolist(), found.error.tolist(), strict=True)
    return [Claim(claim.index, *value) for claim, *value in values], False


def _buckling(beam, tolerance):
    from antinode.modes.buckling import buckling

    found = buckling(beam, tolerance)
    return [] if found is None else [Claim(LOAD, found.load_factor, found.error)], False


def ways(beam, tolerance):
    """Name and call of every way that applies to a beam."""
    yield "solve_modes, numpy", 0, lambda: _modes(beam, tolerance, "numpy")
    yield "solve_modes, numba", 0, lambda: _modes(beam, tolerance, "numba")
    yield "natural_frequencies, numba", 0, lambda: _frequencies(beam, tolerance, "numba")
    if not np.any(beam.varies("bending")) and not beam.attachments:
        yield "solve_many, numpy", 0, lambda: _many(beam, "numpy")
        yield "solve_many, numba", 0, lambda: _many(beam, "numba")
    yield "quick modes of the page", 1e-4, lambda: _quick(beam)
    yield "buckling", 0, lambda: _buckling(beam, tolerance)


# --- judging ----------------------------------------------------------------------------------


def judge(seed, case):
    """Rows of every claim of every way about one beam."""
    from antinode.errors import AntinodeError

    beam, tolerance = draw(seed, case), TOLERANCES[case % 7 % 3]
    rows, claims = [], []
    for way, own, call in ways(beam, tolerance):
        used = own or tolerance
        try:
            found = call()
        except AntinodeError as error:
            found = f"declined: {error}"
        except Exception as error:
            found = f"{type(error).__name__}: {error}"
        if isinstance(found, str):
            rows.append(Row(case, way, 0, used, np.nan, np.nan, np.nan, found))
            continue
        claimed, declined = found
        claims += [(way, used, claim, declined) for claim in claimed]
        if way == "buckling" and not claimed:
            rows += list(_none_buckles(beam, case, used))
        elif way != "buckling":
            rows += _missing(beam, case, way, used, claimed)
    return [*rows, *_compared(beam, case, claims)]


def _none_buckles(beam, case, tolerance):
    """A row if a beam buckles that is said not to, by up to 1e6 times its force."""
    from antinode.modes.rigid import rigid_modes

    allowed = int("rotation" in rigid_modes(beam, "bending"))
    load = _largest_load(beam)
    exact = ManyDigits(beam, 0.0, load)
    count = exact(-1e-18 * exact.unit, load)[0]
    words = f"{count} eigenvalues negative at {load:.3g} times N, none told"
    yield Row(case, "buckling", LOAD, tolerance, 0, 0, 0, words if count > allowed else "")


def _largest_load(beam):
    """A factor that makes the largest force 3e4 times EI/L^2 of the softest station."""
    size = np.max(np.abs(beam.axial_force)) + abs(beam.axial_acceleration) * beam.mass
    return 3e4 * np.min(beam.bending_stiffness) / beam.length**2 / size if size else 1.0


def _missing(beam, case, way, tolerance, claims):
    """A row for every index that is left out between the first and the last."""
    told = [claim.index for claim in claims]
    expected = list(range(told[0], told[0] + len(told)))
    if told != expected and not (beam.is_unloaded is False and 0.0 not in told):
        words = f"indices {told}"
        yield Row(case, way, told[0], tolerance, np.nan, np.nan, np.nan, words)


def _compared(beam, case, claims):
    """Every claim beside the truth, which is found once an index."""
    values = [abs(claim.value) for _, _, claim, _ in claims if claim.index != LOAD]
    exact = ManyDigits(beam, 1.2 * max(values, default=1.0) + 1e-300)
    truths = {}
    for way, tolerance, claim, declined in claims:
        if claim.index != LOAD and claim.value == 0.0 and claim.error == 0.0:
            floor = 1e-15 * exact.unit
            below, above = exact(-floor)[0], exact(floor)[0]
            words = "" if below < claim.index <= above else f"zero has counts {below}, {above}"
            yield Row(case, way, claim.index, tolerance, 0.0, 0.0, 0.0, words)
            continue
        if claim.index not in truths:
            truths[claim.index] = _truth(beam, exact, claim)
        words = "tolerance declined" if declined else ""
        if np.isnan(truths[claim.index]):
            words = "declined: the reference, for its size"
        yield Row(case, way, claim.index, tolerance, claim.value, claim.error,
                  truths[claim.index], words)  # fmt: skip


def _truth(beam, exact, claim):
    """The number in many digits; NaN where that would take too many pieces."""
    from antinode.modes.rigid import rigid_modes

    if claim.index != LOAD:
        return eigenvalue(exact, claim.index, claim.value)
    try:
        return critical_load(beam, rigid_modes(beam, "bending"), claim.value)
    except TooFineError:
        return np.nan


STUDY = """
inputs = [
  { key = "speed", low = 60, high = 120 },
  { key = "thrust", low = 0, high = 2e5 },
  { key = "fin_position", low = 4, high = 5.9 },
]
outputs = ["omega2", "error_hz"]
design = { kind = "sobol", number = NUMBER }
solve = { modes = 4, tolerance = 1e-5 }
"""


def study_rows(number=64):
    """Rows of every frequency of a sweep of the starter vehicle: chains solved in batches."""
    import antinode as an
    from antinode.modes.hertz import hertz
    from antinode.study.cases.values import case_of
    from antinode.study.design.file import Study
    from antinode.study.design.points import points_of
    from antinode.study.sweep.sweep import sweep

    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [sys.executable, "-m", "antinode", "init", "--example", "sweep", folder],
            check=True, capture_output=True,
        )  # fmt: skip
        # the reference is a beam of Euler and Bernoulli whose ends keep their direction
        pinned = ["model.end_force=fixed_direction", "model.theory=euler_bernoulli"]
        case = an.load_case(Path(folder) / "case.toml", pinned)
    made = Study.model_validate(
        {**tomllib.loads(STUDY.replace("NUMBER", str(number))), "case": case}
    )
    found, points, rows = sweep(made), points_of(made), []
    values = np.concatenate([points.values(chunk) for chunk in range(points.chunks)])
    for i, row in enumerate(values):
        keys = {v.keys: [x] for v, x in zip(points.variables, row, strict=True)}
        beam = case_of(case, keys, 0).beam()
        omega2, error = found.omega2[i].values, found.error_hz[i].values
        exact = ManyDigits(beam, 1.2 * np.max(np.abs(omega2)))
        for k, value in enumerate(omega2.tolist()):
            if value > 0:  # past the two rigid modes
                truth = eigenvalue(exact, k + 3, value)
                rows.append(Row(i, "sweep", k + 3, 1e-5, float(hertz(value)), float(error[k]),
                                float(hertz(truth))))  # fmt: skip
    return rows


def faults(rows):
    """Rows that break a promise, each with a word on it."""
    for row in rows:
        if row.words.startswith(("declined", "tolerance declined")) and np.isnan(row.truth):
            continue
        if row.words and row.words != "tolerance declined":
            yield row.words, row
        elif not row.ratio <= 1:
            yield f"true error {row.ratio:.3g} times the stated one", row


def run(seed, cases, jobs):
    """Rows of all cases, in order."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        rows = []
        for case, found in enumerate(pool.map(judge, repeat(seed), cases, chunksize=2)):
            rows += found
            if case % 50 == 49:
                print(f"{case + 1}: {len(list(faults(rows)))} faults", file=sys.stderr, flush=True)
    return rows


# --- the record -------------------------------------------------------------------------------


def record(rows, cases, seed, seconds, jobs):
    """The record as Markdown."""
    bad = list(faults(rows))
    lines = [
        "# Every way of solving on random beams",
        "",
        " ".join(__doc__.split("\n\n")[1].split("\n")),
        "",
        f"- {datetime.date.today()}, Python {platform.python_version()}, "
        f"antinode {version('antinode')}, numpy {version('numpy')}, numba {version('numba')}",
        f"- command: `python validation/all_ways.py --cases {cases} --seed {seed}`, "
        f"{seconds:.0f} s with {jobs} processes",
        f"- {cases} beams, {len(rows)} numbers",
        f"- **faults: {len(bad)}**",
        "",
        "| way | numbers | worst true / stated error | 99th percentile | faults | declined |",
        "|---|---|---|---|---|---|",
        *(_line(way, [r for r in rows if r.way == way]) for way in dict.fromkeys(
            r.way for r in rows)),
        "",
        "| properties, axial force | beams | numbers | worst true / stated error | faults |",
        "|---|---|---|---|---|",
    ]  # fmt: skip
    for interpolation in INTERPOLATIONS:
        for force in FORCES:
            own = {c for c in range(cases) if kind_of(c) == (interpolation, force)}
            some = [r for r in rows if r.case in own and r.way != "sweep"]
            worst = max((r.ratio for r in some if np.isfinite(r.ratio)), default=0.0)
            wrong = sum(r.case in own and r.way != "sweep" for _, r in bad)
            name = f"{interpolation}, {force}"
            lines.append(f"| {name} | {len(own)} | {len(some)} | {worst:.3g} | {wrong} |")
    lines.append("")
    lines += [f"- case {r.case}, {r.way}, {r.index}, {r.tolerance:.0e}: {t}" for t, r in bad]
    reasons = Counter(r.words for r in rows if r.words.startswith("declined"))
    lines += ["", *(f"- {number} times {words}" for words, number in reasons.most_common(20))]
    return "\n".join(lines).rstrip() + "\n"


def _line(way, rows):
    ratios = np.array([r.ratio for r in rows if np.isfinite(r.ratio)])
    ratios = ratios if len(ratios) else np.zeros(1)
    wrong, declined = len(list(faults(rows))), sum("declined" in r.words for r in rows)
    return (
        f"| {way} | {len(rows)} | {ratios.max():.3g} | {np.percentile(ratios, 99):.2g} "
        f"| {wrong} | {declined} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count()))
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).with_suffix(".md"))
    options = parser.parse_args()
    start = time.perf_counter()
    rows = run(options.seed, range(options.cases), options.jobs) + study_rows()
    text = record(rows, options.cases, options.seed, time.perf_counter() - start, options.jobs)
    options.output.write_text(text)
    print(text)
    return 1 if any(faults(rows)) else 0


if __name__ == "__main__":
    sys.exit(main())
