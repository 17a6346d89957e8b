"""Ratios of modes down to 1e-4 on beams that vary: stated errors against hp elements' own modes.

At a hundredth of a percent of damping a relative 1e-8 in a natural frequency is 1e-4 of the
response beside it: the reference has all modes of its elements to 1e-12, summed one by one.
"""

import numpy as np
import pytest
from scipy.linalg import eigh

import antinode as an
from antinode.response.frequency import Model
from antinode.response.modal_sum import modal_response
from forced_beam import HpResponse

PLACE, SEEN = 0.7, 0.4


def beam(kind):
    shape = [1.0, 0.72, 0.9, 0.45] if kind == "linear" else [1.0, 0.3, 1.4, 0.2]
    return an.Beam.from_stations(
        [0.0, 0.4, 0.7, 1.0],
        shape,
        [s**2 for s in shape],
        interpolation=kind,
        axial_force=[1.0, 0.5, 0.4, 0.0],
        ends=an.Ends("clamped"),
    )


class Exact:
    """The sum over all modes of hp elements, each with its own ratio."""

    def __init__(self, own, zeta):
        mesh = HpResponse(own, 0.0, count=30)
        some = np.ix_(mesh.free, mesh.free)
        K, M = mesh.K.real[some], mesh.M[some]
        d = 1 / np.sqrt(np.diag(K))
        mu, v = eigh(M * np.outer(d, d), K * np.outer(d, d))
        self.omega2 = 1 / mu[::-1]
        phi = (v * d[:, None])[:, ::-1] * np.sqrt(self.omega2)
        low = np.zeros((len(mesh.K), 30))  # by squares at Gauss points: as exact as high ones
        low[mesh.free] = phi[:, :30]
        stiff, mass = mesh.mesh.forms(low)
        values, mix = eigh(stiff, mass)
        self.omega2[:30], phi[:, :30] = values, phi[:, :30] @ mix
        row = {i: int(np.searchsorted(mesh.free, i)) for i in mesh.free}
        self.weight = phi[row[mesh.dof(SEEN)]] * phi[row[mesh.dof(PLACE)]]
        self.zeta = zeta

    def hertz(self, mode):
        return np.sqrt(self.omega2[mode - 1]) / (2 * np.pi)

    def at(self, hertz):
        w = 2 * np.pi * np.asarray(hertz)[:, None]
        D = self.omega2 - w**2 + 2j * self.zeta * np.sqrt(self.omega2) * w
        return np.sum(self.weight / D, axis=1)


@pytest.mark.parametrize("kind", ["linear", "log"])
@pytest.mark.parametrize("zeta", [1e-2, 1e-4])
def test_values_beside_resonances_and_peaks(kind, zeta):
    own, exact = beam(kind), Exact(beam(kind), zeta)
    sides = np.array([-3.0, -1.0, -0.3, 0.0, 0.5, 1.0, 2.0])
    hertz = np.sort(np.concatenate([exact.hertz(n) * (1 + zeta * sides) for n in (1, 2, 3, 5)]))
    outputs, drives = [an.Output(SEEN, "displacement")], [an.Force(PLACE)]
    model = Model(own, drives, outputs, an.Damping(modal=(zeta,)), float(hertz[-1]))
    found = modal_response(model, hertz, None, 1e-6)
    true = exact.at(hertz)
    away = np.max(np.abs(found.values[0, 0] - true))
    assert away <= found.error[0, 0]
    assert found.error[0, 0] < 1e-2 * np.max(np.abs(true))
    result = own.response(
        "harmonic",
        forces=[{"x": PLACE, "amplitude": 1.0}],
        outputs=[{"x": SEEN, "quantity": "displacement"}],
        frequency={"values": hertz.tolist()},
        damping={"modal": [zeta]},
    )
    for peak in result.peaks[0]:
        near = exact.at(peak.frequency_hz * (1 + zeta * np.linspace(-0.1, 0.1, 2001)))
        assert abs(peak.size - np.max(np.abs(near))) <= result.peak_error[0] + 1e-9 * peak.size
    assert len(result.peaks[0]) >= 4


@pytest.mark.parametrize("zeta", [1e-2, 1e-4])
def test_rms(zeta):
    own, exact = beam("linear"), Exact(beam("linear"), zeta)
    low, high = 0.5 * exact.hertz(1), exact.hertz(3) * (1 - zeta)  # ends in a resonance
    grid = [low, high, *np.linspace(low, high, 4001)]
    for mode in range(1, 5):
        u = np.linspace(-12, 12, 40_001)
        grid.append(exact.hertz(mode) * (1 + zeta * np.sinh(u)))
    grid = np.unique(np.concatenate([np.ravel(g) for g in grid]))
    grid = grid[(grid >= low) & (grid <= high)]
    S = np.abs(exact.at(grid)) ** 2
    square = np.sum(np.diff(grid) * (S[1:] + S[:-1]) / 2)
    result = own.response(
        "random",
        forces=[{"x": PLACE, "psd": {"frequency": [low, high], "level": [1.0, 1.0]}}],
        outputs=[{"x": SEEN, "quantity": "displacement"}],
        frequency={"from": low, "to": high, "points": 50},
        damping={"modal": [zeta]},
    )
    own_rms = result.statistics[0]
    assert abs(own_rms.rms - np.sqrt(square)) <= own_rms.error + 1e-6 * own_rms.rms
    assert own_rms.error < 1e-2 * own_rms.rms
