"""Frequency responses against a banded complex solve for each frequency, and an rms against modes.

    python -m benchmarks.responses

1,000 frequencies, 100 segments of different stiffness and mass, 10 outputs, one force, a loss
factor: our chain, and Hermite elements with their dynamic stiffness in bands, scipy's
`solve_banded` or LAPACK's zgbsv for each frequency (peers/banded.py). Random: the rms at ten
places to 1e-6, and a sum of 40 modes on the coarsest even grid that reaches 1e-4. Times are medians
of the processor's, ours and the peer's in turn.
"""

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import time  # noqa: E402

import numpy as np  # noqa: E402

from antinode.beam.beam import Beam  # noqa: E402
from antinode.beam.ends import Ends  # noqa: E402
from antinode.response.damping import Damping  # noqa: E402
from antinode.response.frequency import Model, frequency_response  # noqa: E402
from antinode.response.harmonic import bases  # noqa: E402
from antinode.response.modal import basis  # noqa: E402
from antinode.response.quantities import Force, Output  # noqa: E402
from antinode.response.spectra import Spectrum  # noqa: E402
from antinode.response.spectral.inputs import Inputs  # noqa: E402
from antinode.response.spectral.moments import moments  # noqa: E402

from .peers.banded import Banded  # noqa: E402

SEGMENTS, FREQUENCIES, OUTPUTS, ETA = 100, 1000, 10, 0.02
_FINER = 1.05  # steps by which the coarsest grid is looked for


def beam():
    rng = np.random.default_rng(18)
    x = np.linspace(0, 10.0, SEGMENTS + 1)
    m = 50 * np.exp(rng.normal(0, 0.2, SEGMENTS))
    EI = 1e6 * np.exp(rng.normal(0, 0.2, SEGMENTS))
    return Beam.from_stations(x, m, EI, ends=Ends("clamped"))


def medians(*functions, times=9):
    """Time functions in turn; return the median seconds of each, and what each gave last."""
    taken, given = [[] for _ in functions], [None for _ in functions]
    for _ in range(times):
        for k, function in enumerate(functions):
            start = time.process_time()
            given[k] = function()
            taken[k].append(time.process_time() - start)
    return [float(np.median(each)) for each in taken], given


def harmonic():
    own, hertz = beam(), np.linspace(1.0, 200.0, FREQUENCIES)
    places = np.arange(10, SEGMENTS + 1, SEGMENTS // OUTPUTS)
    outputs = [Output(float(own.x[k]), "displacement") for k in places]
    peer = Banded(own, ETA)

    def ours(backend="auto"):
        drives, damping = [Force(10.0)], Damping(ETA)
        return frequency_response(own, hertz, drives, outputs, damping=damping, backend=backend)

    asked = 2 * np.pi * hertz, 2 * (SEGMENTS - 1), 2 * (places - 1)
    (mine, read, bands, bare), (response, same, _, H) = medians(
        ours, lambda: ours("numpy"), lambda: peer.scipy(*asked), lambda: peer(*asked)
    )
    size = np.max(np.abs(H))
    print(f"{FREQUENCIES} frequencies, {SEGMENTS} segments, {OUTPUTS} outputs")
    print(f"  chain, exact            {1e3 * mine:8.2f} ms")
    print(f"  scipy, solve_banded     {1e3 * bands:8.2f} ms   ({bands / mine:.1f} times)")
    print(f"  LAPACK's zgbsv itself   {1e3 * bare:8.2f} ms   ({bare / mine:.1f} times)")
    print(f"  the chain in numpy      {1e3 * read:8.2f} ms")
    print(f"  elements are off by {np.max(np.abs(H - response.values[:, 0])) / size:.1e}", end="")
    print(f", numpy by {np.max(np.abs(same.values - response.values)) / size:.1e} of the largest")


def random(eta):
    own, band = beam(), (1.0, 800.0)
    outputs = [Output(float(x), "displacement") for x in own.x[10::10]]
    damping = Damping(eta)
    model = Model(own, [Force(10.0)], outputs, damping, band[1])
    inputs = Inputs([Spectrum(np.array(band), np.ones(2))])
    modes = bases(model)
    forty = basis(model.beam, "bending", 40, model.drives, model.outputs, damping)

    def summed(points):
        f = np.linspace(*band, points)
        H = (forty.outputs * forty.drives[:, 0]) @ (
            1 / (forty.omega2[:, None] * (1 + 1j * eta) - (2 * np.pi * f) ** 2)
        )
        return np.trapezoid(np.abs(H) ** 2, f)

    def ours():
        return moments(model, inputs, modes, band, 2e-6)

    found = ours()

    def away(points):
        return np.max(np.abs(np.sqrt(summed(points) / found.square) - 1))

    points = 200
    while away(int(points)) > 1e-4:
        points *= 1.5
    while away(int(points / _FINER)) <= 1e-4:
        points /= _FINER
    points = int(points)
    (mine, peer), _ = medians(ours, lambda: summed(points), times=5)
    print(f"rms at {len(outputs)} places, loss factor {eta:g}, {band[0]:g} to {band[1]:g} Hz")
    error = np.max(found.error / found.square) / 2
    print(f"  resonance by resonance, to {error:.0e}: {1e3 * mine:.1f} ms")
    print(
        f"  40 modes on {points} points, to {away(points):.0e}: {1e3 * peer:.1f} ms "
        f"({peer / mine:.1f} times)"
    )


if __name__ == "__main__":
    harmonic()
    for loss_factor in (0.02, 0.002, 0.0002):
        random(loss_factor)
