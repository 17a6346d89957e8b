"""Springs that couple displacement and slope: pile heads, springs on an arm; definite or not."""

from dataclasses import replace

import hermite
import numpy as np
import pytest
from mpmath import cos, cosh, findroot, mp, mpf, sin, sinh

import antinode as an
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.riccati.chain import count_below, evaluate
from antinode.riccati.lanes import calls
from exact.test_counting_attachments import STATIONS, draw


@pytest.mark.parametrize("seed", range(60))
def test_counts_between_the_eigenvalues(seed):
    """Against Hermite elements; every third spring is indefinite, k k_r < k_c^2."""
    rng = np.random.default_rng([16, seed])
    beam = draw(seed)
    for _ in range(2):
        k, turning = 10.0 ** rng.uniform(-1, 1.5, 2)
        size = np.sqrt(k * turning) * rng.choice([0.3, 0.9, 1.5])
        coupling = size * rng.choice([-1, 1])
        x = float(rng.choice(STATIONS))
        beam = beam.with_attachments(Spring(x, k, turning, coupling=coupling))
    values = hermite.eigenvalues(beam, 8, elements=16, shift=3000.0)
    scale = abs(values[-1])
    low, high = values[:-1], values[1:]
    wide = high - low > 1e-4 * np.maximum(np.abs(low), np.abs(high)) + 1e-5 * scale
    middle = np.where(low > 0, np.sqrt(np.abs(low * high)), (low + high) / 2)
    points = np.append(middle[wide], values[0] - 0.05 * scale)
    expected = np.append(np.arange(1, 8)[wide], 0)
    np.testing.assert_array_equal(count_below(beam.chain("bending"), points), expected)
    compiled = calls.evaluate(beam.chain("bending"), points)
    readable = evaluate(beam.chain("bending"), points)
    np.testing.assert_array_equal(compiled.below, expected)
    assert np.sign(compiled.characteristic).tolist() == np.sign(readable.characteristic).tolist()


K, TURNING, COUPLING = 7.0, 2.0, -3.0


def cantilever(spring):
    beam = an.Beam.from_stations([0, 1], [1, 1], [1, 1], ends=an.Ends("clamped", "free"))
    return beam.with_attachments(spring)


def exact_omega2(guess):
    """A uniform cantilever with the spring at its tip, in closed form."""

    def D(omega2):
        b = mp.sqrt(mp.sqrt(omega2))
        c, s, C, S = cos(b), sin(b), cosh(b), sinh(b)
        shapes = [
            (C - c, b * (S + s), b**2 * (C + c), b**3 * (S - s)),
            (S - s, b * (C - c), b**2 * (S + s), b**3 * (C + c)),
        ]
        rows = [
            (Q - K * Y - COUPLING * turn, M + COUPLING * Y + TURNING * turn)
            for Y, turn, M, Q in shapes
        ]
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]

    return float(findroot(D, mpf(guess)))


@pytest.mark.parametrize("backend", ["numpy", "numba"])
def test_a_cantilever_on_a_coupled_spring(backend):
    beam = cantilever(Spring(1.0, K, TURNING, coupling=COUPLING))
    with mp.workdps(30):
        for solve in (an.natural_frequencies, lambda *a, **k: an.solve_modes(*a, **k)):
            found = solve(beam, 4, backend=backend)
            omega2 = [m.omega2 for m in found.modes] if hasattr(found, "modes") else found.omega2
            for value in omega2:
                assert value == pytest.approx(exact_omega2(value), rel=1e-10)


def test_a_spring_on_an_arm_is_a_spring_beyond_the_beam():
    """k at the distance d: [[k, k d], [k d, k d^2]]; a pinned one leaves one rigid motion."""
    k, d = 40.0, 0.3
    arm = cantilever(Spring(1.0, k, k * d * d, coupling=k * d))
    x, EI, m = [0, 1, 1 + d], [1, 1e7, 1e7], [1, 1e-9, 1e-9]
    long = an.Beam.from_stations(x, m, EI, ends=an.Ends("clamped", "free"))
    beyond = long.with_attachments(Spring(1 + d, k))
    f, g = (an.natural_frequencies(b, 3).omega2 for b in (arm, beyond))
    assert f == pytest.approx(g, rel=1e-6)
    free = replace(arm, ends=an.Ends())
    assert free.freedoms("bending").tolist() == [[-(1 + d), 1.0]]
    assert (
        len(replace(free, attachments=(Spring(1.0, k, 1.0, coupling=2.0),)).freedoms("bending"))
        == 0
    )


def test_shapes_move_the_frequency_as_they_say():
    """d(omega^2)/dk_c = 2 Y theta/modal mass."""
    at = 1.1

    def beam(coupling):
        bare = an.Beam.from_stations([0, 1.1, 2], [1, 2, 2], [5, 3, 3], None, [1, -2, -2])
        return bare.with_attachments(
            Spring(at, 30, 20, coupling=coupling), Spring(2, 5), PointMass(at, 0.7, 0.1, 0.2)
        )

    result = an.solve_modes(beam(4.0), 3, families=("bending",))
    above, below = (an.natural_frequencies(beam(4.0 + s), 3).omega2 for s in (1e-4, -1e-4))
    for k in (1, 2, 3):
        mode = result.mode("bending", k)
        Y, theta = result.at(np.array([at]), "bending")[0, result.modes.index(mode), :2]
        slope = (above - below)[k - 1] / 2e-4
        assert slope == pytest.approx(2 * Y * theta / mode.modal_mass, rel=1e-6)


def test_read_from_the_other_end_it_is_the_same():
    beam = an.Beam.from_stations([0, 0.4, 1], [1, 2, 2], [5, 3, 3], None, [1, -2, -2])
    beam = beam.with_attachments(
        Spring(0.4, 30, 20, coupling=35.0), Joint(0.7, 0.1), Spring(0, 3, 2)
    )
    f, g = (an.natural_frequencies(b, 3).omega2 for b in (beam, beam.reversed()))
    assert g == pytest.approx(f, rel=1e-9)


def test_files_keep_it_and_refuse_what_it_cannot_be(tmp_path):
    text = """
[beam]
stations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1] }
[[beam.springs]]
x = 1
translational = "7 N/m"
rotational = 2
coupling = "-3 N"
"""
    path = tmp_path / "beam.toml"
    path.write_text(text)
    beam = an.load_beam(path).beam()
    assert beam.attachments == (Spring(1.0, 7.0, 2.0, coupling=-3.0),)
    from antinode.exchange.inputs import Choices, read_beam
    from antinode.exchange.outputs import write_beam

    for how in ("toml", "xlsx"):
        write_beam(tmp_path / f"again.{how}", beam, how)
        assert read_beam(tmp_path / f"again.{how}", how, Choices()).beam == beam
    path.write_text(text.replace("2\n", "inf\n"))
    with pytest.raises(an.InputError, match="coupling beside an infinite stiffness"):
        an.load_beam(path)
