"""An independent reference for beams whose m, EI, EA and N vary: hp finite elements in float64.

Energy matrices of the weak form (bending: int EI Y''^2 - N Y'^2 dx = omega^2 int m Y^2 dx; bars:
int EA X'^2 dx = omega^2 int m X^2 dx) on elements that end at stations and are short against the
steepness of the tables and the shortest wave asked for. An element carries its nodal polynomials
(Hermite cubics; linears) and the bubbles whose leading derivative is a Legendre polynomial.
Eigenvectors come from ``M v = mu (K + shift M) v``, scaled to a unit diagonal; eigenvalues from
their Rayleigh quotients, summed at the Gauss points, where every term is a square: that keeps the
low eigenvalues as exact as the high ones (after one Rayleigh-Ritz step that parts rigid modes).
Nothing is shared with the solver: no transfer matrices, no chains, its own interpolation and its
own weight above a point.

`eigenvalues` returns values; `reference` also tells how far two meshes with different degrees
disagree, which bounds their error, for it falls by many orders from one to the next.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import LinAlgError, cholesky, eigh

_HELD = {"free": (), "pinned": (0,), "sliding": (1,), "clamped": (0, 1), "fixed": (0,)}


class Reference(NamedTuple):
    """Eigenvalues omega^2 [rad^2/s^2], ascending, and the relative disagreement of two meshes."""

    omega2: np.ndarray
    spread: np.ndarray


def reference(beam, count, family="bending"):
    """The lowest `count` eigenvalues, negative ones included, with their own convergence."""
    fine = eigenvalues(beam, count, family, degree=13, phase=2.4, ratio=2.5)
    other = eigenvalues(beam, count, family, degree=11, phase=2.7, ratio=2.8)
    floor = 1e-13 * np.max(np.abs(fine))  # exact zeros have no relative error
    return Reference(fine, np.abs(fine - other) / np.maximum(np.abs(fine), floor))


def eigenvalues(beam, count, family="bending", *, degree=13, phase=2.4, ratio=2.5):
    """The lowest `count` eigenvalues omega^2 on one mesh.

    An element is at most `phase` long in wave number times length (of mode `count`, by the phase
    integral), and no property changes by more than the factor `ratio` in it.
    """
    mesh = _Mesh(beam, family, _breaks(beam, family, count, phase, ratio), degree)
    size = mesh.size
    K, M = np.zeros((size, size)), np.zeros((size, size))
    Ke = _weighted(mesh.stiffness, mesh.top) - _weighted(mesh.force, mesh.slope)
    Me = _weighted(mesh.mass, mesh.value)
    for e in range(len(mesh.h)):
        K[np.ix_(mesh.dofs[e], mesh.dofs[e])] += Ke[e]
        M[np.ix_(mesh.dofs[e], mesh.dofs[e])] += Me[e]
    for dofs, k, m in mesh.points:
        K[np.ix_(dofs, dofs)] += k
        M[np.ix_(dofs, dofs)] += m
    free = np.setdiff1d(np.arange(size), mesh.held)
    vectors = np.zeros((size, count))
    vectors[free] = _lowest(K[np.ix_(free, free)], M[np.ix_(free, free)], count)
    _, mix = eigh(*mesh.forms(vectors))
    K, M = mesh.forms(vectors @ mix)
    return np.sort(np.diag(K) / np.diag(M))


def _lowest(K, M, count):
    shift = 1e-6 * np.min(np.diag(K) / np.diag(M))
    while True:
        A = K + shift * M
        d = np.diag(A)
        if np.all(d > 0):
            d = 1 / np.sqrt(d)
            A, B = A * np.outer(d, d), M * np.outer(d, d)
            try:
                cholesky(A - 1e-13 * np.eye(len(A)))
                break
            except LinAlgError:
                pass
        shift *= 10.0
    n = len(A)
    _, v = eigh(B, A, subset_by_index=[n - count, n - 1])
    return v * d[:, None]


def _weighted(weights, basis):
    """int w u_i u_j over every element, (elements, i, j)."""
    return np.einsum("eq,eqi,eqj->eij", weights, basis, basis, optimize=True)


def _value(values, k, t, how):
    a, b = values[k, 0][:, None], values[k, 1][:, None]
    return a ** (1 - t) * b**t if how == "log" else (1 - t) * a + t * b


def _breaks(beam, family, count, phase, ratio):
    """Fractions at which every interval is cut into elements."""
    main = beam.bending_stiffness if family == "bending" else beam.axial_stiffness
    tables, power = (beam.mass_per_length, main), 4 if family == "bending" else 2
    everything = np.arange(len(beam.x) - 1)
    grid = np.concatenate([[0], np.geomspace(1e-7, 0.5, 300)])
    t = np.concatenate([grid, 1 - grid[-2::-1]])[None, :]
    m, s = (_value(values, everything, t, beam.interpolation) for values in tables)
    dx = np.diff(t, axis=1) * np.diff(beam.x)[:, None]
    wave = (m / s) ** (1 / power)
    wave = (wave[:, 1:] + wave[:, :-1]) / 2 * dx
    wave *= (count + 1) * np.pi / np.sum(wave) / phase
    steep = [np.abs(np.diff(np.log(p), axis=1)) / np.log(ratio) for p in (m, s)]
    density = np.maximum.reduce([wave, *steep]) + 8 * dx / beam.length
    density = np.cumsum(density, axis=1)
    cuts = []
    for row in np.insert(density, 0, 0.0, axis=1):
        pieces = int(np.ceil(row[-1]))
        cuts.append(np.interp(np.linspace(0, row[-1], pieces + 1), row, t[0]))
    return cuts


class _Mesh:
    def __init__(self, beam, family, cuts, degree):
        bending = family == "bending"
        self.order = 2 if bending else 1
        k = np.repeat(np.arange(len(cuts)), [len(c) - 1 for c in cuts])
        a = np.concatenate([c[:-1] for c in cuts])
        b = np.concatenate([c[1:] for c in cuts])
        size = np.diff(beam.x)[k]
        self.h = (b - a) * size
        first = np.concatenate([[0], np.cumsum([len(c) - 1 for c in cuts])])  # node of breakpoint
        xi, w = legendre.leggauss(degree + 10)
        t = a[:, None] + (b - a)[:, None] * (xi + 1) / 2
        w = w * self.h[:, None] / 2
        m = _value(beam.mass_per_length, k, t, beam.interpolation)
        main = beam.bending_stiffness if bending else beam.axial_stiffness
        self.mass, self.stiffness = w * m, w * _value(main, k, t, beam.interpolation)
        self.force = np.zeros_like(w)
        at = {}
        for item in beam.attachments:
            node = int(first[np.argmin(np.abs(beam.x - item.x))])
            at.setdefault(node, []).append(item)
        if bending:
            self.force = w * (
                _value(beam.axial_force, k, t, "linear")
                + beam.axial_acceleration * self._mass_before(m, w, xi, at)
            )
        self._bases(xi, degree)
        self._number(beam, family, at, degree)

    def _mass_before(self, m, w, xi, at):
        """Mass left of every Gauss point, by integrating the interpolant through the points."""
        n = len(xi)
        coefficients = legendre.legfit(xi, np.eye(n), n - 1)
        integral = legendre.legval(xi, legendre.legint(coefficients, lbnd=-1)).T  # (q, r)
        inside = (m @ integral.T) * self.h[:, None] / 2
        before = np.concatenate([[0.0], np.cumsum(np.sum(m * w, axis=1))])[:-1]
        for node, items in at.items():
            fixed = (item for item in items if type(item).__name__ != "Pedestal")
            before[node:] += sum(getattr(item, "mass", 0.0) for item in fixed)
        return before[:, None] + inside

    def _bases(self, xi, degree):
        """Value, slope and leading derivative of the functions at the Gauss points of elements."""
        if self.order == 2:
            nodal = np.array(
                [[0.5, -0.75, 0, 0.25], [0.25, -0.25, -0.25, 0.25],
                 [0.5, 0.75, 0, -0.25], [-0.25, -0.25, 0.25, 0.25]]
            )  # fmt: skip
        else:
            nodal = np.array([[0.5, -0.5], [0.5, 0.5]])
        bubbles = np.arange(self.order, degree - self.order + 1)
        J = self.h[:, None, None] / 2
        tables = []
        for d in range(self.order + 1):
            columns = [np.polynomial.polynomial.polyval(xi, _poly_derivative(c, d)) for c in nodal]
            for j in bubbles:
                c = legendre.legint(np.eye(j + 1)[j], self.order - d, lbnd=-1)
                columns.append(legendre.legval(xi, c))
            scale = np.ones((len(self.h), 1, len(columns)))
            if self.order == 2:
                scale[:, :, [1, 3]] = J  # slopes are nodal unknowns in x, not in xi
            tables.append(np.array(columns).T[None] * scale / J**d)
        self.value, self.slope, self.top = tables[0], tables[1], tables[self.order]

    def _number(self, beam, family, at, degree):
        """Unknowns: deflection (and slope) of every node, second slopes of joints, bubbles."""
        nodes, p = len(self.h) + 1, self.order
        self.size, right_slope, self.points, held = p * nodes, {}, [], []
        ends = beam.ends.of(family)
        held += list(_HELD[ends[0]]) + [p * (nodes - 1) + i for i in _HELD[ends[1]]]
        springs = ("translational", "rotational") if p == 2 else ("axial",)
        for node, items in at.items():
            dofs = [p * node + i for i in range(p)]
            for item in items:
                kind = type(item).__name__
                if kind == "Joint":
                    self._joint(item, dofs[-1], node, right_slope)
                elif kind == "Pedestal":
                    if p == 2:
                        self._pedestal(item, dofs[0])
                elif kind == "Spring":
                    stiffness = [getattr(item, name) for name in springs]
                    held += [d for d, s in zip(dofs, stiffness, strict=True) if np.isinf(s)]
                    finite = [0.0 if np.isinf(s) else s for s in stiffness]
                    self.points.append((dofs, np.diag(finite), np.zeros((p, p))))
                elif p == 1:
                    self.points.append((dofs, np.zeros((1, 1)), np.array([[item.mass]])))
                else:
                    mass, d = item.mass, item.offset
                    M = np.array([[mass, mass * d], [mass * d, mass * d * d + item.rotary_inertia]])
                    own = beam.axial_acceleration * mass * d if beam.offset_weight else 0.0
                    self.points.append((dofs, np.diag([0.0, own]), M))
        rows = []
        for e in range(nodes - 1):
            left = [p * e + i for i in range(p)]
            left[-1] = right_slope.get(e, left[-1])
            count = degree + 1 - 2 * p
            bubbles = range(self.size, self.size + count)
            self.size += count
            rows.append([*left, *[p * (e + 1) + i for i in range(p)], *bubbles])
        self.dofs, self.held = np.array(rows), np.unique(np.array(held, dtype=int))

    def _joint(self, item, dof, node, right_slope):
        """A second unknown right of the joint; nothing where it has no compliance."""
        compliance = item.rotational if self.order == 2 else item.axial
        if compliance == 0.0:
            return
        right_slope[node] = self.size
        K = np.array([[1, -1], [-1, 1]]) / compliance
        self.points.append(([dof, self.size], K, np.zeros((2, 2))))
        self.size += 1

    def _pedestal(self, item, dof):
        """An unknown for its mass, between two springs."""
        k = item.beam_stiffness
        self.points.append(([dof, self.size], np.array([[k, -k], [-k, k]]), np.zeros((2, 2))))
        own = np.array([[item.ground_stiffness]]), np.array([[item.mass]])
        self.points.append(([self.size], *own))
        self.size += 1

    def forms(self, vectors):
        """The energy matrices in the span of some vectors, summed at the Gauss points."""
        part = vectors[self.dofs]
        top, slope, value = (
            np.einsum("eqi,ein->eqn", basis, part) for basis in (self.top, self.slope, self.value)
        )

        def form(weights, f):
            f = f.reshape(-1, f.shape[-1])
            return (f * weights.reshape(-1, 1)).T @ f

        K = form(self.stiffness, top) - form(self.force, slope)
        M = form(self.mass, value)
        for dofs, k, m in self.points:
            z = vectors[dofs]
            joint = len(dofs) == 2 and k[0, 1] != 0
            K += -k[0, 1] * np.outer(z[0] - z[1], z[0] - z[1]) if joint else z.T @ k @ z
            M += z.T @ m @ z
        return (K + K.T) / 2, (M + M.T) / 2


def _poly_derivative(c, d):
    return np.polynomial.polynomial.polyder(c, d) if d else c
