"""Derivatives of omega^2 by the columns of the lateral law, against differences of solved beams."""

from dataclasses import replace

import numpy as np
import pytest

from antinode import Beam, Ends, natural_frequencies
from antinode.vehicle.derivatives import ChainModes

X = np.linspace(0.0, 1.0, 6)
BUMP = np.array([0.0, 0.3, 1.0, 0.2, 0.5])[:, None] * np.ones((1, 2))


def beam(form):
    rng = np.random.default_rng(4)
    column = lambda low, high: rng.uniform(low, high, 6)  # noqa: E731
    return Beam.from_stations(
        X, column(0.5, 2), column(0.5, 2), axial_force=column(-4, 4), ends=Ends("clamped", "free"),
        shear_stiffness=column(80, 160), rotary_inertia_per_length=column(0.001, 0.004),
        foundation_stiffness=column(0, 200), added_mass_per_length=column(0, 1), shear_form=form,
    )  # fmt: skip


BY = {
    "mass_per_length": lambda m: m.by_mass,
    "added_mass_per_length": lambda m: m.by_mass,
    "axial_force": lambda m: m.by_axial_force,
    "shear_stiffness": lambda m: m.by_shear_stiffness,
    "rotary_inertia_per_length": lambda m: m.by_rotary_inertia,
    "foundation_stiffness": lambda m: m.by_foundation,
}


@pytest.mark.parametrize("form", ["haringx", "engesser"])
@pytest.mark.parametrize("name", [*BY, "bending_stiffness"])
def test_against_differences(name, form):
    whole = beam(form)
    omega2 = natural_frequencies(whole, 4).omega2
    modes = ChainModes(whole.chain("bending"), omega2, shear_form=form)
    interval = np.clip(np.searchsorted(X, modes.x, side="right") - 1, 0, 4)
    change = BUMP[interval, 0]
    by = BY.get(name) or (lambda m: m.by_stiffness(whole.bending_stiffness[interval, 0]))
    exact = change @ by(modes)
    size = 1e-4 * np.max(np.abs(getattr(whole, name)))
    moved = [
        natural_frequencies(replace(whole, **{name: getattr(whole, name) + s * size * BUMP}), 4)
        for s in (-1.0, 1.0)
    ]
    difference = (moved[1].omega2 - moved[0].omega2) / (2 * size)
    scale = np.max(np.abs(difference))
    np.testing.assert_allclose(exact, difference, rtol=2e-5, atol=1e-5 * scale)
