"""Peaks against closed forms: however the first grid lies about a resonance."""

import numpy as np

from antinode.response.peaks import find_peaks, with_resonances


def oscillator(natural, ratio):
    """Return the modulus of a displacement, its largest value and where that is."""

    def size(hertz):
        r = hertz / natural
        return 1 / np.abs(1 - r**2 + 2j * ratio * r)[None]

    return size, 1 / (2 * ratio * np.sqrt(1 - ratio**2)), natural * np.sqrt(1 - 2 * ratio**2)


def test_a_peak_is_found_on_either_side_of_the_middle_of_its_bracket():
    """Of 300 draws; the middle of a bracket is met twice, a rounding apart, in every fifth."""
    rng = np.random.default_rng(0)
    for _ in range(300):
        natural, ratio = float(np.exp(rng.uniform(0, 3))), float(10 ** rng.uniform(-4, -1.3))
        size, largest, place = oscillator(natural * (1 + rng.uniform(-0.3, 0.3) * ratio), ratio)
        grid = with_resonances(np.geomspace(0.3, 40, 7), np.array([natural]), np.array([ratio]))
        (peak,) = find_peaks(size, grid, size(grid))[0]
        np.testing.assert_allclose(peak.size, largest, rtol=1e-8)
        np.testing.assert_allclose(peak.frequency_hz, place, rtol=5e-8)
        low, high = peak.bracket_hz
        assert low < peak.frequency_hz < high
        assert low * (1 - 1e-8) < place < high * (1 + 1e-8)
