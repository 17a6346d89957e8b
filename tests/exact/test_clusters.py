"""Modes that coincide or nearly do: eigenvalues certified, shapes orthogonal."""

import math

import numpy as np
import pytest
from modes_tools import chain_matrices

from antinode import Beam, Ends, solve_modes
from antinode.beam.attachments import Spring
from antinode.riccati import shapes

CLAMPED = 4.730040744862704**2 / (2 * math.pi)
"""Of a span of unit length, EI and m, clamped at both ends [Hz]."""


def spans(number, rotational, ends="clamped", length=1.0):
    """Equal spans on supports that hold the slope by a spring."""
    x = np.arange(number + 1.0) * length
    beam = Beam.from_stations(x, 1.0, 1.0, ends=Ends(ends, ends))
    return beam.with_attachments(*(Spring(float(place), math.inf, rotational) for place in x[1:-1]))


@pytest.mark.parametrize("number", [9, 17])
@pytest.mark.parametrize("rotational", [math.inf, 1e12, 1e15])
def test_equal_clamped_spans_have_as_many_equal_modes(number, rotational):
    result = solve_modes(spans(number, rotational), number, normalisation="mass")
    found = result.frequencies_hz()
    np.testing.assert_allclose(found[:number], CLAMPED, rtol=1e-9)
    for mode in result.modes:
        assert abs(mode.frequency_hz - CLAMPED) <= mode.error_hz + 10 * CLAMPED / rotational
    products, _ = chain_matrices(result)
    assert np.max(np.abs(products - np.diag(np.diag(products)))) < 1e-8


@pytest.mark.parametrize(("number", "rotational"), [(4, 1e10), (20, 1e10), (12, 1e7), (6, 1e4)])
def test_shapes_of_modes_that_nearly_coincide_are_orthogonal(number, rotational):
    result = solve_modes(spans(number, rotational), number + 2, normalisation="mass")
    products, _ = chain_matrices(result)
    assert np.max(np.abs(products - np.diag(np.diag(products)))) < 1e-8
    assert max(mode.residual for mode in result.modes) < 1e-8


def test_a_tuned_pair_of_unlike_spans():
    """A long and a short span whose first modes agree, joined by a weak coupling."""
    beam = Beam.from_stations([0, 1, 3], [1, 1, 1], [1, 16, 16], ends=Ends("clamped", "clamped"))
    beam = beam.with_attachments(Spring(1.0, math.inf, 1e9))
    result = solve_modes(beam, 3, normalisation="mass")
    products, _ = chain_matrices(result)
    assert abs(result.frequencies_hz()[1] / result.frequencies_hz()[0] - 1) < 1e-6
    assert np.max(np.abs(products - np.diag(np.diag(products)))) < 1e-8


def test_frequencies_come_out_where_shapes_cannot_be_told_apart(monkeypatch):
    def none(z, weight, quality, members):
        return np.full((z.shape[0], members, z.shape[-1]), np.nan)

    monkeypatch.setattr(shapes, "_independent", none)
    result = solve_modes(spans(3, math.inf), 4)
    np.testing.assert_allclose(result.frequencies_hz()[:3], CLAMPED, rtol=1e-10)
    assert any("could not be told apart" in text for text in result.warnings)
    assert all(mode.error_hz > 0 for mode in result.modes)
    assert result.to_dict()["modes"][0]["modal_mass"] is None
