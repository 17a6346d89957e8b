"""OpenSeesPy: elastic beam-columns with P-Delta, its own ARPACK.

The axial force comes from displacements along the beam, held by supports in that direction alone:
the beam stays free across, but for a spring that moves no frequency by 1e-8 and keeps the stiffness
from being singular (its eigen has no shift). P-Delta has the force's work on the chord of an
element; what it does on the curvature within is taken off EI (N h^2 / 12), which makes the elements
as good as Hermite's.
"""

import numpy as np
from openseespy import opensees as ops

EA = 1e12


def omega2(h, m, EI, N, modes):
    """The lowest elastic omega^2 of a free-free beam of equal segments."""
    x = (h * np.arange(len(m) + 1)).tolist()
    shortening = np.concatenate([[0.0], np.cumsum(N * (-h / EA))]).tolist()
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("PDelta", 1)
    for node, at in enumerate(x, 1):
        ops.node(node, at, 0.0)
        ops.fix(node, 1, 0, 0)
    own = zip((EI - N * (h * h / 12)).tolist(), m.tolist(), strict=True)
    for k, (stiffness, mass) in enumerate(own, 1):
        ops.element("elasticBeamColumn", k, k, k + 1, EA, 1.0, stiffness, 1,
                    "-mass", mass, "-cMass")  # fmt: skip
    for node, moved in enumerate(shortening, 1):  # elements take earlier ones for their rest
        ops.setNodeDisp(node, 1, moved, "-commit")
    _spring(len(m), EI.mean() / (h * len(m)) ** 3)
    _analysis()
    return np.array(ops.eigen(modes + 2))[2:]


def _spring(segments, stiffness):
    ground = segments + 2
    ops.node(ground, 0.0, 0.0)
    ops.fix(ground, 1, 1, 1)
    ops.uniaxialMaterial("Elastic", 1, 1e-6 * stiffness)
    ops.element("zeroLength", segments + 1, ground, 1, "-mat", 1, "-dir", 2)


def _analysis():
    """The fastest of those offered; unset parts would be chosen with a warning each."""
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("SuperLU")
    ops.algorithm("Linear")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
