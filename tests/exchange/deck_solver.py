"""A NASTRAN deck as pyNastran reads it, solved by plane beam elements: statics, then modes.

Four freedoms a grid: along x, along y, about z, about x. Half of the mass at either grid; the axial
force that stiffens the elements comes from the displacements of the static subcase alone. Nothing
of antinode is used.
"""

import numpy as np
from pyNastran.bdf.bdf import read_bdf
from scipy.linalg import solve
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import eigsh

DOF = {"1": 0, "2": 1, "6": 2, "4": 3}
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(6)


class Deck:
    """The matrices of a deck, and its subcases."""

    def __init__(self, path):
        self.model = model = read_bdf(str(path), debug=None, xref=False)
        self.index = {g: 4 * k for k, g in enumerate(sorted(model.nodes))}
        size = 4 * len(self.index)
        self.K, self.M = np.zeros((size, size)), np.zeros((size, size))
        self.links = {}
        for element in model.elements.values():
            if element.type == "CBAR":
                self._bar(element)
            elif element.type == "CELAS2":
                self._spring(element)
        for mass in model.masses.values():
            self._mass(mass)
        for rigid in model.rigid_elements.values():
            for c in rigid.cm:
                for g in rigid.Gmi:
                    self.links[self.index[g] + DOF[c]] = self.index[rigid.gn] + DOF[c]

    def modes(self, number):
        """omega^2 of bending, longitudinal and torsion modes under a subcase's preload [1/s^2]."""
        settings = self.settings(number)
        K = self.K.copy()
        if "STATSUB" in settings:
            static = self.settings(settings["STATSUB"])
            u = self._solve_static(static)
            for element in self.model.elements.values():
                if element.type == "CBAR":
                    self._stiffen(K, element, u)
        T = self._free(settings.get("SPC"))
        freedom = np.argmax(T, axis=0) % 4
        families = (freedom == 1) | (freedom == 2), freedom == 0, freedom == 3
        return [_lowest(T[:, own], K, self.M) for own in families if np.any(own)]

    def settings(self, number):
        case = self.model.subcases[number]
        return {k: case.get_parameter(k)[0] for k in ("SPC", "LOAD", "STATSUB") if k in case}

    def _solve_static(self, settings):
        force = np.zeros(len(self.K))
        for load in self.model.loads[settings["LOAD"]]:
            force[self.index[load.node] : self.index[load.node] + 2] += load.mag * load.xyz[:2]
        T = self._free(settings["SPC"])
        return T @ solve(T.T @ self.K @ T, T.T @ force)

    def _free(self, spc):
        """The map from free freedoms to all of them: supports out, links followed."""
        size = len(self.K)
        held = {
            self.index[number] + DOF[c]
            for number, node in self.model.nodes.items()
            for c in set(str(node.ps)) & set(DOF)
        }
        for card in self.model.spcs.get(spc, []):
            for node in card.nodes:
                held |= {self.index[node] + DOF[c] for c in card.components}
        free = [i for i in range(size) if i not in held and i not in self.links]
        T = np.zeros((size, len(free)))
        for column, i in enumerate(free):
            T[i, column] = 1.0
        for slave, master in self.links.items():
            T[slave] = T[master]
        return T

    def _geometry(self, element):
        a, b = (self.model.nodes[g].xyz for g in (element.ga, element.gb))
        assert np.allclose((b - a)[1:], 0)
        assert np.allclose(element.x, [0, 1, 0])
        ia, ib = self.index[element.ga], self.index[element.gb]
        return (b - a)[0], np.array([ia, ib]), [ia + 1, ia + 2, ib + 1, ib + 2]

    def _bar(self, element):
        h, axial, bending = self._geometry(element)
        prop = self.model.properties[element.pid]
        material = self.model.materials[prop.mid]
        E, twist = material.e, axial + 3
        self.K[np.ix_(twist, twist)] += material.g * prop.j / h * np.array([[1, -1], [-1, 1]])
        k = E * prop.A / h
        self.K[np.ix_(axial, axial)] += k * np.array([[1, -1], [-1, 1]])
        self.K[np.ix_(bending, bending)] += E * prop.i1 * hermite(h)[0]
        for i in (*axial, bending[0], bending[2]):
            self.M[i, i] += prop.nsm * h / 2

    def _stiffen(self, K, element, u):
        h, axial, bending = self._geometry(element)
        prop = self.model.properties[element.pid]
        tension = self.model.materials[prop.mid].e * prop.A / h * (u[axial[1]] - u[axial[0]])
        K[np.ix_(bending, bending)] += tension * hermite(h)[1]

    def _spring(self, element):
        ends = [(g, c) for g, c in zip(element.nodes, (element.c1, element.c2), strict=True) if g]
        at = [self.index[g] + DOF[str(c)] for g, c in ends]
        for i in at:
            for j in at:
                self.K[i, j] += element.k if i == j else -element.k

    def _mass(self, mass):
        i, d, m = self.index[mass.nid], mass.X[0], mass.mass
        self.M[i, i] += m
        self.M[i + 3, i + 3] += mass.I[0]
        block = np.array([[m, m * d], [m * d, m * d * d + mass.I[5]]])
        self.M[i + 1 : i + 3, i + 1 : i + 3] += block


def _lowest(T, K, M):
    """The eigenvalues nearest to zero, by shift and invert."""
    T = csc_matrix(T)
    K, M = (csc_matrix(T.T @ csc_matrix(A) @ T) for A in (K, M))
    return eigsh(K, k=8, M=M, sigma=-1.0, return_eigenvectors=False)


def hermite(h):
    """Stiffness and geometric stiffness for EI = tension = 1."""
    K, G = np.zeros((4, 4)), np.zeros((4, 4))
    for p, w in zip(_POINTS, _WEIGHTS, strict=True):
        s = (p + 1) / 2
        g = np.array([-6 * s + 6 * s**2, h * (1 - 4 * s + 3 * s**2),
                      6 * s - 6 * s**2, h * (3 * s**2 - 2 * s)]) / h  # fmt: skip
        c = np.array([-6 + 12 * s, h * (-4 + 6 * s), 6 - 12 * s, h * (6 * s - 2)]) / h**2
        K += w * h / 2 * np.outer(c, c)
        G += w * h / 2 * np.outer(g, g)
    return K, G
