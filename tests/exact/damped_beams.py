"""Random damped beams, and what else tells their eigenvalues s.

p-version finite elements of Timoshenko's energy in Y and psi, with dashpots, feedback and end
forces that turn as matrices, go through a dense solver of the linearised problem (LAPACK). Each of
its eigenvalues within the region starts a search for the zero of the determinant of what both
ends want, of exponentials in 40 digits. Nothing is shared with the solver but the beam.
"""

import mpmath
import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigvals

import antinode as an

DEGREE, PIECES = 9, 2
_STIFF = 1e-7  # shear flexibility by which elements stand for none


def random_beam(rng):
    """A stepped beam of random law, loads and attachments, of order one in all its units."""
    n = int(rng.integers(1, 5))
    x = np.concatenate([[0.0], np.cumsum(rng.uniform(0.4, 1.6, n))])
    x = x / x[-1]
    m, EI = (np.exp(rng.uniform(-0.6, 0.6, n + 1)) for _ in range(2))
    N = rng.choice([0.0, 1.0, 4.0, 15.0]) * rng.uniform(-0.4, 1.0, n + 1)
    columns = {}
    if rng.random() < 0.6:
        columns["shear_stiffness"] = np.exp(rng.uniform(3.5, 7.0, n + 1))
        columns["rotary_inertia_per_length"] = m * 10 ** rng.uniform(-4, -2.3)
    left = str(rng.choice(["free", "free", "clamped", "pinned"]))
    right = str(rng.choice(["free", "free", "free", "pinned", "sliding"]))
    shares = {}
    if right == "free" and rng.random() < 0.5:
        shares["right_follower"] = float(rng.uniform(0.3, 1.0))
    if left == "free" and rng.random() < 0.3:
        shares["left_follower"] = float(rng.uniform(0.3, 1.0))
    beam = an.Beam.from_stations(
        x, m, EI, axial_force=N, ends=an.Ends(left, right, **shares), **columns
    )
    items = []
    for _ in range(int(rng.integers(1, 4))):
        size = 10 ** rng.uniform(-1.5, 1.3)
        both = {"translational": size, "rotational": 0.1 * size * float(rng.random() < 0.4)}
        items.append(an.Dashpot(float(rng.choice(x)), **both))
    if rng.random() < 0.5:
        K = rng.normal(size=(2, 2)) * 10 ** rng.uniform(-1, 1.3)
        C = rng.normal(size=(2, 2)) * 10 ** rng.uniform(-2, 0)
        items.append(an.PointFeedback.of(float(rng.choice(x)), K, C))
    if rng.random() < 0.3:
        items.append(an.PointMass(float(rng.choice(x)), rng.uniform(0.05, 0.5), 0.01))
    if rng.random() < 0.3:
        items.append(an.Spring(float(rng.choice(x)), translational=rng.uniform(1, 50)))
    return beam.with_attachments(*items)


# --- what a beam is, read from its tables alone ------------------


def segments(beam):
    """h, m, EI, N, s and rho I of every interval."""
    shear, rotary = beam.shear_stiffness, beam.rotary_inertia_per_length
    for k, h in enumerate(np.diff(beam.x)):
        s = 0.0 if shear is None else 1 / shear[k, 0]
        r = 0.0 if rotary is None else rotary[k, 0]
        row = beam.mass_per_length, beam.bending_stiffness, beam.axial_force
        yield (h, *(table[k, 0] for table in row), s, r)


def matrices(beam, k):
    """M, C and K (2x2, of Y and psi) of all that sits at breakpoint k."""
    M, C, K = np.zeros((3, 2, 2))
    for item in beam.attachments:
        if item.x != beam.x[k]:
            continue
        if isinstance(item, an.PointMass):
            M += np.diag([item.mass, item.rotary_inertia])
        elif isinstance(item, an.Spring):
            K += np.diag([item.translational, item.rotational])
        elif isinstance(item, an.Dashpot):
            C += np.diag([item.translational, item.rotational])
        else:
            K, C = K + item.stiffness, C + item.damping
    share, side = beam.ends.follow, {0: 0, len(beam.x) - 1: 1}.get(k)
    if side is not None and share[side]:
        N = beam.axial_force[0, 0] if side == 0 else beam.axial_force[-1, -1]
        K[0, 1] += (-1, 1)[side] * share[side] * N
    return M, C, K


HELD = {"free": (), "clamped": (0, 1), "pinned": (0,), "sliding": (1,)}


# --- finite elements ------------------


def _basis():
    """Values and slopes of hats and bubbles at Gauss points of 0 ... 1, (points, degree + 1)."""
    t, w = legendre.leggauss(DEGREE + 3)
    value, slope = [(1 - t) / 2, (1 + t) / 2], [-0.5 + 0 * t, 0.5 + 0 * t]
    for k in range(2, DEGREE + 1):
        c = np.zeros(k)
        c[k - 1] = 1.0
        value.append(legendre.legval(t, legendre.legint(c, lbnd=-1)))
        slope.append(legendre.legval(t, c))
    return np.array(value).T, 2 * np.array(slope).T, w / 2


def elements(beam):
    """Eigenvalues s of finite elements, all of them."""
    u, du, w = _basis()
    rows = [(h / PIECES, *rest) for h, *rest in segments(beam) for _ in range(PIECES)]
    nodes, inner = len(rows) + 1, DEGREE - 1
    size = 2 * (nodes + len(rows) * inner)
    M, C, K = np.zeros((3, size, size))
    for e, (h, m, EI, N, s, r) in enumerate(rows):
        s = max(s, _STIFF)
        places = np.array([e, e + 1, *(nodes + e * inner + np.arange(inner))])
        Y, psi = 2 * places, 2 * places + 1
        weight = w * h
        uu, dd = (np.einsum("q,qi,qj->ij", weight, b, b) for b in (u, du / h))
        ud = np.einsum("q,qi,qj->ij", weight, du / h, u)
        alpha = 1 + s * N
        K[np.ix_(psi, psi)] += EI * dd + (alpha**2 / s - N - s * N * N) * uu
        K[np.ix_(Y, Y)] += dd / s
        K[np.ix_(Y, psi)] -= alpha / s * ud
        K[np.ix_(psi, Y)] -= alpha / s * ud.T
        M[np.ix_(Y, Y)] += m * uu
        M[np.ix_(psi, psi)] += max(r, 1e-9 * m) * uu
    for k in range(len(beam.x)):
        own = 2 * k * PIECES + np.arange(2)
        for total, part in zip((M, C, K), matrices(beam, k), strict=True):
            total[np.ix_(own, own)] += part
    held = [*HELD[beam.ends.left], *(2 * (nodes - 1) + i for i in HELD[beam.ends.right])]
    free = np.setdiff1d(np.arange(size), held)
    M, C, K = (part[np.ix_(free, free)] for part in (M, C, K))
    L = np.linalg.inv(np.linalg.cholesky(M))
    K, C = L @ K @ L.T, L @ C @ L.T
    n = len(K)
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-K, -C]])
    return eigvals(state)


# --- many digits ------------------


def determinant(beam, s):
    """Of what the right end wants, of the states that the left end admits, in mpmath."""
    held = HELD[beam.ends.left]
    z = mpmath.zeros(4, 2)
    free = [i for i in range(4) if i not in _zeros(held)]
    for column, i in enumerate(free):
        z[i, column] = 1
    for k, (h, m, EI, N, shear, rotary) in enumerate(segments(beam)):
        z = _loaded(beam, k, s) * z
        z = _transfer(h, m, EI, N, shear, rotary, s) * z
    z = _loaded(beam, len(beam.x) - 1, s) * z
    a, b = _zeros(HELD[beam.ends.right])
    return z[a, 0] * z[b, 1] - z[a, 1] * z[b, 0]


def _zeros(held):
    """Components of [Y, psi, M, Q] that an end sets to zero."""
    return sorted([*held, *(3 - i for i in (0, 1) if i not in held)])


def _loaded(beam, k, s):
    M, C, K = matrices(beam, k)
    A = [
        [s * s * float(M[i, j]) + s * float(C[i, j]) + float(K[i, j]) for j in (0, 1)]
        for i in (0, 1)
    ]
    T = mpmath.eye(4)
    T[3, 0], T[3, 1] = -A[0][0], -A[0][1]
    T[2, 0], T[2, 1] = A[1][0], A[1][1]
    return T


def _transfer(h, m, EI, N, shear, rotary, s):
    """``Z exp(lambda h) Z^-1`` of the four exponentials of one uniform segment."""
    h, m, EI, N, shear, rotary = (mpmath.mpf(float(v)) for v in (h, m, EI, N, shear, rotary))
    alpha, beta, mu = 1 + shear * N, N + shear * N**2 - rotary * s * s, -m * s * s
    b, c = (shear * mu + beta / EI) / 2, mu / EI * (alpha**2 - shear * beta)
    squares = [-b + sign * mpmath.sqrt(b * b + c) for sign in (1, -1)]
    Z, E = mpmath.zeros(4, 4), mpmath.zeros(4, 4)
    for j, lam in enumerate(sign * mpmath.sqrt(q) for q in squares for sign in (1, -1)):
        Q = (EI * lam**2 + beta) / alpha
        Z[0, j], Z[1, j], Z[2, j], Z[3, j] = lam * Q / mu, 1, EI * lam, Q
        E[j, j] = mpmath.exp(lam * h)
    return Z * E * mpmath.inverse(Z)


def refined(beam, start, zeros):
    """The zero of D(s)/s^zeros next to a start."""
    with mpmath.workdps(40):
        s, step = mpmath.mpc(start), mpmath.mpf(10) ** -5
        starts = (s, s * (1 + step), s * (1 + 1j * step))
        root = mpmath.findroot(
            lambda z: determinant(beam, z) / z**zeros,
            starts,
            solver="muller",
            tol=1e-28,
            maxsteps=60,
            verify=False,
        )
        return complex(root)


def reference(beam, radius, zeros):
    """All eigenvalues in a circle with Im s >= 0, but those at zero."""
    rough = elements(beam)
    rough = rough[(np.abs(rough) < 1.05 * radius) & (rough.imag > -1e-6 * np.abs(rough) - 1e-4)]
    found = []
    for start in rough[np.argsort(-np.abs(rough))]:
        if abs(start) < 1e-9:
            start = 1e-3 + 1e-3j
        root = refined(beam, start, zeros)
        if abs(root.imag) < 1e-11 * abs(root):
            root = complex(root.real)
        near = any(abs(root - other) < 1e-10 * abs(root) for other in found)
        if 1e-6 < abs(root) < radius and root.imag >= 0 and not near:
            found.append(root)
    return np.array(found)


def compared(beam, modes=5):
    """Missing, spurious, largest error over the stated one, relative error, whether proven."""
    result = an.solve_modes(beam, modes, families=["bending"], backend="numpy", damping="complex")
    record, region = result.certificate["record"], result.certificate["region"]
    every = [m for m in result.modes if m.kind != "rigid"]
    mine = np.array([m.eigenvalue_per_s for m in every])
    error = np.array([m.error_per_s for m in every])
    exact = reference(beam, region["abs_s_below"], record["at_zero"])
    shown = max((s.imag for s in mine), default=0.0)
    wanted = exact.imag <= shown * (1 + 1e-9)  # the list ends with the last one asked for
    gap = np.abs(mine[:, None] - exact[None, :])
    missing = int(np.sum(np.min(gap, axis=0)[wanted] > 1e-6 * np.abs(exact[wanted])))
    off = np.min(gap, axis=1)
    spurious = int(np.sum(off > 1e-6 * np.abs(mine)))
    total = 2 * int(np.sum(exact.imag > 0)) + int(np.sum(exact.imag == 0)) + record["at_zero"]
    if total != record["eigenvalues"]:
        missing += abs(record["eigenvalues"] - total)
    proven = result.certificate["kind"] == "winding"
    return missing, spurious, float(np.max(off / error)), float(np.max(off / np.abs(mine))), proven
