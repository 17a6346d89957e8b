"""State space models, read by scipy, and back from MATLAB's format."""

import numpy as np
import pytest
from scipy.io import loadmat

from antinode.beam.attachments import Dashpot
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends
from antinode.errors import InputError
from antinode.response.damping import Damping
from antinode.response.frequency import frequency_response
from antinode.response.quantities import Base, Force, Output
from antinode.response.state_space import state_space

BEAM = Beam.from_stations([0, 1.0], 1.0, 1.0, ends=Ends("clamped")).with_attachments(
    Dashpot(0.6, 0.2)
)
OUTPUTS = [
    Output(1.0, "displacement", relative=True),
    Output(0.0, "bending_moment"),
    Output(0.5, "acceleration"),
]


def test_its_frequency_response_is_the_chain_s():
    drives, hertz = [Force(0.8), Base()], np.array([0.2, 1.5, 4.0])
    model = state_space(BEAM, drives, OUTPUTS, 30, damping=Damping())
    exact = frequency_response(BEAM, hertz, drives, OUTPUTS)
    assert model.A.shape == (60, 60)
    for k, s in enumerate(2j * np.pi * hertz):
        H = model.C @ np.linalg.solve(s * np.eye(60) - model.A, model.B) + model.D
        assert np.abs(H[:2] / exact.values[:2, :, k] - 1).max() < 1e-3
        assert np.abs(H[2] / exact.values[2, :, k] - 1).max() < 2e-2
    own = model.to_scipy()
    assert own.A.shape == (60, 60)


def test_written_and_read_back(tmp_path):
    model = state_space(BEAM, [Force(0.8)], OUTPUTS, 4)
    model.write_mat(tmp_path / "model.mat")
    read = loadmat(tmp_path / "model.mat")
    for name in "ABCD":
        np.testing.assert_array_equal(read[name], getattr(model, name))
    assert read["inputs"].ravel()[0][0] == "lateral force at 0.8 m [N]"


def test_absolute_displacement_on_moving_ground_is_refused():
    with pytest.raises(InputError, match="relative = true"):
        state_space(BEAM, [Base()], [Output(1.0, "displacement")])
