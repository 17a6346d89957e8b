"""What a solver finds on a mesh: eigenvalues and load factor of its assembled matrices."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, eye_array
from scipy.sparse.linalg import LinearOperator, eigsh, splu

from antinode.arrays import Array
from antinode.beam.families import BENDING, FAMILIES, LONGITUDINAL, FamilyName

from .elements import Bar, Kind, Matrices, bar, solid
from .mesh import AXIAL, LATERAL, TURN, Mesh

_COLUMN = {AXIAL: 0, LATERAL: 1, TURN: 2}
_TWIST = 3  # the freedom about the axis, which a plane mesh has not: a bar stands for it


@dataclass(frozen=True)
class Assembly:
    """Assembled matrices of a mesh, and which freedoms are free.

    Attributes
    ----------
    K, M, G : sparse array, shape (d, d)
        Stiffness, mass, and what N takes off the stiffness.
    free : sparse array, shape (d, f)
        All freedoms from the free ones.
    axial : array of bool, shape (f,)
        Which of the free freedoms are along x.
    """

    K: Any
    M: Any
    G: Any
    free: Any
    axial: NDArray[np.bool_]

    def family(self, name: FamilyName) -> tuple[Any, Any, Any]:
        """Return K, M and G of the free freedoms of a family."""
        T = self.free[:, np.flatnonzero(self.axial == (0 in FAMILIES[name].freedoms))]
        K, M, G = (csc_array(T.T @ A @ T) for A in (self.K, self.M, self.G))
        return K, M, G


def eigenvalues(
    mesh: Mesh, kind: Kind, name: FamilyName, below: float, count: int, *, loaded: bool
) -> Array:
    """Return the lowest omega^2 of a family of modes, rising [1/s^2].

    Parameters
    ----------
    mesh : Mesh
    kind : str
        Of the elements.
    name : str
    below : float
        An omega^2 below the lowest, and not far.
    count : int
    loaded : bool
        Under N, or without.
    """
    if _TWIST in FAMILIES[name].freedoms:
        return eigenvalues(mesh.as_bar(), kind, LONGITUDINAL, below, count, loaded=False)
    K, M, G = assembled(mesh, kind, strained=loaded).family(name)
    K = csc_array(K - G) if loaded else K
    count = min(count, K.shape[0] - 2)
    start = np.cos(np.arange(K.shape[0]) + 1.0)
    found = eigsh(K, count, M, sigma=below, v0=start, return_eigenvectors=False)
    return np.asarray(np.sort(found))


def load_factor(mesh: Mesh, kind: Kind) -> float | None:
    """Return the factor on N at which bending loses its stiffness; None where none does."""
    K, _, G = assembled(mesh, kind, strained=False).family(BENDING)
    inverse = LinearOperator(K.shape, matvec=splu(K).solve, dtype=float)
    start = np.cos(np.arange(K.shape[0]) + 1.0)
    options: dict[str, Any] = {"which": "LA", "v0": start, "return_eigenvectors": False}
    largest = float(eigsh(G, 1, K, Minv=inverse, **options)[0])
    return 1 / largest if largest > 0 else None


def assembled(mesh: Mesh, kind: Kind, *, strained: bool) -> Assembly:
    """Assemble elements, masses, springs and joints."""
    right = {node: mesh.count + 1 + k for k, node in enumerate(mesh.joints)}
    points = mesh.count + 1 + len(right) + (mesh.count if kind == "solids" else 0)
    own = [_element(mesh, k, kind, strained=strained) for k in range(mesh.count)]
    at = [_freedoms(mesh, k, right, points, kind) for k in range(mesh.count)]
    K, M, G = (
        _summed([(i, getattr(part, name)) for i, part in zip(at, own, strict=True)], 3 * points)
        for name in ("K", "M", "G")
    )
    stiff = _summed(_springs(mesh, right), 3 * points)
    heavy = _summed(_masses(mesh), 3 * points)
    free, axial = _free(mesh, right, 3 * points)
    return Assembly(K + stiff, M + heavy, G, free, axial)


def _summed(parts: list[tuple[Any, Array]], size: int) -> Any:
    """Return the sum of small matrices at rows and columns of a large one."""
    if not parts:
        return csc_array((size, size))
    rows = np.concatenate([np.repeat(i, len(i)) for i, _ in parts])
    columns = np.concatenate([np.tile(i, len(i)) for i, _ in parts])
    values = np.concatenate([part.ravel() for _, part in parts])
    return coo_array((values, (rows, columns)), shape=(size, size)).tocsc()


def _freedoms(mesh: Mesh, k: int, right: dict[int, int], points: int, kind: Kind) -> Array:
    """Return the freedoms of an element; it begins on the right side of a joint."""
    own = [right.get(k, k), k + 1]
    if kind == "solids":
        own.insert(1, points - mesh.count + k)
    return np.asarray((3 * np.array(own)[:, None] + np.arange(3)).ravel())


def _element(mesh: Mesh, k: int, kind: Kind, *, strained: bool) -> Matrices:
    of = mesh.lengths[k], mesh.EI[k], mesh.EA[k], mesh.mass[k], mesh.N[k]
    if kind == "solids":
        return solid(Bar(*of, mesh.solid_shear[k], 0.0), strained=strained)
    kGA = math.inf if mesh.kGA is None else mesh.kGA[k]
    rotary = 0.0 if mesh.rotary is None else mesh.rotary[k]
    return bar(Bar(*of, kGA, rotary), strings=kind == "bars by strings")


def _masses(mesh: Mesh) -> list[tuple[Any, Array]]:
    parts = []
    for node, item in mesh.masses:
        m, d = item.mass, item.offset
        block = np.array([[m, 0, 0], [0, m, m * d], [0, m * d, m * d * d + item.rotary_inertia]])
        parts.append((3 * node + np.arange(3), block))
    lateral = _COLUMN[LATERAL]
    for node, mass in mesh.at_nodes(mesh.added):
        parts.append((np.array([3 * node + lateral]), np.array([[mass]])))
    return parts


def _springs(mesh: Mesh, right: dict[int, int]) -> list[tuple[Any, Array]]:
    """Return springs to the ground, and what gives way at joints."""
    parts: list[tuple[Any, Array]] = [
        (np.array([3 * n + _COLUMN[f]]), np.array([[k]]))
        for n, f, k in [*mesh.springs, *mesh.bedding]
        if f in _COLUMN
    ]
    for node, freedom, compliance in _gaps(mesh):
        sides = np.array([3 * node, 3 * right[node]]) + _COLUMN[freedom]
        parts.append((sides, np.array([[1, -1], [-1, 1]]) / compliance))
    return parts


def _gaps(mesh: Mesh) -> list[tuple[int, int, float]]:
    """Return node, freedom and compliance of what gives way at joints."""
    rows = [(n, f, c) for n, own in mesh.joints.items() for f, c in own.items() if f in _COLUMN]
    return [row for row in rows if row[2]]


def _free(mesh: Mesh, right: dict[int, int], size: int) -> tuple[Any, NDArray[np.bool_]]:
    """Return the map from free freedoms to all, and which of them are along x.

    Supports are out, the sides of joints tied.
    """
    open_ = {(node, freedom) for node, freedom, _ in _gaps(mesh)}
    leads = np.arange(size)
    for node, point in right.items():
        for freedom, column in _COLUMN.items():
            if (node, freedom) not in open_:
                leads[3 * point + column] = 3 * node + column
    held = [3 * node + _COLUMN[freedom] for node, freedom in mesh.held if freedom in _COLUMN]
    free = np.setdiff1d(np.flatnonzero(leads == np.arange(size)), held)
    tied = eye_array(size, format="csr")[leads]
    return csc_array(tied)[:, free], free % 3 == _COLUMN[AXIAL]
