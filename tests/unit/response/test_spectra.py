import numpy as np
import pytest

from antinode.errors import InputError
from antinode.response.spectra import Spectrum, spectrum_from


def test_between_points_it_is_a_power():
    """From 1 at 10 Hz to 100 at 100 Hz is f^2; 20 Hz has 4."""
    spectrum = Spectrum([10.0, 100.0], [1.0, 100.0])
    np.testing.assert_allclose(spectrum.at(np.array([20.0, 50.0])), [4.0, 25.0])
    assert spectrum.mean_square(10, 100) == pytest.approx((100**3 - 10**3) / 300)


def test_a_slope_of_minus_one_is_a_logarithm():
    spectrum = Spectrum([1.0, 10.0], [5.0, 0.5])
    assert spectrum.mean_square(1, 10) == pytest.approx(5 * np.log(10))


def test_a_usual_random_specification():
    """20 to 2000 Hz: +6 dB, flat 0.16 g^2/Hz from 50 to 800 Hz, -6 dB; by hand 14.1 g rms.

    0.16 (50/3) [1 - (20/50)^3] = 2.496, 0.16 750 = 120, 0.16 800 (1 - 800/2000) = 76.8: 199.3 g^2,
    with exact 6.0206 dB for a factor of four.
    """
    octave = 20 * np.log10(2)
    table = {
        "frequency": ["20 Hz", "50 Hz", "800 Hz", "2 kHz"],
        "slope": [octave, 0, -octave],
        "level": "0.16 g^2/Hz",
        "level_at": "100 Hz",
    }
    spectrum = spectrum_from(table, "(m/s^2)^2/Hz", None, "psd")
    square = 0.16 * 50 / 3 * (1 - 0.4**3) + 120 + 76.8
    assert spectrum.mean_square(20, 2000) / 9.80665**2 == pytest.approx(square)


def test_units_stand_in_the_header(tmp_path):
    (tmp_path / "a.csv").write_text("frequency [kHz], psd [kN^2/Hz]\n0.01, 2\n0.1, 3\n")
    spectrum = spectrum_from("a.csv", "(N)^2/Hz", tmp_path, "psd")
    np.testing.assert_allclose(spectrum.frequency_hz, [10, 100])
    np.testing.assert_allclose(spectrum.level, [2e6, 3e6])


@pytest.mark.parametrize(
    ("frequency", "level", "words"),
    [
        ([1, 2], [1, -3], "above 0"),
        ([1, 2], [1, 0], "above 0"),
        ([2, 1], [1, 1], "sort the rows"),
        ([0, 1], [1, 1], "above 0"),
        ([1], [1], "two points"),
    ],
)
def test_what_no_spectrum_is(frequency, level, words):
    with pytest.raises(InputError, match=words):
        Spectrum(np.array(frequency, float), np.array(level, float))


def test_it_must_cover_the_band():
    with pytest.raises(InputError, match="extend the table"):
        Spectrum([10.0, 100.0], [1.0, 1.0]).check_covers(5, 100)


def test_slopes_may_carry_their_unit(tmp_path):
    table = {"frequency": [1, 2, 4], "level": 1.0, "slope": ["3 dB/oct", -3]}
    told, plain = (
        spectrum_from(table | {"slope": slope}, "N^2/Hz", tmp_path, "psd")
        for slope in (["3 dB/oct", "-3 dB/octave"], [3, -3])
    )
    np.testing.assert_array_equal(told.level, plain.level)
