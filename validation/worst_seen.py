"""The worst errors that the tests of docs/validation.md allow to happen, measured.

Goes through the same cases as the tests and prints, row by row, the largest error met. Takes about
five minutes; writes validation/worst_seen.md.

    python validation/worst_seen.py
"""

import datetime
import platform
import sys
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

import numpy as np
from hypothesis import given, settings

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("", "exact", "unit/vehicle", "invariance")
sys.path[:0] = [str(ROOT / "tests" / folder) for folder in FOLDERS]

import hermite  # noqa: E402
import test_attachments as attached  # noqa: E402
import test_axial_force as axial  # noqa: E402
import test_beam_invariance as invariance  # noqa: E402
import test_loads as loads  # noqa: E402
import test_segment as segment  # noqa: E402
import test_stepped_beam as stepped  # noqa: E402
import test_uniform_beam as uniform  # noqa: E402
from modes_tools import chain_matrices  # noqa: E402

import reference  # noqa: E402
from antinode import Beam, Ends, load_case, solve_modes  # noqa: E402
from antinode.modes.buckling import buckling  # noqa: E402
from antinode.riccati.roots import find_eigenvalues  # noqa: E402
from antinode.riccati.segment import lateral_transfer, wave_number  # noqa: E402
from law_chains import bar_chain, bending_chain  # noqa: E402

ENDS = uniform.ENDS


def frequency_error(omega2, exact):
    return abs(float(omega2 / exact - 1)) / 2


def uniform_beams(segments, modes, pairs=uniform.PAIRS):
    """Frequencies of uniform beams, relative."""
    return max(
        uniform.check(
            uniform.uniform_chain(segments, *pair),
            reference.uniform_beam_roots(*pair, modes),
            4,
            1e-10,
        )
        for pair in pairs
    )


def uniform_bars(segments, modes):
    one = np.ones(segments)
    return max(
        uniform.check(
            bar_chain(one / segments, one, one, left, right),
            reference.uniform_bar_roots(left, right, modes),
            2,
            1e-10,
        )
        for left in ("free", "fixed")
        for right in ("free", "fixed")
    )


def pinned_columns(load):
    worst = 0.0
    for segments in (1, 10, 100, 1000):
        chain = uniform.uniform_chain(segments, "pinned", "pinned", load * axial.EULER)
        for value in find_eigenvalues(chain, 20):
            exact = reference.pinned_axial_omega2(value.index, load * axial.EULER)
            worst = max(worst, frequency_error(value.omega2, exact))
    return worst


def constant_force(left, right):
    worst = 0.0
    for segments in (1, 50, 1000):
        for N in (-200.0, -20.0, 1.0, 2.0, 20.0):
            chain = uniform.uniform_chain(segments, left, right, N)
            for value in find_eigenvalues(chain, 12, zeros=int(left == "free")):
                if value.omega2 != 0.0:
                    exact = reference.uniform_axial_root(left, right, N, value.bracket)
                    worst = max(worst, frequency_error(value.omega2, exact))
    return worst


def stepped_beams(segments, decades):
    worst = 0.0
    for seed in range(12):
        h, m, EI, N, left, right = stepped.stepped(seed, segments, decades)
        exact = reference.BeamChain(tuple(h), tuple(EI), tuple(m), tuple(N), left, right)
        zeros = int({left, right} <= {"free", "sliding"})
        for value in find_eigenvalues(bending_chain(h, m, EI, N, left, right), 6, zeros=zeros):
            if value.omega2 != 0.0:
                root = reference.chain_root(exact, *sorted(value.bracket, key=abs))
                worst = max(worst, frequency_error(value.omega2, root))
    return worst


def transfer_matrices():
    worst, EI = 0.0, 7.0
    for N in (-30.0, -1.0, 0.0, 1.0, 30.0):
        for inertia in (-50.0, -1e-8, 0.0, 1e-8, 3.0, 50.0, -(30.0**2) / 4 / EI):
            for phase in (1e-3, 0.3, 1.5):
                bound = float(wave_number(*map(np.array, (N / EI, inertia / EI))))
                h = phase / max(bound, 1e-3)
                A = [[0, 1, 0, 0], [0, 0, 1 / EI, 0], [0, -N, 0, 1], [inertia, 0, 0, 0]]
                U = lateral_transfer(*map(np.array, (h, EI, N, inertia)))
                exact = segment.exponential(np.array(A, dtype=float), h)
                here = np.where(exact == 0, 0.0, np.abs(U / np.where(exact == 0, 1, exact) - 1))
                worst = max(worst, float(here.max()))
    return worst


def difference(beam, other, factor=1.0):
    """Largest relative difference of omega^2 (one at zero against the largest)."""
    a, b = invariance.omega2(other) * factor, invariance.omega2(beam)
    return float(np.max(np.abs(a - b) / np.maximum(np.abs(b), 1e-4 * np.abs(b).max())))


def reversing():
    beams = [invariance.some_beam(ends=(left, right)) for left in ENDS for right in ENDS]
    return max(difference(beam, beam.reversed()) for beam in beams)


def splitting():
    beam, worst = invariance.some_beam(), 0.0
    names = ("mass_per_length", "bending_stiffness", "axial_stiffness", "axial_force")
    for pieces in (2, 3, 17, 500):
        x = np.interp(np.arange(9 * pieces + 1) / pieces, np.arange(10), beam.x)
        tables = {name: np.repeat(getattr(beam, name), pieces, axis=0) for name in names}
        worst = max(worst, difference(beam, replace(beam, x=x, **tables)))
    return worst


def moving():
    beam = invariance.some_beam()
    return max(difference(beam, replace(beam, x=beam.x + origin)) for origin in (-7.0, 1e3))


def scaling():
    beam, worst = invariance.some_beam(), 0.0
    for length in (1e-3, 1e3):
        for mass in (1e-6, 1e6):
            for time in (1e-3, 1e3):
                force = mass * length / time**2
                scaled = replace(
                    beam,
                    x=beam.x * length,
                    mass_per_length=beam.mass_per_length * mass / length,
                    bending_stiffness=beam.bending_stiffness * force * length**2,
                    axial_stiffness=beam.axial_stiffness * force,
                    axial_force=beam.axial_force * force,
                )
                worst = max(worst, difference(beam, scaled, time**2))
    return worst


def random_beam(seed, decades=2.0, ends=("free", "free")):
    """The beams of tests/exact/test_modes.py."""
    rng = np.random.default_rng(seed)
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.3, 1.0, 12))])
    EI = 10.0 ** rng.uniform(0, decades, 13)
    m = 10.0 ** rng.uniform(0, decades / 2, 13)
    N = rng.uniform(-0.3, 1, 13) * 3.0 * EI.min() / x[-1] ** 2
    return Beam.from_stations(x, m, EI, 1e3 * EI, N, ends=Ends(*ends))


def orthogonality():
    """Largest relative product of two modes by mass, by stiffness; error of Rayleigh quotients."""
    mass_worst = stiffness_worst = quotient_worst = 0.0
    for left in ENDS:
        for right in ENDS:
            for decades in (1.0, 6.0):
                result = solve_modes(random_beam(7, decades, (left, right)), 8)
                omega2 = np.array([mode.omega2 for mode in result.family("bending")])
                mass, stiffness = chain_matrices(result)
                scale, highest = np.diag(mass), np.abs(omega2).max()
                size = np.sqrt(np.outer(scale, scale))
                off = ~np.eye(len(omega2), dtype=bool)
                mass_worst = max(mass_worst, np.abs(mass / size)[off].max())
                stiffness_worst = max(
                    stiffness_worst, np.abs(stiffness / size)[off].max() / highest
                )
                quotient = np.abs(np.diag(stiffness) / scale - omega2)
                quotient_worst = max(
                    quotient_worst, np.max(quotient / np.maximum(np.abs(omega2), 1e-3 * highest))
                )
    return mass_worst, stiffness_worst, quotient_worst


def attachments():
    """One mass, spring, support or joint at a time against Hermite elements, relative omega^2."""
    worst = 0.0
    for item in attached.EACH.values():
        for left in ENDS:
            for right in ENDS:
                problem = attached.beam(left, right).with_attachments(item)
                found = np.array([m.omega2 for m in solve_modes(problem, 6).family("bending")])
                other = hermite.eigenvalues(problem, len(found), 40)
                size = np.maximum(np.abs(other), 1e-2 * abs(other[-1]))
                worst = max(worst, float(np.max(np.abs(found - other) / size)))
    return worst


def euler_loads():
    """Load factors of uniform columns against Euler's, relative."""
    cases = {
        ("pinned", "pinned"): 1.0,
        ("clamped", "free"): 0.25,
        ("clamped", "clamped"): 4.0,
        ("sliding", "pinned"): 0.25,
        ("free", "free"): 1.0,
        ("clamped", "sliding"): 1.0,
    }
    worst = 0.0
    for ends, factor in cases.items():
        beam = Beam.from_stations([0.0, 1.0], 1.0, 1.0, None, 2.0, ends=Ends(*ends))
        worst = max(worst, abs(buckling(beam).load_factor / (factor * np.pi**2 / 2) - 1))
    return worst


def load_checks():
    worst = 0.0

    @settings(derandomize=True, deadline=None, max_examples=200, database=None)
    @given(loads.cases())
    def collect(case):
        nonlocal worst
        body, at, model = case
        worst = max(worst, loads.compute_loads(body, at, model=model).checks.worst)

    collect()
    return worst


def order_of_convergence():
    """Smallest and largest observed order of the two half-segments, six modes, three halvings."""
    x = np.linspace(0, 1, 3)
    beam = Beam.from_stations(
        x, 1 + x, (1 + x) ** 3, None, 2 * x, interpolation="linear", ends=Ends("free", "clamped")
    )
    found = np.array(
        [[v.omega2 for v in find_eigenvalues(beam.chain("bending", r), 6)] for r in (1, 2, 4, 32)]
    )
    error = np.abs(found[:3] - found[3])
    order = np.log2(error[:-1] / error[1:])
    return float(order.min()), float(order.max())


def starter():
    targets = np.array([3.25, 10.54, 20.68, 33.67, 48.56, 64.08])
    case = load_case(ROOT / "src" / "antinode" / "examples" / "starter" / "case.toml")
    return float(np.max(np.abs(solve_modes(case).frequencies_hz() / targets - 1)))


def rows():
    yield "transfer matrix of a segment", transfer_matrices()
    for segments in (1, 10, 100):
        yield f"uniform beam, 16 pairs, {segments} segments, 60 modes", uniform_beams(segments, 60)
    yield "uniform beam, 16 pairs, 1000 segments, 12 modes", uniform_beams(1000, 12)
    yield "uniform beam, 16 pairs, 10000 segments, 4 modes", uniform_beams(10_000, 4)
    two = [("free", "free"), ("clamped", "free")]
    yield "uniform beam, 2 pairs, 10000 segments, mode 60", uniform_beams(10_000, 62, two)
    for load in (-5.0, -1.0, 0.0, 0.5, 0.9, 0.99, 1.5):
        yield f"pinned-pinned, N = {load:g} Euler load", pinned_columns(load)
    yield "free-free under constant N", constant_force("free", "free")
    yield "clamped-free under constant N", constant_force("clamped", "free")
    for segments, modes in ((1, 60), (10, 60), (1000, 60), (10_000, 6)):
        yield f"uniform bar, {segments} segments, {modes} modes", uniform_bars(segments, modes)
    for segments, decades in ((3, 1), (7, 3), (12, 6)):
        name = f"stepped beam, {segments} segments, EI over {decades} decades"
        yield name, stepped_beams(segments, decades)
    yield "reversing the axis", reversing()
    yield "splitting segments", splitting()
    yield "moving the origin", moving()
    yield "scaling the units", scaling()
    yield from zip(
        ("orthogonality by mass", "orthogonality by stiffness less force", "Rayleigh quotient"),
        orthogonality(),
        strict=True,
    )
    yield "point masses, springs, supports, joints", attachments()
    yield "Euler loads", euler_loads()
    yield "balance of N, Q, M at the ends", load_checks()
    yield "starter vehicle against its targets", starter()


def main():
    packages = ", ".join(f"{name} {version(name)}" for name in ("antinode", "numpy", "scipy"))
    lines = [
        "# Worst errors seen",
        "",
        f"By `python validation/worst_seen.py`, {datetime.datetime.now(datetime.UTC):%Y-%m-%d}, "
        f"Python {platform.python_version()}, {packages}.",
        "Errors of frequencies are relative; those of invariance are of omega^2, relative.",
        "",
        "| case | worst |",
        "|---|---|",
    ]
    print("\n".join(lines))
    for name, worst in rows():
        lines.append(f"| {name} | {float(worst):.1e} |")
        print(lines[-1], flush=True)
    low, high = order_of_convergence()
    lines.append(f"| order of the half-segments (4 expected) | {low:.2f} to {high:.2f} |")
    print(lines[-1])
    record = ROOT / "validation" / "worst_seen.md"
    record.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
