"""All benchmarks in one run: python -m benchmarks; writes results.json and README.md's table.

With names of parts, `python -m benchmarks single smooth`, these alone, and nothing is written.

One process, one thread. Answers are compared before anything is timed; times are medians of many
calls, antinode's and the peer's in turn. The machine is calibrated before and after every part, and
every peer held against its figure, so scaled (peers/figures.py).
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
import datetime  # noqa: E402
import json  # noqa: E402
import platform  # noqa: E402
import sys  # noqa: E402
from importlib.metadata import version  # noqa: E402
from pathlib import Path  # noqa: E402

import numpy as np  # noqa: E402
from scipy.linalg import eigh  # noqa: E402

import antinode as an  # noqa: E402
from antinode.riccati.lanes.laws import FORMS  # noqa: E402
from antinode.riccati.lanes.library import library  # noqa: E402
from antinode.riccati.lanes.structures import Kept  # noqa: E402
from antinode.riccati.lanes.workspace import LANES, OMEGA2, ROWS, new_chain, new_lanes  # noqa: E402
from antinode.riccati.laws import BENDING  # noqa: E402

from . import c, table  # noqa: E402
from .beams import (  # noqa: E402
    DASHPOTS,
    LENGTH,
    MODES,
    SEGMENTS,
    damped_beam,
    medians,
    smooth_case,
    steep_stations,
    stepped_beam,
)
from .cold_start import starts  # noqa: E402
from .peers import dense, figures, hp, packages  # noqa: E402
from .peers.reduced_basis import ReducedBasis  # noqa: E402
from .peers.state_space import StateSpace  # noqa: E402
from .peers.subspace import Subspace  # noqa: E402
from .peers.timoshenko import TimoshenkoSubspace  # noqa: E402

CASES = 300
TABLES = "mass_per_length", "bending_stiffness", "axial_force"
TOLERANCE = 1e-6  # asked for; the true error is checked to be below 1e-7


def row(work, against, target, antinode_s, peer_s, *, most=False, **more):
    """One row: the ratio is that of times, or of throughput where a target is a least one.

    `figure` names what the peer should take (peers/figures.py).
    """
    ratio = antinode_s / peer_s if most else peer_s / antinode_s
    met = ratio <= target if most else ratio >= target
    return {
        "work": work,
        "against": against,
        "ratio": float(f"{ratio:.3g}"),
        "target": f"at {'most' if most else 'least'} {target:g}",
        "met": bool(met),
        "antinode_s": float(f"{antinode_s:.3g}"),
        "peer_s": float(f"{peer_s:.3g}"),
        **more,
    }


def check(name, found, expected, tolerance):
    """Stop if a peer's answers are not ours."""
    worst = float(np.max(np.abs(found / expected - 1)))
    assert worst < tolerance, f"{name}: answers differ by {worst:g}"
    return worst


def step():
    """One segment-frequency step against C."""
    libraries = c.libraries()
    if not libraries:
        return []
    _, m, EI, N = (values.reshape(-1, SEGMENTS)[0] for values in smooth_case(_rng(), 1))
    h, one = np.full(SEGMENTS, 1.0 / SEGMENTS), 36.0 / np.mean(EI)
    own = new_chain(FORMS[BENDING].number, 0, 0, SEGMENTS)
    own.length[:], own.mass[:] = h, m / np.mean(m)
    own.stiffness[:], own.force[:] = EI / np.mean(EI), N * one
    table, lanes, times = np.empty((ROWS, 2 * SEGMENTS)), Kept(new_lanes()), 1000
    pieces, state = library().call("prepare", own, 1.2e5, table)[0], lanes.structure.state
    table = np.ascontiguousarray(table[:, :pieces])
    state[OMEGA2 : OMEGA2 + LANES] = np.linspace(100, 1.2e5, LANES)

    def ours():
        library().call("repeat", own, table, lanes, pieces, times)

    ours()
    expected = state[:48].copy()
    for theirs in libraries.values():
        c.repeat(theirs, table, state, pieces, 1)
        check("C", state[:40], expected[:40], 1e-9)
        assert np.array_equal(state[40:48], expected[40:48])
    theirs = [
        lambda other=other: c.repeat(other, table, state, pieces, times)
        for other in libraries.values()
    ]
    mine, *others = (t / (times * pieces * 8) for t in medians(101, ours, *theirs))
    what = "the same recursion in C, 8 lanes, -O3 -march=native"
    return [row("one segment-frequency step", what, 3, mine, min(others), most=True)]


def _rng():
    return np.random.default_rng(2026)


def batch():
    """Six certified frequencies, structure different in every case."""
    h, m, EI, N = smooth_case(_rng(), CASES)
    beams = an.BeamBatch(h, m, EI, N)
    ours = an.solve_many(beams)
    assert not ours.reason.any()
    solver = Subspace(SEGMENTS)

    def subspace():
        return np.array([solver.omega2(h[0], m[k], EI[k], N[k], MODES) for k in range(CASES)])

    def by_dense():
        return np.array([dense.omega2(h[0], m[k], EI[k], N[k], MODES) for k in range(20)])

    check("subspace", subspace(), ours.omega2, 1e-5)
    check("dense", by_dense(), ours.omega2[:20], 1e-5)
    mine, other, full = medians(15, lambda: an.solve_many(beams), subspace, by_dense)
    work = "6 certified bending frequencies, 100 segments, structure different in every case"
    evaluations = float(np.mean(ours.evaluations))
    return [
        row(work, "scipy banded subspace iteration, warm-started", 10, mine / CASES,
            other / CASES, evaluations=evaluations, figure="subspace"),
        row(work, "scipy dense eigh", 10, mine / CASES, full / 20, figure="dense"),
    ]  # fmt: skip


def sheared():
    """Six certified frequencies with shear and rotary inertia, structure different in every case.

    kGA and rho I are those of a thin tube of steel, 0.2 m wide: they follow from EI and m.
    """
    h, m, EI, N = smooth_case(_rng(), CASES)
    shear, rotary = EI * (0.5 * 0.385 * 8 / 0.2**2), m * (0.2**2 / 8)
    plain = an.BeamBatch(h, m, EI, N)
    beams = an.BeamBatch(h, m, EI, N, shear_stiffness=shear, rotary_inertia_per_length=rotary)
    ours, solver = an.solve_many(beams), TimoshenkoSubspace(SEGMENTS)
    assert not ours.reason.any()

    def subspace():
        cases = zip(m, EI, N, shear, rotary, strict=True)
        return np.array(
            [solver.omega2(h[0], a, b, c, MODES, kGA, rI) for a, b, c, kGA, rI in cases]
        )

    error = check("Timoshenko subspace", subspace(), ours.omega2, 2e-3)
    calls = lambda: an.solve_many(beams), lambda: an.solve_many(plain), subspace
    mine, without, other = (taken / CASES for taken in medians(15, *calls))
    work = "6 certified Timoshenko frequencies, 100 segments, structure different in every case"
    against = "scipy banded subspace iteration, warm-started, with Timoshenko elements"
    return [
        row(work, against, 8, mine, other, peer_error=float(f"{error:.2g}")),
        row(work, "Euler-Bernoulli here", 1.6, mine, without, most=True),
    ]


def loads():
    """The same where only the loads vary."""
    h, m, EI, N = smooth_case(_rng(), 1)
    factors = _rng().uniform(0.3, 1.5, 2000)
    basis = ReducedBasis(h, m[0], EI[0], N[0], (0.3, 0.9, 1.5))
    beams = an.BeamBatch(h, m, EI, factors[:, None] * N)
    ours = an.solve_many(beams)

    def reduced():
        return basis.omega2(factors, MODES)

    error = check("reduced basis", reduced(), ours.omega2, 2e-8)
    mine, other = (t / len(factors) for t in medians(15, lambda: an.solve_many(beams), reduced))
    work = "the same, only loads vary, true error <= 1e-8"
    against = "reduced basis, 8 modes at 3 conditions"
    more = {"peer_error": float(f"{error:.2g}"), "figure": "reduced basis"}
    return [row(work, against, 1, mine, other, **more)]


def single():
    """One solve in a running process."""
    h, m, EI, N = smooth_case(_rng(), 40)
    x, solver = np.linspace(0.0, LENGTH, SEGMENTS + 1), Subspace(SEGMENTS)

    def build(k):
        return an.Beam.from_stations(x, m[k], EI[k], None, N[k])

    beams = [build(k) for k in range(40)]
    one = _in_turn(lambda k: an.solve_many(an.BeamBatch(h, m[k], EI[k], N[k])))
    exact = np.array([one().omega2[0] for _ in range(40)])

    def checked(name, solve):
        found = np.array([solve(m[k], EI[k], N[k], MODES) for k in range(40)])
        check(name, found, exact, 1e-5)
        return _in_turn(lambda k: solve(m[k], EI[k], N[k], MODES))

    def with_states(m, EI, N, modes):
        solver.omega2(h[0], m, EI, N, modes)
        return solver.states(h[0], EI, N, modes)

    off = _states_off(beams, with_states, x[1] / 2)
    alone, built, ready, shapes, other, states = medians(
        201,
        one,
        _in_turn(lambda k: an.natural_frequencies(build(k), MODES)),
        _in_turn(lambda k: an.natural_frequencies(beams[k], MODES)),
        _in_turn(lambda k: an.solve_modes(beams[k], MODES, families=("bending",))),
        checked("subspace", lambda *case: solver.omega2(h[0], *case)),
        _in_turn(lambda k: with_states(m[k], EI[k], N[k], MODES)),
    )
    rows = [
        _single_row("frequencies (a batch of one)", alone, "subspace", other),
        _single_row("frequencies (a Beam built, natural_frequencies)", built, "subspace", other),
        _single_row("frequencies (natural_frequencies of a Beam)", ready, "subspace", other),
        _single_row("with shapes (solve_modes)", shapes, "subspace", other),
        row(
            "one solve, 100 segments, with shapes (solve_modes)",
            "the same with shapes, moments and shears at 200 places",
            *(1, shapes, states),
            most=True,
            peer_moment_error=off[2],
            peer_shear_error=off[3],
        ),
    ]
    for name, solve in _packages().items():
        times = medians(51, one, checked(name, solve))
        rows.append(_single_row("frequencies (a batch of one)", times[0], name, times[1]))
    return rows


def _states_off(beams, with_states, step):
    """How far the peer's Y, slope, M and shear are off, of their largest, at worst."""
    worst = np.zeros(4)
    for beam in beams[:10]:
        m, EI, N = (getattr(beam, name)[:, 0] for name in TABLES)
        found = with_states(m, EI, N, MODES).reshape(-1, 4, MODES)
        found[:, 1] /= 2 * step
        result = an.solve_modes(beam, MODES, families=("bending",))
        ours = result.at(step * np.arange(1, len(found)))
        first = len(result.modes) - MODES
        for k in range(MODES):
            mine, theirs = ours[:, first + k], found[1:, :, k]
            theirs = theirs * (theirs[:, 0] @ mine[:, 0]) / (theirs[:, 0] @ theirs[:, 0])
            worst = np.maximum(worst, np.max(np.abs(theirs - mine), 0) / np.max(np.abs(mine), 0))
    return [float(f"{value:.2g}") for value in worst]


def _packages():
    found, missing = packages.installed(LENGTH, SEGMENTS)
    for name, why in missing.items():
        print(f"no row for {name}: {why}")
    return found


def _in_turn(solve, cases=40):
    """Call for every case in turn."""
    turn = iter(range(10**9))
    return lambda: solve(next(turn) % cases)


def _single_row(what, antinode_s, peer, peer_s):
    names = {
        "subspace": "scipy banded subspace iteration, warm-started",
        "scikit-fem": "scikit-fem, Hermite elements, shift-inverted eigsh",
        "OpenSeesPy": "OpenSeesPy, elasticBeamColumn with P-Delta",
    }
    work = f"one solve, 100 segments, {what}"
    return row(work, names[peer], 0.5, antinode_s, peer_s, most=True, figure=peer)


def complex_modes():
    """Six complex modes with shapes: two dashpots, 100 segments that all differ."""
    beams = [damped_beam(seed) for seed in range(12)]
    peers = [StateSpace(beam, DASHPOTS) for beam in beams]
    starts = [np.sum(peer.inverted(MODES)[1], axis=1).real for peer in peers]
    for beam, peer in zip(beams, peers, strict=True):
        ours = an.solve_modes(beam, MODES, families=("bending",))
        assert ours.certificate["kind"] == "winding"
        s = np.array([mode.eigenvalue for mode in ours.modes])
        for found in (peer.dense()[0], peer.inverted(MODES)[0]):
            upper = sorted(found[found.imag > 0], key=abs)[:MODES]
            check("elements", np.array(upper), s, 1e-5)
    mine, warm, cold, full = medians(
        51,
        _in_turn(lambda k: an.solve_modes(beams[k], MODES, families=("bending",)), 12),
        _in_turn(lambda k: peers[k].inverted(MODES, starts[k - 1]), 12),
        _in_turn(lambda k: peers[k].inverted(MODES), 12),
        _in_turn(lambda k: peers[k].dense(), 12),
    )
    work = "6 complex modes with shapes, proven, two dashpots, 100 segments (solve_modes)"
    eigs = "scipy eigs, shift-invert by banded Cholesky, vectors"
    return [
        row(work, f"{eigs}, started from the beam before", 1, mine, warm, most=True),
        row(work, f"{eigs}, started afresh", 1, mine, cold, most=True),
        row(work, "scipy.linalg.eig on the state space of 200 unknowns, vectors", 20, mine, full),
    ]


def smooth():
    """A steep smooth beam to 1e-7: mesh and beam are built in every call."""
    tables = [steep_stations(seed) for seed in range(20)]
    turn = iter(range(10**9))

    def ours():
        x, m, EI, N = tables[next(turn) % 20]
        beam = an.Beam.from_stations(x, m, EI, None, N, interpolation="log")
        return an.natural_frequencies(beam, MODES, tolerance=TOLERANCE).omega2

    def theirs():
        return hp.omega2(*tables[next(turn) % 20], MODES)

    worst = [0.0, 0.0]
    for number, stations in enumerate(tables):
        x, m, EI, N = stations
        beam = an.Beam.from_stations(x, m, EI, None, N, interpolation="log")
        exact = an.natural_frequencies(beam, MODES, tolerance=1e-9).omega2
        turn = iter([number, number])
        found = ours(), theirs()
        for k in range(2):
            worst[k] = max(worst[k], float(np.max(np.abs(np.sqrt(found[k] / exact) - 1))))
    assert worst[0] <= 1e-7, worst
    turn = iter(range(10**9))
    mine, other = medians(201, ours, theirs)
    against = "9 aligned hp-elements of order 7, dense eigh, mesh built each time"
    more = {"error": float(f"{worst[0]:.2g}"), "peer_error": float(f"{worst[1]:.2g}")}
    work = "one solve of a smooth steep beam to 1e-7 true error"
    return [row(work, against, 0.5, mine, other, most=True, figure="hp", **more)]


def long_chain():
    """10,000 segments against 1,000."""
    beams = [stepped_beam(segments) for segments in (10_000, 1_000)]
    calls = [lambda beam=beam: an.solve_modes(beam, MODES, families=("bending",)) for beam in beams]
    return [row("one solve, 10,000 segments", "one with 1,000", 11, *medians(5, *calls), most=True)]


def cold_start():
    """Fresh processes."""
    found = {name: value["median_s"] for name, value in starts().items()}
    imports = found["import numpy, scipy.linalg"]
    mine = found["antinode modes"]
    return [
        {
            "work": "cold start of antinode modes",
            "against": "importing numpy and scipy.linalg",
            "ratio": float(f"{mine / imports:.3g}"),
            "target": "at most 1.0 s more",
            "met": mine - imports <= 1.0,
            "antinode_s": mine,
            "peer_s": imports,
        }
    ]


def calibration():
    """How fast the machine is, in two fixed jobs [s]."""
    A = np.random.default_rng(0).standard_normal((200, 200))
    libraries = list(c.libraries().values())
    calls = [lambda: eigh(A + A.T, check_finite=False)]
    calls += [lambda: c.calibrate(libraries[0])] if libraries else []
    taken = medians(15, *calls)
    return {n: float(f"{t:.3g}") for n, t in zip(figures.REFERENCE, taken, strict=False)}


def machine():
    now = calibration()
    own = {name: version(name) for name in ("antinode", "numpy", "scipy", "numba")}
    return {
        "date": f"{datetime.datetime.now(datetime.UTC):%Y-%m-%d}",
        "processor": _processor(),
        "cpu_count": os.cpu_count(),
        "python": platform.python_version(),
        "versions": {**own, **packages.versions()},
        "calibration_s": now,
        "scale": float(f"{figures.scale(now):.3g}"),
    }


def _processor():
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    wide = " with AVX-512" if any("avx512f" in line for line in lines) else ""
    return (names[0] if names else platform.machine()) + wide


PARTS = step, batch, sheared, loads, single, complex_modes, smooth, long_chain, cold_start


def main(given=None):
    """Run all parts and write the record; or only those that are named, and write nothing."""
    names = [part.__name__ for part in PARTS]
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=main.__doc__)
    parser.add_argument("parts", nargs="*", metavar="part", help=", ".join(names))
    asked = parser.parse_args(given).parts
    if unknown := [name for name in asked if name not in names]:
        parser.error(f"there is no part {unknown[0]!r}; there are {', '.join(names)}")
    where, rows = machine(), []
    before = where["calibration_s"]
    for part in PARTS:
        if asked and part.__name__ not in asked:
            continue
        found, after = part(), calibration()
        for one in found:
            rows.append(figures.judge(one, before, after))
            print(_line(one))
        before = after
    if asked:
        return
    for one in rows:
        one["machine"] = where
    table.RESULTS.write_text(json.dumps(rows, indent=2) + "\n", encoding="utf-8")
    table.write(rows)


def _line(one):
    found = f"{one['ratio']:8.3g}  ({one['target']})  {one['work']} / {one['against']}"
    if "peer_within" in one:
        taken, limit = table.duration(one["peer_s"]), table.duration(one["peer_scaled_limit_s"])
        found += f"; peer {taken}, {'within' if one['peer_within'] else 'ABOVE'} {limit}"
    return found


if __name__ == "__main__":
    sys.exit(main())
