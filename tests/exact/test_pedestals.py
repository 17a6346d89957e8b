"""A mass between two springs: closed forms, elements that carry it as an unknown, 60 digits."""

import json
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from following_beams import _scaled
from validation.counting_lateral import compare

import antinode as an
from antinode import Beam, Ends
from antinode.proof.prove import prove
from antinode.response.frequency import Model
from antinode.response.modal_sum import modal_response
from antinode.riccati.chain import count_below
from antinode.riccati.lanes.calls import evaluate
from cli_run import refused, run
from hp_beam import _breaks, _Mesh, _weighted, eigenvalues

ENDS = ("free", "clamped", "pinned", "sliding")
BACKENDS = ("numpy", "numba")


def uniform(left, right, EI=1.0, m=1.0, length=1.0, N=0.0):
    return Beam.from_stations(
        np.linspace(0, length, 3), np.full(3, m), np.full(3, EI), None, np.full(3, N),
        ends=Ends(left, right),
    )  # fmt: skip


def draw(seed):
    """A stepped beam under N with one to three pedestals, and other things at stations."""
    rng = np.random.default_rng([19, seed])
    n = int(rng.integers(2, 6))
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.3, 1.0, n))])
    EI, m = 10 ** rng.uniform(-0.5, 0.5, (2, n + 1))
    N = rng.choice([0.0, 1.0]) * rng.uniform(-12, 12, n + 1) / x[-1] ** 2
    ends = Ends(ENDS[seed % 4], ENDS[seed // 4 % 4])
    beam = Beam.from_stations(x, m, EI, None, N, ends=ends)
    held = {p for e, p in ((ends.left, 0), (ends.right, n)) if e in ("pinned", "clamped")}
    places = rng.permutation([k for k in range(n + 1) if k not in held])[: rng.integers(1, 4)]
    for k in places.tolist():
        a, b, c = 10 ** rng.uniform(-1.5, 1.5, 3)
        lower = b * rng.choice([0.0, 100.0, 1.0])
        beam = beam.with_attachments(an.Pedestal(float(x[k]), 0.3 * a, 100 * c, lower))
    k = int(rng.integers(0, n + 1))
    more = [an.PointMass(float(x[k]), 0.2), an.Spring(float(x[k]), 30.0, 2.0)]
    if 0 < k < n:
        more.append(an.Joint(float(x[k]), 0.3))
    return beam.with_attachments(more[rng.integers(len(more))])


@pytest.mark.parametrize("seed", range(100))
def test_random_chains_are_those_of_elements_with_the_mass_as_an_unknown(seed):
    beam = draw(seed)
    omega2 = eigenvalues(beam, 7, degree=9)
    chain = beam.chain("bending")
    low, high = omega2[:-1], omega2[1:]
    wide = high - low > 1e-6 * np.abs(high) + 1e-7 * abs(omega2[-1])
    assert np.sum(wide) >= 4
    middle = np.append((low + high)[wide] / 2, omega2[0] - 0.05 * omega2[-1])
    below = np.append(np.flatnonzero(wide) + 1, 0)
    for count in (count_below(chain, middle), evaluate(chain, middle).below):
        np.testing.assert_array_equal(count, below)
    found = an.natural_frequencies(beam, 6 - len(beam.freedoms("bending")), tolerance=1e-9).omega2
    for value in found:
        assert np.min(np.abs(omega2 - value)) < 3e-8 * (abs(value) + 1e-3 * omega2[-1])


def test_it_buckles_as_on_its_two_springs_in_line():
    beam = uniform("pinned", "pinned", N=1.0)
    item = an.Pedestal(0.5, 0.3, 60.0, 30.0)
    assert item.static_stiffness == pytest.approx(20.0, rel=1e-15)
    found, spring = (
        an.buckling(beam.with_attachments(i)).load_factor for i in (item, an.Spring(0.5, 20.0))
    )
    assert found == pytest.approx(spring, rel=1e-9)


@pytest.mark.parametrize("backend", BACKENDS)
def test_masses_hung_on_a_free_beam_go_along_with_its_rigid_modes(backend):
    items = an.Pedestal(0.2, 0.3, 50.0), an.Pedestal(0.9, 0.1, 2000.0)
    beam = uniform("free", "free").with_attachments(*items)
    result = an.solve_modes(beam, 3, families=["bending"], tolerance=1e-10, backend=backend)
    translation, rotation, *elastic = result.modes
    assert [translation.omega2, rotation.omega2] == [0.0, 0.0]
    assert translation.modal_mass == pytest.approx(1.4, rel=1e-12)
    centre = (0.5 + 0.3 * 0.2 + 0.1 * 0.9) / 1.4
    inertia = 1 / 12 + (0.5 - centre) ** 2 + 0.3 * (0.2 - centre) ** 2 + 0.1 * (0.9 - centre) ** 2
    most = max(centre, 1 - centre)
    assert rotation.modal_mass == pytest.approx(inertia / most**2, rel=1e-12)
    exact = eigenvalues(beam, 5, degree=13)[2:]
    np.testing.assert_allclose([m.omega2 for m in elastic], exact, rtol=1e-9)


@pytest.mark.parametrize(("left", "right"), [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0)])
def test_end_forces_may_follow(left, right):
    """Elements with the mass as an unknown, and the turning force on the end's displacement."""
    beam = uniform("free", "free", N=9.0)
    beam = Beam.from_stations(
        beam.x, np.ones(3), np.ones(3), None, np.full(3, 9.0),
        ends=Ends("free", "free", left_follower=left, right_follower=right),
    ).with_attachments(an.Pedestal(0.5, 0.2, 80.0, 40.0))  # fmt: skip
    result = an.solve_modes(beam, 3, families=["bending"], tolerance=1e-9)
    _, K, M, _ = _scaled(beam, 3, 3e3)
    theta = np.linalg.eigvals(np.linalg.solve(K - 0.1 * M, M))
    exact = 0.1 + 1 / theta[np.abs(theta) > 1e-9 * np.abs(theta).max()]
    for mode in result.modes:
        near = exact[np.argmin(np.abs(exact - mode.omega2))]
        assert mode.omega2 == pytest.approx(near.real, rel=1e-7, abs=1e-6)


def test_two_masses_on_a_beam_that_hardly_bends():
    """A stiff beam that moves up and down alone: m1 on k0, m2 between k1 and k2."""
    beam = uniform("sliding", "sliding", EI=1e9, m=3.0)
    k0, k1, k2, m2 = 40.0, 25.0, 9.0, 0.7
    beam = beam.with_attachments(an.Spring(0.5, k0), an.Pedestal(0.5, m2, k1, k2))
    K, M = np.array([[k0 + k1, -k1], [-k1, k1 + k2]]), np.diag([1 / 3.0, 1 / m2])
    exact = np.sort(np.linalg.eigvals(M @ K).real)
    found = an.natural_frequencies(beam, 2, tolerance=1e-10).omega2
    np.testing.assert_allclose(found, exact, rtol=1e-7)


def on_pinned_beam(k1, k2, m, count):
    """omega^2 of the symmetric modes of a pinned beam, EI = m = L = 1, with it at midspan."""

    def gap(beta):
        w = beta**4
        receptance = (mpmath.tan(beta / 2) - mpmath.tanh(beta / 2)) / (4 * beta**3)
        return (k1 + k2 - m * w + k1 * (k2 - m * w) * receptance) * mpmath.cos(beta / 2)

    with mpmath.workdps(40):
        betas = [mpmath.mpf(b) / 40 for b in range(4, 40 * 4 * count)]
        values = [gap(b) for b in betas]
        roots = [
            mpmath.findroot(gap, (a, b), solver="anderson", tol=1e-30)
            for a, b, u, v in zip(betas, betas[1:], values, values[1:], strict=False)
            if u * v < 0
        ]
        return np.array([float(r**4) for r in roots[:count]])


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("k2", [0.0, 30.0])
@pytest.mark.parametrize("m", [0.02, 0.3])
def test_an_absorber_at_midspan(backend, k2, m):
    beam = uniform("pinned", "pinned").with_attachments(an.Pedestal(0.5, m, 40.0, k2))
    exact = np.sort(
        np.append(on_pinned_beam(40.0, k2, m, 4), [(2 * k * np.pi) ** 4 for k in (1, 2)])
    )[:5]
    result = an.solve_modes(beam, 5, families=["bending"], tolerance=1e-10, backend=backend)
    found = np.array([mode.omega2 for mode in result.modes])
    np.testing.assert_allclose(found, exact, rtol=1e-10)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_mode_with_its_node_at_the_mass_at_its_own_frequency(backend):
    """omega^2 = (2 pi)^4 is the pole of the stiffness and a mode in which the mass rests."""
    k1, k2 = 40.0, 5.0
    m = (k1 + k2) / (2 * np.pi) ** 4
    beam = uniform("pinned", "pinned").with_attachments(an.Pedestal(0.5, m, k1, k2))
    exact = np.sort(np.append(on_pinned_beam(k1, k2, m, 3), (2 * np.pi) ** 4))[:4]
    result = an.solve_modes(beam, 4, families=["bending"], tolerance=1e-10, backend=backend)
    np.testing.assert_allclose([mode.omega2 for mode in result.modes], exact, rtol=1e-10)
    k = int(np.argmin(np.abs(exact - (2 * np.pi) ** 4)))
    shape = result.modes[k].shape
    np.testing.assert_allclose(shape, -shape[::-1], atol=1e-7)
    assert result.modes[k].modal_mass == pytest.approx(0.5, rel=1e-7)


@pytest.mark.parametrize("backend", BACKENDS)
def test_a_double_eigenvalue_of_mass_and_beam(backend):
    """The absorber is tuned so that a symmetric mode has the omega^2 of an antisymmetric one."""
    w, beta = (2 * np.pi) ** 4, 2 * np.pi
    wanted, k1 = 4 * beta**3 / np.tanh(np.pi), 100.0
    m = wanted * k1 / (w * (wanted - k1))
    beam = uniform("pinned", "pinned").with_attachments(an.Pedestal(0.5, m, k1))
    result = an.solve_modes(beam, 4, families=["bending"], tolerance=1e-10, backend=backend)
    found = np.array([mode.omega2 for mode in result.modes])
    assert np.sum(np.abs(found / w - 1) < 1e-10) == 2
    near = [mode for mode in result.modes if abs(mode.omega2 / w - 1) < 1e-9]
    a, b = (mode.shape for mode in near)
    assert np.linalg.matrix_rank(np.stack([a, b]), tol=1e-6) == 2


@pytest.mark.parametrize("backend", BACKENDS)
def test_energies_count_the_mass_and_both_springs(backend):
    """What a change of each number does to omega^2 is its energy over the modal mass."""
    beam = uniform("clamped", "free", N=0.7)
    base = {"mass": 0.4, "beam_stiffness": 30.0, "ground_stiffness": 12.0}

    def solved(**changed):
        own = beam.with_attachments(an.Pedestal(0.5, **(base | changed)))
        return an.solve_modes(own, 3, families=["bending"], tolerance=1e-11, backend=backend)

    result = solved()
    for k, mode in enumerate(result.modes):
        Y = float(np.interp(0.5, result.x, mode.shape))
        x = 30.0 * Y / (42.0 - 0.4 * mode.omega2)
        exact = {
            "mass": -mode.omega2 * x**2,
            "beam_stiffness": (Y - x) ** 2,
            "ground_stiffness": x**2,
        }
        for name, value in base.items():
            low, high = (
                solved(**{name: value * (1 + sign * 1e-4)}).modes[k].omega2 for sign in (-1, 1)
            )
            slope = (high - low) / (2e-4 * value) * mode.modal_mass
            assert slope == pytest.approx(exact[name], rel=2e-6)


FILE = """
[beam]
stations = { x = [0, 1], mass_per_length = [1, 1], bending_stiffness = [1, 1] }
[beam.ends]
left = "pinned"
right = "pinned"
[[beam.pedestals]]
x = "50 cm"
mass = "300 g"
beam_stiffness = "40 N/m"
"""


def test_a_file_holds_it_and_gives_it_back(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(FILE, encoding="utf-8")
    (own,) = an.load_beam(path).beam().attachments
    assert own == an.Pedestal(0.5, 0.3, 40.0, 0.0)
    assert run("convert", path, tmp_path / "again.toml").code == 0
    assert an.load_beam(tmp_path / "again.toml").beam().attachments == (own,)
    out = json.loads(run("beam", path, "--modes", "2", "--json").out)
    found = [m["omega2"] for m in out["modes"]]
    np.testing.assert_allclose(found, on_pinned_beam(40.0, 0.0, 0.3, 2), rtol=1e-8)
    refused(run("beam", path, "--set", "beam.pedestals.0.mass=0"), "mass")
    refused(run("beam", path, "--set", "beam.pedestals.0.x=1"), "held sideways")
    twice = FILE + FILE[FILE.index("[[beam.pedestals]]") :]
    path.write_text(twice, encoding="utf-8")
    refused(run("beam", path), "one pedestal")
    spring = FILE + '[[beam.springs]]\nx = 0.5\ntranslational = "inf"\n'
    path.write_text(spring, encoding="utf-8")
    refused(run("beam", path), "held sideways")


def driven_elements(beam, eta, omega):
    """Y at 0.75 for a unit force at 0.25, and a unit acceleration of the ground, by elements."""
    mesh = _Mesh(beam, "bending", _breaks(beam, "bending", 6, 1.6, 1.8), 11)
    K, M = np.zeros((mesh.size, mesh.size), complex), np.zeros((mesh.size, mesh.size))
    Ke, Me = _weighted(mesh.stiffness, mesh.top), _weighted(mesh.mass, mesh.value)
    for e, dofs in enumerate(mesh.dofs):
        K[np.ix_(dofs, dofs)] += (1 + 1j * eta) * Ke[e]
        M[np.ix_(dofs, dofs)] += Me[e]
    for dofs, k, m in mesh.points:
        K[np.ix_(dofs, dofs)] += k
        M[np.ix_(dofs, dofs)] += m
    nodes = np.concatenate([[0.0], np.cumsum(mesh.h)])
    left, right = (2 * int(np.argmin(np.abs(nodes - x))) for x in (0.25, 0.75))
    free = np.setdiff1d(np.arange(mesh.size), mesh.held)
    one, force = np.zeros(mesh.size), np.zeros(mesh.size)
    one[0 : 2 * len(nodes) : 2], force[left] = 1.0, 1.0
    one[[dofs[0] for dofs, _, m in mesh.points if len(dofs) == 1 and m.any()]] = 1.0
    y = np.zeros((mesh.size, 2), complex)
    loads = np.stack([force, omega**2 * M @ one], axis=1)
    y[free] = np.linalg.solve((K - omega**2 * M)[np.ix_(free, free)], loads[free])
    return (y[right] + [0, 1]) / [1, -(omega**2)]  # a unit acceleration


@pytest.mark.parametrize("lower", [0.0, 60.0])
def test_a_driven_beam_is_that_of_elements(lower):
    beam = Beam.from_stations(
        np.linspace(0, 1, 5), np.ones(5), np.ones(5), None, np.zeros(5), ends=Ends("pinned", "free")
    ).with_attachments(an.Pedestal(0.5, 0.3, 90.0, lower), an.Spring(0.0, rotational=5.0))
    omega = np.array([3.0, 9.0, 16.0, 17.3, 60.0, np.sqrt((90 + lower) / 0.3)])
    drives, output = (an.Force(0.25), an.Base()), an.Output(0.75, "displacement")
    exact = np.array([driven_elements(beam, 0.03, w) for w in omega]).T
    found = an.frequency_response(
        beam, omega / (2 * np.pi), drives, output, damping=an.Damping(loss_factor=0.03)
    )
    np.testing.assert_allclose(found.values[0], exact, rtol=2e-7)


def test_sums_of_modes_carry_the_mass():
    """Under a force, and under a moving ground, whose inertia moves the mass as well."""
    beam = Beam.from_stations(
        np.linspace(0, 1, 5), np.ones(5), np.ones(5), None, np.zeros(5), ends=Ends("pinned", "free")
    ).with_attachments(an.Pedestal(0.5, 0.3, 90.0, 60.0), an.Spring(0.0, rotational=5.0))
    omega, drives = np.array([3.0, 9.0, 17.3]), (an.Force(0.25), an.Base())
    output, damping = an.Output(0.75, "displacement"), an.Damping(loss_factor=1e-6)
    hz = omega / (2 * np.pi)
    exact = an.frequency_response(beam, hz, drives, output, damping=damping).values
    model = Model(beam, drives, (output,), damping, float(hz.max()))
    np.testing.assert_allclose(
        modal_response(model, hz, 12, 1e-3).values.real, exact.real, rtol=2e-4
    )


@pytest.mark.parametrize("seed", range(12))
def test_counts_with_all_columns_in_60_digits(seed):
    compared, wrong = compare(np.random.default_rng([19, seed]), pedestals=True)
    assert compared == 14
    assert wrong == 0


@pytest.mark.parametrize("tuned", [False, True])
def test_balls_prove_the_list(tuned):
    """With a pole among the modes, and with a mode of the beam at the pole."""
    pytest.importorskip("flint", reason="python-flint is not installed (extra prove)")
    m = 45.0 / (2 * np.pi) ** 4 if tuned else 0.3
    items = an.Pedestal(0.5, m, 40.0, 5.0), an.Joint(0.5, 0.1), an.Pedestal(1.0, 0.2, 9.0)
    beam = uniform("pinned", "free").with_attachments(*items[: 1 if tuned else 3])
    if tuned:
        beam = uniform("pinned", "pinned").with_attachments(items[0])
    result = an.solve_modes(beam, 4, families=["bending"])
    proof = prove(result)
    assert proof.verdict == "proven", proof.sentence
    fewer = replace(result, modes=result.modes[:1] + result.modes[2:])
    assert prove(fewer).verdict != "proven"


def test_how_far_the_masses_move_is_told():
    beam = uniform("pinned", "pinned").with_attachments(an.Pedestal(0.5, 0.3, 40.0, 5.0))
    result = an.solve_modes(beam, 3, families=["bending"])
    Y, omega2 = result.at(0.5)[0, :, 0], np.array([m.omega2 for m in result.modes])
    np.testing.assert_allclose(result.pedestal_motion, [40 * Y / (45 - 0.3 * omega2)], rtol=1e-9)
    (told,) = result.to_dict()["pedestals"]
    assert told["x_m"] == 0.5
    assert list(told["displacement"].values()) == result.pedestal_motion[0].tolist()
