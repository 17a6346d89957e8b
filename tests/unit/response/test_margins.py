"""Margins of equipment: never better known than they are, in any grid; in words where no number."""

import numpy as np
import pytest

from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.response.margins import margin_of, samples_for
from antinode.response.solve import beam_response
from antinode.show.response_table import verdict_rows

LIGHT = {"loss_factor": 2e-3}
PSD = {"frequency": [0.1, 50], "level": [1.0, 1.0]}
BAND = {"from": 0.3, "to": 12, "points": 3}
FLAT = {"frequency": [0.3, 12], "level": [1.0, 1.0]}


def beam(ends=("clamped", "free")):
    return Beam.from_stations([0, 1], 1.0, 1.0, ends=Ends(*ends))


def judged(kind="harmonic", allowed=FLAT, x=1.0, given=None, frequency=BAND, damping=LIGHT, **own):
    forces = given or [{"x": 1, "amplitude": 1, "psd": PSD}]
    tables = {"forces": forces, "frequency": frequency, "damping": damping, **own}
    equipment = [{"name": "box", "x": x, "allowed": allowed}]
    return beam_response(beam(), kind, equipment=equipment, **tables)


def test_samples_miss_less_than_is_said():
    """Sums of resonances under curves with kinks, from 2 to 9 frequencies, against 100,000."""
    draw = np.random.default_rng(5)
    for _ in range(40):
        n = int(draw.integers(1, 6))
        own, ratio = np.exp(draw.uniform(0, 3, n)), 10 ** draw.uniform(-4, -1, n)
        share = draw.normal(size=n) + 1j * draw.normal(size=n) * 0.1
        kinks = np.sort(draw.uniform(0, 3, 4))
        level = draw.normal(0, 3, 6)

        def excess(f, own=own, ratio=ratio, share=share, kinks=kinks, level=level):
            r = f / own[:, None]
            felt = np.abs(share @ (1 / (1 - r**2 + 2j * ratio[:, None] * r)))
            return np.log(felt) - np.interp(np.log(f), [0, *kinks, 3], level)

        start = np.unique(
            np.exp(np.concatenate([draw.uniform(0, 3, 3), kinks, [0, 3], np.log(own)]))
        )
        f, missed = samples_for(excess, start, own, ratio)
        spread = np.sinh(np.linspace(-9, 9, 4001)) / np.sinh(9)
        near = (own[:, None] * np.exp(3 * spread)).ravel()
        dense = np.concatenate([np.exp(np.linspace(0, 3, 60_001)), near])
        dense = dense[(dense >= 1) & (dense <= np.exp(3))]
        assert np.max(excess(dense)) <= np.max(excess(f)) + missed + 1e-12
        assert missed < 1e-5
        assert len(f) < 3000


def test_a_margin_lies_where_slopes_meet_not_at_the_peak():
    """Under a curve that falls by 12 dB an octave, beside 1/|1 - r^2 + i eta|: solved by hand."""
    allowed = {"frequency": [0.3, 12], "level": [1.0, 1e-9]}
    found = judged(allowed=allowed, damping={"loss_factor": 0.2}).verdicts[0]
    fine = judged(allowed=allowed, damping={"loss_factor": 0.2}, frequency={**BAND, "points": 900})
    _, felt, limit = fine.verdicts[0].curve
    densest = float(np.min(20 * np.log10(limit / felt)))
    assert found.margin_db == pytest.approx(densest, abs=1e-4)
    at_peak = max(fine.verdicts[0].curve[1])
    assert felt[np.argmin(limit / felt)] < 0.99 * at_peak  # no peak of the response itself


@pytest.mark.parametrize("kind", ["harmonic", "random"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
def test_errors_cover_those_of_a_beam_that_varies(kind, tolerance):
    from antinode.response.file import Problem, ResponseFile
    from antinode.response.solve import solve_response

    tapered = Beam.from_stations(
        [0, 0.4, 1], [1, 2, 0.5], [3, 1, 0.3], ends=Ends("clamped"), interpolation="linear"
    )

    def margin(asked):
        tables = {
            "response": {"of": "beam", "kind": kind, "tolerance": asked},
            "damping": LIGHT, "frequency": {**BAND, "points": 7},
            "forces": [{"x": 0.8, "amplitude": 1, "psd": PSD}],
            "equipment": [{"name": "box", "x": 0.6, "allowed": FLAT}],
            "random": {"envelope": False},
        }  # fmt: skip
        problem = Problem(ResponseFile.model_validate(tables), tapered, None, "drawn", "numba")
        return solve_response(problem).verdicts[0]

    ours, truth = margin(tolerance), margin(1e-9)
    assert abs(ours.margin_db - truth.margin_db) <= ours.error_db + truth.error_db
    assert truth.error_db < 1e-4
    assert ours.least_db <= truth.margin_db <= ours.most_db


def test_without_damping_there_is_none():
    for kind in ("harmonic", "random"):
        result = judged(kind, damping={})
        (own,) = result.verdicts
        assert own.verdict == "no"
        assert own.margin_words == "none: endless"
        assert result.to_dict()["equipment"][0]["margin_db"] is None
        assert "nothing limits" in " ".join(result.warnings)


def test_where_nothing_is_felt():
    result = judged(given=[{"x": 1, "amplitude": 0}])
    (own,) = result.verdicts
    assert own.verdict == "yes"
    assert own.margin_words == "feels nothing"
    assert verdict_rows(result.verdicts).rows[0][3] == ""
    assert "nothing is felt" in " ".join(result.warnings)
    (on_support,) = judged(given=[{"x": 0, "amplitude": 1}]).verdicts
    assert on_support.least_db > 200  # rounding
    cancelled = judged(given=[{"x": 1, "amplitude": 1}, {"x": 1, "amplitude": -1}])
    assert cancelled.verdicts[0].passed
    unknown = margin_of(np.ones(2), np.full(2, 1e-9), np.full(2, 1e-6), 0, 0, 20.0)
    assert unknown.most == np.inf
    assert unknown.least == pytest.approx(120, abs=0.01)


def test_within_its_error_it_is_not_decided():
    """A response of 2 +- 0.1 under a curve of 2: undecided; of 1.9 or 2.1 +- 0.01: decided."""
    at = np.array([1.0, 2.0])
    for felt, wrong, least, most in ((2.0, 0.1, -1, 1), (1.9, 0.01, 0, 1), (2.1, 0.01, -1, 0)):
        own = margin_of(2 * np.ones(2), np.array([felt, 0.1]), wrong * np.ones(2), 0, 0, 20.0)
        assert least < own.least < own.value < own.most < most
        assert own.at == 0
        assert at[own.at] == 1.0
    (first,) = judged().verdicts
    level = 10 ** (-(first.margin_db) / 20)
    result = judged(allowed={"frequency": [0.3, 12], "level": [level] * 2})
    assert result.verdicts[0].verdict == "not decided"
    assert not result.passed
    assert "not decided" in " ".join(result.warnings)
    assert verdict_rows(result.verdicts).rows[0][4] == "not decided"


def test_one_frequency_is_judged_and_what_is_not_is_said():
    result = judged(frequency={"values": [0.5]})
    assert result.verdicts[0].frequency_hz == 0.5
    assert "not all is judged" in " ".join(result.warnings)
    assert not judged().warnings
    part = judged(allowed={"frequency": [1, 5], "level": [1.0, 1.0]})
    assert "from 1 to 5 Hz alone" in " ".join(part.warnings)


def test_random_without_damping_has_an_answer():
    """The tip has no rms; the middle of a pinned beam under a force there no part of mode 2."""
    result = beam_response(
        beam(), "random", frequency=BAND, forces=[{"x": 1, "psd": PSD}],
        outputs=[{"x": 1, "quantity": "acceleration"}],
    )  # fmt: skip
    assert np.isinf(result.statistics[0].rms)
    assert result.to_dict()["outputs"][0]["rms"] is None
    assert "no damping" in result.warnings[0]
    node = beam_response(
        beam(("pinned", "pinned")), "random", frequency={"from": 2, "to": 10},
        forces=[{"x": 0.5, "psd": PSD}], outputs=[{"x": 0.5, "quantity": "displacement"}],
        random={"envelope": False},
    )  # fmt: skip
    assert node.statistics[0].by_mode[0][0] == "bending 1"  # that is below the band
    assert 0 < node.statistics[0].error < 1e-6 * node.statistics[0].rms
