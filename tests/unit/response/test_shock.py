"""Shock response spectra: how far their largest values may be off, and what is refused."""

import numpy as np
import pytest

from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.errors import InputError
from antinode.response.shock import _spectrum, srs
from antinode.response.solve import beam_response


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.6, 0.99])
def test_maxima_between_points_have_an_error_that_holds(ratio):
    """A record of straight lines, and the same with 300 points on each line."""
    draw = np.random.default_rng(7)
    for length in (4, 30):
        t, a = np.linspace(0, 0.3, length), draw.normal(size=length)
        fine = np.linspace(0, 0.3, 300 * (length - 1) + 1)
        f = np.geomspace(1, 1000, 9)
        found, off = _spectrum(t, a, f, ratio)
        exact = srs(fine, np.interp(fine, t, a), f, ratio)
        assert np.all(np.abs(found - exact) <= off)
        assert np.all(off <= 0.01 * exact)


def test_a_record_of_no_numbers_has_no_spectrum():
    with pytest.raises(InputError, match="must be a finite number"):
        srs([0, 0.1, 0.2], [0, np.nan, 0], [1.0])


PULSE = [{"x": 0.8, "history": {"shape": "triangle", "height": 1, "duration": 0.2}}]
ASKED = [{"x": 1, "quantity": "acceleration"}, {"x": 0.3, "quantity": "bending_moment"}]


def shocked(step, kind="shock", ends=("clamped", "free"), **own):
    beam = Beam.from_stations([0, 1], 1.0, 1.0, ends=Ends(*ends))
    tables = {"forces": PULSE, "outputs": ASKED, "time": {"to": 0.6, "step": step}}
    tables["damping"] = {"loss_factor": 0.04}
    if kind == "shock":
        tables["frequency"] = {"from": 0.5, "to": 40, "points": 9}
    return beam_response(beam, kind, **tables, **own)


@pytest.mark.parametrize("ends", [("clamped", "free"), ("free", "free")])
def test_the_step_of_the_answer_has_no_part_in_the_spectrum(ends):
    """At 50 points a second or 500; and against the record of 5,000 points a second."""
    coarse, fine = (shocked(step, ends=ends, modes=16) for step in (2e-2, 2e-3))
    assert np.all(np.abs(coarse.srs - fine.srs) <= coarse.off + fine.off)
    assert np.all(coarse.off <= coarse.srs)
    record = shocked(2e-4, "transient", ends, modes=16)
    for row in range(2):
        found = srs(record.time_s, record.values[row], fine.frequency_hz)
        np.testing.assert_allclose(fine.srs[row], found, rtol=2e-3)


def test_an_oscillator_that_is_a_mode():
    """Of the same frequency and ratio: a resonance upon a resonance, no division by zero."""
    hertz = 3.516015268 / (2 * np.pi)
    at = [hertz * (1 - 1e-4), hertz, hertz * (1 + 1e-4)]
    beam = Beam.from_stations([0, 1], 1.0, 1.0, ends=Ends("clamped", "free"))
    result = beam_response(
        beam, "shock", forces=PULSE, outputs=ASKED, time={"to": 3, "step": 0.01},
        frequency={"values": at}, damping={"modal": [0.05]}, shock={"q": 10},
    )  # fmt: skip
    middle = (result.srs[:, 0] + result.srs[:, 2]) / 2
    np.testing.assert_allclose(result.srs[:, 1], middle, rtol=1e-5)


def test_an_oscillator_that_does_not_swing_is_refused():
    with pytest.raises(InputError, match=r"shock\.q is 0\.5; it must be at least 0\.501"):
        shocked(0.01, shock={"q": 0.5}, modes=4)
    heavy = shocked(0.01, shock={"q": 0.501}, modes=4)
    assert np.all(np.isfinite(heavy.srs))
