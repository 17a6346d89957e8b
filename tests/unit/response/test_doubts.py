"""What the errors of modes may do to a history counts in its error."""

from dataclasses import replace

import numpy as np
import pytest

import antinode as an
from antinode.response.frequency import Model
from antinode.response.histories import History
from antinode.response.modal_sum import Summed
from antinode.response.transient import Driven, Histories


@pytest.mark.parametrize("ratio", [1e-4, 1e-2])
@pytest.mark.parametrize("end", [20.0, 400.0])
def test_a_frequency_that_is_off_drifts(ratio, end):
    beam = an.Beam.from_stations([0, 0.5, 1.0], 1.0, 1.0, ends=an.Ends("clamped"))
    outputs = [an.Output(1.0, "displacement"), an.Output(0.0, "bending_moment")]
    model = Model(beam, [an.Force(0.5)], outputs, an.Damping(modal=(ratio,)), 10.0)
    pulse = History(np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, 0.0]))
    driven = Driven((pulse,), np.linspace(0, end, 4001))
    summed = Summed(model, "bending", 12)
    own, off = summed.basis, 1e-4
    plain = Histories(summed, driven)
    before = plain.left_out(plain.values())
    summed.basis = replace(own, doubts=off * own.omega2)
    error = Histories(summed, driven).left_out(plain.values())
    summed.basis = replace(own, omega2=own.omega2 * (1 + off))
    away = np.max(np.abs(Histories(summed, driven).values() - plain.values()), axis=1)
    assert np.all(away > before)  # it would have been too small without
    assert np.all(away <= error - before)
