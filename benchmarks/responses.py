"""Frequency responses against a banded complex solve for each frequency, and an rms against modes.

    python benchmarks/responses.py

1,000 frequencies, 100 segments of different stiffness and mass, 10 outputs, one force, a loss
factor: our chain, and Hermite elements with their dynamic stiffness in bands, `solve_banded`
of scipy for each frequency. Random: the rms at ten places to 1e-6, and a sum of 40 modes on the
coarsest grid that reaches 1e-4.
"""

import sys
import time
from itertools import pairwise

import numpy as np
from scipy.linalg import solve_banded

from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.response.damping import Damping
from antinode.response.frequency import Model, frequency_response
from antinode.response.harmonic import bases
from antinode.response.modal import basis
from antinode.response.quantities import Force, Output
from antinode.response.random import Inputs, moments
from antinode.response.spectra import Spectrum

SEGMENTS, FREQUENCIES, OUTPUTS, ETA = 100, 1000, 10, 0.02


def beam():
    rng = np.random.default_rng(18)
    x = np.linspace(0, 10.0, SEGMENTS + 1)
    m = 50 * np.exp(rng.normal(0, 0.2, SEGMENTS))
    EI = 1e6 * np.exp(rng.normal(0, 0.2, SEGMENTS))
    return Beam.from_stations(x, m, EI, ends=Ends("clamped"))


def bands(own):
    """Stiffness and mass of Hermite elements, clamped on the left, as bands (7, n)."""
    size = 2 * len(own.x)
    K, M = np.zeros((7, size)), np.zeros((7, size))
    for k, (a, b) in enumerate(pairwise(own.x.tolist())):
        h, EI, m = b - a, own.bending_stiffness[k, 0], own.mass_per_length[k, 0]
        stiff = EI / h**3 * np.array(
            [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
             [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
        )  # fmt: skip
        mass = m * h / 420 * np.array(
            [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
             [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
        )  # fmt: skip
        for i in range(4):
            for j in range(4):
                K[3 + i - j, 2 * k + j] += stiff[i, j]
                M[3 + i - j, 2 * k + j] += mass[i, j]
    return K[:, 2:], M[:, 2:]


def banded(own, omega, force, outputs):
    K, M = bands(own)
    lossy, load = K * (1 + 1j * ETA), np.zeros(K.shape[1], complex)
    load[force] = 1.0
    H = np.empty((len(outputs), len(omega)), complex)
    for k, w in enumerate(omega):
        H[:, k] = solve_banded((3, 3), lossy - w**2 * M, load, check_finite=False)[outputs]
    return H


def best(function, times=5):
    seconds = []
    for _ in range(times):
        start = time.perf_counter()
        value = function()
        seconds.append(time.perf_counter() - start)
    return min(seconds), value


def harmonic():
    own, hertz = beam(), np.linspace(1.0, 200.0, FREQUENCIES)
    places = np.arange(10, SEGMENTS + 1, SEGMENTS // OUTPUTS)
    outputs = [Output(float(own.x[k]), "displacement") for k in places]

    def ours():
        return frequency_response(own, hertz, [Force(10.0)], outputs, damping=Damping(ETA))

    mine, response = best(ours)
    dofs = 2 * (places - 1)
    peer, H = best(lambda: banded(own, 2 * np.pi * hertz, 2 * (SEGMENTS - 1), dofs), 3)
    away = np.max(np.abs(H - response.values[:, 0])) / np.max(np.abs(H))
    print(f"{FREQUENCIES} frequencies, {SEGMENTS} segments, {OUTPUTS} outputs")
    print(f"  chain, exact          {1e3 * mine:8.2f} ms")
    print(f"  scipy, solve_banded   {1e3 * peer:8.2f} ms   ({peer / mine:.1f} times)")
    print(f"  the elements' own error: {away:.1e} of the largest response")


def random(eta=0.002):
    own, band = beam(), (1.0, 800.0)
    outputs = [Output(float(x), "displacement") for x in own.x[10::10]]
    damping = Damping(eta)
    model = Model(own, [Force(10.0)], outputs, damping, band[1])
    inputs = Inputs([Spectrum(np.array(band), np.ones(2))])
    modes = bases(model.beam, model.drives, model.outputs, damping, band[1])
    mine, found = best(lambda: moments(model, inputs, modes, band, 2e-6), 3)
    forty = basis(model.beam, "bending", 40, model.drives, model.outputs, damping)
    points, away = 1000, 1.0
    while away > 2e-4:
        points *= 2
        f = np.linspace(*band, points)

        def summed(f=f):
            H = (forty.outputs * forty.drives[:, 0]) @ (
                1 / (forty.omega2[:, None] * (1 + 1j * eta) - (2 * np.pi * f) ** 2)
            )
            return np.trapezoid(np.abs(H) ** 2, f)

        peer, square = best(summed, 2)
        away = np.max(np.abs(square / found.square - 1))
    print(f"rms at {len(outputs)} places, loss factor {eta:g}, {band[0]:g} to {band[1]:g} Hz")
    print(
        f"  resonance by resonance, to {np.max(found.error / found.square) / 2:.0e}: "
        f"{1e3 * mine:.1f} ms"
    )
    print(f"  40 modes on {points} points, to {away / 2:.0e}: {1e3 * peer:.1f} ms")


if __name__ == "__main__":
    harmonic()
    for eta in (0.02, 0.002, 0.0002):
        random(eta)
    sys.exit(0)
