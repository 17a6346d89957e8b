"""What loses energy in time where end forces follow: poles of the sums of modes against the beam's.

The beam's are complex modes: zeros of its characteristic function with EI (1 + i eta), solved and
counted without any sum. Losses as on a beam whose forces keep their direction would calm Beck's
column where it grows.
"""

from dataclasses import replace

import numpy as np
import pytest

import antinode as an
from antinode.response.damping import Rayleigh
from antinode.response.frequency import Model
from antinode.response.motion.loops import summed


def column(N, left, **tables):
    return an.Beam.from_stations(
        [0, 0.4, 1.0],
        [1.0, 0.8],
        [1.0, 1.3],
        axial_force=N,
        ends=an.Ends(left, "free", right_follower=1.0),
        **tables,
    )


def poles(beam, damping, modes=32):
    model = Model(beam, [an.Force(0.4)], [an.Output(1.0, "displacement")], damping, 10.0)
    return summed(model, "bending", modes).poles


def complex_modes(beam, eta):
    own = np.zeros((2, 2)) if beam.loss_factor is None else beam.loss_factor
    result = an.solve_modes(
        replace(beam, loss_factor=own + eta), 3, families=["bending"], damping="complex"
    )
    return [mode for mode in result.modes if mode.number]


@pytest.mark.parametrize("left", ["clamped", "free"])
@pytest.mark.parametrize(
    ("N", "eta", "tables"),
    [
        (3.0, 0.02, {}),
        (14.0, 0.02, {}),
        (18.0, 0.002, {}),
        (12.0, 0.0, {"loss_factor": [0.05, 0.001]}),
        (12.0, 0.01, {"shear_stiffness": [150.0, 90.0], "loss_factor": [0.0, 0.03]}),
    ],
)
def test_coupled_modes_lose_what_complex_modes_do(left, N, eta, tables):
    beam = column(N, left, **tables)
    own = poles(beam, an.Damping(eta))
    for mode, s in zip(complex_modes(beam, eta), own, strict=False):
        assert abs(s) / (2 * np.pi) == pytest.approx(mode.frequency_hz, rel=5e-3)
        scale = 1e-4 + 1e-2 * abs(mode.damping_ratio)
        assert -s.real / abs(s) == pytest.approx(mode.damping_ratio, abs=scale)


def test_internal_losses_make_becks_column_grow_in_time_too():
    beam = an.Beam.from_stations(
        [0, 1.0], 1.0, 1.0, axial_force=14.0, ends=an.Ends("clamped", "free", right_follower=1.0)
    )
    assert poles(beam.with_breakpoints([0.4]), an.Damping(0.02))[0].real > 0
    told = an.beam_response(
        beam,
        "transient",
        forces=[{"x": 1.0, "history": {"shape": "half_sine", "duration": 0.3, "height": 1.0}}],
        outputs=[{"x": 1.0, "quantity": "displacement"}],
        damping={"loss_factor": 0.02},
        time={"to": 60.0, "step": 0.05},
    )
    first, last = (np.max(np.abs(part)) for part in np.split(told.values[0][:1200], [600]))
    assert last > first
    assert "grows" in told.warnings[0]


def test_damping_by_stiffness_takes_what_follows_too():
    """Of Rayleigh's beta K all of K: s^2 + (alpha + beta w^2) s + w^2 = 0 at each mode's w^2."""
    beam, damping = column(10.0, "clamped"), Rayleigh(0.05, 0.004)
    plain, own = poles(beam, an.Damping()), poles(beam, an.Damping(rayleigh=damping))
    for free, s in zip(plain[:3], own, strict=False):
        square = abs(free) ** 2
        exact = np.roots([1.0, damping.alpha + damping.beta * square, square])
        assert min(abs(exact - s)) < 1e-9 * abs(s)
