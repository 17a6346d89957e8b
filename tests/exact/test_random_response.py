"""Random responses: white noise on one mode, and any grid, down to a damping ratio of 1e-4."""

import numpy as np
import pytest

from antinode.beam.attachments import Dashpot, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.response.damping import UNDAMPED, Damping
from antinode.response.frequency import Model
from antinode.response.harmonic import bases
from antinode.response.modal import basis
from antinode.response.quantities import Force, Output
from antinode.response.spectra import Spectrum
from antinode.response.spectral.inputs import Inputs
from antinode.response.spectral.moments import davenport, moments


def one_mode(zeta, hertz=10.0, mass=5.0):
    """A mass that slides, on a spring and a dashpot; the beam itself is all but rigid."""
    omega = 2 * np.pi * hertz
    beam = Beam.from_stations([0, 1], 3.0, 1e14, ends=Ends("sliding", "sliding"))
    return beam.with_attachments(
        PointMass(1.0, mass - 3.0), Spring(0.0, mass * omega**2),
        Dashpot(0.0, 2 * zeta * omega * mass),
    )  # fmt: skip


MIDDLE = (Force(0.5),)


def integrated(beam, outputs, band, damping=UNDAMPED, tolerance=1e-8, forces=MIDDLE, **own):
    model = Model(beam, list(forces), outputs, damping, band[1])
    modes = bases(model)
    spectra = [Spectrum(np.array(band), np.ones(2)) for _ in forces]
    return moments(model, Inputs(spectra, **own), modes, band, tolerance)


def indefinite(f, f0, zeta):
    """int df/|1 - r^2 + 2 i zeta r|^2, r = f/f0, by partial fractions of the pole r0."""
    r0 = np.sqrt(1 - zeta**2) + 1j * zeta
    r = np.asarray(f) / f0
    # 1/|...|^2 = 1/((r^2 - r0^2)(r^2 - conj(r0)^2)) with r0^2 = 1 - 2 zeta^2 + 2 i zeta sqrt(..)
    a, b = r0**2, np.conj(r0) ** 2
    term = (np.log((r - r0) / (r + r0)) / (2 * r0)) / (a - b)
    return f0 * 2 * np.real(term)


@pytest.mark.parametrize("zeta", [1e-4, 1e-3, 0.02, 0.3])
def test_white_noise_on_one_mode(zeta):
    """In a band, in closed form; over all frequencies sigma^2 = pi S0/(2 zeta omega^3 M^2)."""
    mass, hertz, band = 5.0, 10.0, (0.5, 200.0)
    omega = 2 * np.pi * hertz
    own = integrated(one_mode(zeta), [Output(0.0, "displacement")], band)
    low, high = (indefinite(f, hertz, zeta) for f in band)
    exact = (high - low) / (mass * omega**2) ** 2
    assert abs(own.square[0] - exact) <= own.error[0] + 1e-9 * exact  # the beam bends by 1e-11
    assert own.error[0] < 1e-6 * exact
    whole = np.pi * (1 / (4 * np.pi)) / (2 * zeta * omega**3 * mass**2)  # S0 two-sided, per rad/s
    if zeta < 0.01:
        assert own.square[0] == pytest.approx(whole, rel=20 * zeta + 1e-3)


def test_crossings_and_peaks_of_a_narrow_band():
    own = integrated(one_mode(1e-3), [Output(0.0, "displacement")], (5.0, 20.0))
    assert np.sqrt(own.second[0] / own.square[0]) == pytest.approx(10.0, rel=1e-3)
    g = np.sqrt(2 * np.log(600))
    assert davenport(2.0, 10.0, 60.0) == pytest.approx(2 * (g + 0.577215665 / g))
    assert np.isnan(davenport(2.0, 0.01, 60.0))


@pytest.mark.parametrize("eta", [2e-4, 0.02])
def test_a_cantilever_against_a_sum_of_exact_modes(eta):
    """All modes below 40 times the band, each with EI (1 + i eta), by a fine grid of its own."""
    beam = Beam.from_stations([0, 1], 1.0, 1.0, ends=Ends("clamped"))
    band = (0.1, 12.0)
    own = integrated(beam, [Output(1.0, "displacement")], band, Damping(eta))
    all_modes = basis(beam, "bending", 60, (Force(0.5),), (Output(1.0, "displacement"),), Damping())
    u = np.linspace(-1, 1, 4001)
    f = np.unique(np.concatenate([
        np.linspace(*band, 20001),
        *(f0 + 0.4 * f0 * np.sign(u) * np.abs(u) ** 5 for f0 in all_modes.frequency_hz[:4]),
    ]))  # fmt: skip
    f = f[(f >= band[0]) & (f <= band[1])]
    omega2 = (2 * np.pi * f) ** 2
    share = all_modes.outputs[0] * all_modes.drives[:, 0]
    H = share @ (1 / (all_modes.omega2[:, None] * (1 + 1j * eta) - omega2))
    trapezoids = np.trapezoid(np.abs(H) ** 2, f)
    assert own.square[0] == pytest.approx(trapezoids, rel=1e-4)
    assert own.error[0] < 1e-7 * own.square[0]
    tight = integrated(beam, [Output(1.0, "displacement")], band, Damping(eta), 1e-11)
    assert abs(own.square[0] - tight.square[0]) <= own.error[0] + tight.error[0]


def test_kinks_of_the_input_are_met():
    """A spectrum of many short pieces is integrated piece by piece."""
    beam = one_mode(0.02)
    f = np.geomspace(1, 100, 300)
    rng = np.random.default_rng(18)
    jagged = Spectrum(f, np.exp(rng.normal(0, 1, 300)))
    model = Model(beam, [Force(0.5)], [Output(0.0, "displacement")], Damping(), 100.0)
    modes = bases(model)
    a, b = (moments(model, Inputs([jagged]), modes, (1, 100), t) for t in (1e-5, 1e-10))
    assert abs(a.square[0] - b.square[0]) <= a.error[0] + b.error[0]
    fine = np.geomspace(1, 100, 400001)
    omega = 2 * np.pi * fine
    H = 1 / (5 * ((2 * np.pi * 10) ** 2 - omega**2 + 2j * 0.02 * 2 * np.pi * 10 * omega))
    rough = np.trapezoid(np.abs(H) ** 2 * jagged.at(fine), fine)
    assert b.square[0] == pytest.approx(rough, rel=1e-6)


def test_coherent_forces():
    """Two equal forces at one place: 2 S alone, 4 S together, nothing in opposition."""
    beam, forces = one_mode(0.02), (Force(0.2), Force(0.2))
    outputs, band = [Output(0.0, "displacement")], (1.0, 50.0)
    single = integrated(beam, outputs, band, forces=forces[:1]).square[0]
    for value, factor in ((0.0, 2), (1.0, 4), (-1.0, 0), (0.5j, 2)):
        coherence = np.array([[1, value], [np.conj(value), 1]], dtype=complex)
        own = integrated(beam, outputs, band, forces=forces, coherence=coherence)
        assert own.square[0] == pytest.approx(factor * single, rel=1e-6, abs=1e-9 * single)
        assert np.sum(own.by_drive[0]) == pytest.approx(factor * single, abs=1e-9 * single)
