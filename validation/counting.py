"""Counts of eigenvalues below omega^2: antinode's certified counter against the hp reference.

Draws random chains of uniform segments (tests/chains.py), counts their eigenvalues below a drawn
omega^2 by the recursion of `antinode.riccati.chain`, and compares with the count that
tests/reference.py proves from Ritz values and a bound on what their basis leaves out. As a third
witness the parity of the count follows from the sign of a boundary determinant in many digits.
Apart from these cases short chains are counted at resonances of their parts, and at the two
neighbouring doubles, where no eigenvalue is near but a recursion divides by nearly nothing. No
case is skipped: an exception of the counter or of the reference is a mismatch.

    python validation/counting.py --cases 1000 --seed 2026
"""

import argparse
import datetime
import math
import multiprocessing
import os
import platform
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from importlib.metadata import version
from itertools import repeat
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from chains import LONG, NEAR, STEEP, Case, draw_case, draw_resonance, kept_case  # noqa: E402
from law_chains import bending_chain  # noqa: E402
from reference import certain_count, parity_below  # noqa: E402

SEED = 2026
QUICK = 100
LEAST_SHARE = 0.25
SHOWN = 20  # mismatches listed in the record


@dataclass(frozen=True)
class Verdict:
    """A case with the reference's count (and gap), antinode's, and what went wrong."""

    case: Case
    reference: int | None
    gap: float
    antinode: int | None
    fault: str
    seconds: float


def antinode_count(chain, omega2):
    """Eigenvalues of `chain` below omega2 by antinode's recursion."""
    from antinode.riccati.chain import count_below

    arrays = map(np.array, (chain.h, chain.m, chain.EI, chain.N))
    return int(count_below(bending_chain(*arrays, chain.left, chain.right), np.array([omega2]))[0])


def judge(seed, index, counter=antinode_count):
    """Draw case `index`, count it by both sides; `counter=None` leaves antinode out."""
    start = time.perf_counter()
    return [_compare(draw_case(seed, index), counter, start)]


def judge_kept(seed, index, counter=antinode_count):
    """Do the same with a case as it is kept."""
    start = time.perf_counter()
    return [_compare(kept_case(seed, index), counter, start)]


def judge_resonance(seed, index, counter=antinode_count):
    """Do the same at the three points of resonance `index`."""
    start = time.perf_counter()
    return [_compare(case, counter, start) for case in draw_resonance(seed, index)]


def _compare(case, counter, start):
    reference, gap, found, fault = None, math.nan, None, ""
    try:
        reference, gap = certain_count(case.chain, case.omega2)
        found = counter(case.chain, case.omega2) if counter else reference
        if found != reference:
            fault = f"antinode {found}, reference {reference}"
        if parity_below(case.chain, case.omega2) != reference % 2:
            fault = f"the reference contradicts itself; {fault}"
    except Exception as error:  # an answer that does not come is a wrong one
        fault = f"{type(error).__name__}: {error}"
    return Verdict(case, reference, gap, found, fault, time.perf_counter() - start)


def run(seed, cases, *, jobs=None, counter=antinode_count, judge=judge):
    """Verdicts on cases 0 ... cases - 1 of a seed, in order."""
    jobs = jobs or os.cpu_count()
    if jobs == 1:
        return [verdict for index in range(cases) for verdict in judge(seed, index, counter)]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        tasks = pool.map(judge, repeat(seed), range(cases), repeat(counter), chunksize=4)
        return [_report_progress(verdict, cases) for verdicts in tasks for verdict in verdicts]


def _report_progress(verdict, cases):
    done = verdict.case.index + 1
    if done % 50 == 0 or verdict.fault:
        print(f"{done}/{cases} {verdict.fault}", file=sys.stderr, flush=True)
    return verdict


# --- the record ------------------------------------------------------------------------------


def shares(verdicts):
    """Shares of the cases by kind; the first three must be a quarter each."""
    cases = [verdict.case for verdict in verdicts]
    tests = {
        "step in EI of 1e5 or more": lambda c: c.step_EI >= STEEP,
        f"within {NEAR:.0%} of buckling": lambda c: c.near_buckling,
        f"{LONG} segments or more": lambda c: c.segments >= LONG,
        "all three": lambda c: c.step_EI >= STEEP and c.near_buckling and c.segments >= LONG,
        "step in m of 1e5 or more": lambda c: c.step_m >= STEEP,
        "net compression": lambda c: c.net_force > 0,
        "net tension": lambda c: c.net_force < 0,
        "with negative eigenvalues": lambda c: c.negative > 0,
        "with three or more negative eigenvalues": lambda c: c.negative > 2,
        "omega^2 < 0": lambda c: c.omega2 < 0,
        "omega^2 < 0 above the first eigenvalue": lambda c: c.omega2 < 0 and c.target == "negative",
        "omega^2 at a singularity of a part of the chain": lambda c: c.target == "singular",
        "nearest eigenvalue within 10 %": lambda c: c.room < 0.1 and c.target != "singular",
        "nearest eigenvalue within 1 %": lambda c: c.room < 0.01 and c.target != "singular",
    }
    return {name: sum(map(test, cases)) / len(cases) for name, test in tests.items()}


def wanting(verdicts):
    """Kinds that make up less than the quarter they must."""
    return [name for name, share in list(shares(verdicts).items())[:3] if share < LEAST_SHARE]


def mismatches(verdicts):
    return [verdict for verdict in verdicts if verdict.fault]


def describe(verdict):
    """One line with what reproduces and characterises a case."""
    case = verdict.case
    return (
        f"case {case.index}: {verdict.fault} ({case.segments} segments, {case.chain.left}-"
        f"{case.chain.right}, step {case.step_EI:.2g}, omega^2 {case.omega2!r}, {case.target}, "
        f"room {case.room:.1e}, load factor {case.load_factor:.3f})"
    )


def record(verdicts, resonances, seed, seconds, jobs):
    """Write the run up as Markdown."""
    faults, at_resonance = mismatches(verdicts), mismatches(resonances)
    off = [abs(v.antinode - v.reference) for v in verdicts if None not in (v.antinode, v.reference)]
    packages = ("antinode", "numpy", "gmpy2", "mpmath")
    versions = ", ".join(f"{name} {version(name)}" for name in packages)
    highest = max(verdict.reference or 0 for verdict in verdicts)
    lines = [
        "# Counts of eigenvalues against the hp reference",
        "",
        __doc__.split("\n\n")[1].replace("\n", " "),
        "",
        f"- {datetime.datetime.now(datetime.UTC):%Y-%m-%d}, Python {platform.python_version()}, "
        f"{versions}",
        f"- command: `python validation/counting.py --cases {len(verdicts)} --seed {seed} "
        f"--resonances {len(resonances) // 3}`, "
        f"{seconds:.0f} s with {jobs} processes, slowest case "
        f"{max(verdict.seconds for verdict in verdicts):.1f} s",
        f"- cases: {len(verdicts)}, none skipped; counts from 0 to {highest}; smallest proven "
        f"relative distance of omega^2 from an eigenvalue {min(v.gap for v in verdicts):.0e}",
        f"- **mismatches: {len(faults)}**; worst difference of counts: {max(off, default=0)}",
        *(f"  - {describe(verdict)}" for verdict in faults[:SHOWN]),
        f"- at resonances of parts: {len(resonances)} points on {len(resonances) // 3} chains, "
        f"**mismatches: {len(at_resonance)}**",
        *(f"  - {describe(verdict)}" for verdict in at_resonance[:SHOWN]),
        "",
        "| share of the cases | |",
        "|---|---|",
        *(f"| {name} | {share:.1%} |" for name, share in shares(verdicts).items()),
        "",
        "| ends (left, right) | cases | mismatches |",
        "|---|---|---|",
        *_table_of_ends(verdicts),
    ]
    return "\n".join(lines) + "\n"


def _table_of_ends(verdicts):
    ends = Counter((v.case.chain.left, v.case.chain.right) for v in verdicts)
    wrong = Counter((v.case.chain.left, v.case.chain.right) for v in mismatches(verdicts))
    return [f"| {', '.join(pair)} | {ends[pair]} | {wrong[pair]} |" for pair in sorted(ends)]


def _arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--resonances", type=int, default=3000, help="chains, of 3 points each")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument(
        "--quick", action="store_true", help=f"the first {QUICK} of each, no record"
    )
    parser.add_argument("--reference-only", action="store_true", help="leave antinode out")
    parser.add_argument("--output", type=Path, help="default: validation/counting.md of a full run")
    return parser.parse_args()


def main():
    given, start = _arguments(), time.perf_counter()
    cases = min(QUICK, given.cases) if given.quick else given.cases
    chains = min(QUICK, given.resonances) if given.quick else given.resonances
    counter = None if given.reference_only else antinode_count
    verdicts = run(given.seed, cases, jobs=given.jobs, counter=counter)
    resonances = run(given.seed, chains, jobs=given.jobs, counter=counter, judge=judge_resonance)
    seconds = time.perf_counter() - start
    text = record(verdicts, resonances, given.seed, seconds, given.jobs)
    print(text)
    full = not (given.quick or given.reference_only)
    output = given.output or (ROOT / "validation" / "counting.md" if full else None)
    if output:
        output.write_text(text, encoding="utf-8")
    if short := wanting(verdicts):
        print("too few cases: " + ", ".join(short), file=sys.stderr)
    return 1 if short or mismatches(verdicts + resonances) else 0


if __name__ == "__main__":
    sys.exit(main())
