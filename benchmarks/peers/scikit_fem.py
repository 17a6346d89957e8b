"""scikit-fem: its Hermite elements, and eigsh about a shift below the lowest eigenvalue.

m, EI and N are constant within an element, so that the integrals over the shapes are made once,
element by element, and every beam only weighs and assembles them.
"""

import numpy as np
from scipy.sparse.linalg import eigsh
from skfem import Basis, BilinearForm, ElementLineHermite, MeshLine


class ScikitFem:
    """Free-free beams of equal segments over one mesh."""

    def __init__(self, length, segments):
        mesh = MeshLine(np.linspace(0.0, length, segments + 1))
        basis = Basis(mesh, ElementLineHermite(), intorder=6)
        self.length = length
        self.start = np.cos(np.arange(basis.N))
        forms = (
            lambda u, v, w: u.hess[0][0] * v.hess[0][0],
            lambda u, v, w: u.grad[0] * v.grad[0],
            lambda u, v, w: u * v,
        )
        self.elements = [BilinearForm(form).coo_data(basis) for form in forms]
        self.local = [elements.tolocal() for elements in self.elements]

    def omega2(self, m, EI, N, modes):
        bending, axial, inertia = self.local
        EI, N, m = (values[:, None, None] for values in (EI, N, m))
        K = self.elements[0].fromlocal(EI * bending - N * axial).tocsr()
        M = self.elements[2].fromlocal(m * inertia).tocsr()
        shift = -20 * N.max() / (m.mean() * self.length**2)
        values = eigsh(
            K, modes + 2, M, sigma=shift, return_eigenvectors=False, tol=1e-8, ncv=2 * modes + 4,
            v0=self.start,
        )  # fmt: skip
        return np.sort(values)[2:]
