"""The one error rule on sequences whose limit is known."""

import numpy as np
import pytest

from antinode.riccati.convergence import extrapolate, within


def judged(levels, layer=0.0, coarse=0.0):
    rows = np.array(levels, dtype=float).reshape(len(levels), -1)
    better, error = np.empty(rows.shape[1]), np.empty(rows.shape[1])
    extrapolate(rows, len(rows) - 1, coarse, layer, better, error)
    return better, error


def fourth(limit, a, b=0.0, steps=(1.0, 0.5, 0.25)):
    """Values whose error is a h^4 + b h^6."""
    return [limit + a * h**4 + b * h**6 for h in steps]


def test_fourth_order_is_extrapolated_and_its_error_covers_the_sixth():
    better, error = judged(fourth(10.0, 0.3, 0.05))
    assert abs(better[0] - 10.0) < error[0] < 0.3 / 256
    assert abs(better[0] - 10.0) > 0


def test_levels_that_agree_by_accident_keep_a_share_of_the_change_before():
    _, error = judged([10.0, 11.0, 11.0])
    assert error[0] >= 1.0 / 16 / 100


def test_a_neighbour_that_still_moves_is_a_doubt():
    alone = judged([[10.0], [10.0], [10.0]])[1][0]
    beside = judged([[10.0, 12.0], [10.0, 12.4], [10.0, 12.5]])[1][0]
    assert alone == 0.0
    assert beside > 0


@pytest.mark.parametrize("order", [0.5, 1, 2])
def test_layers_longer_than_steps_count_the_whole_difference(order):
    """What layers leave falls slowly, under a fourth order that hides it."""
    levels = [5.0 + 3e-2 * h**4 + 1e-3 * h**order for h in (1, 0.5, 0.25)]
    better, error = judged(levels, layer=1.0)
    assert abs(better[0] - 5.0) <= error[0]
    if order < 2:
        assert abs(better[0] - 5.0) > judged(levels)[1][0]


def test_layers_are_judged_by_the_mode_that_they_move_most():
    levels = [[1.0, 50.0], [1.0, 50.5], [1.0, 50.6]]
    _, error = judged(levels, layer=1.0)
    assert error[0] == pytest.approx(error[1] / 50, rel=0.1)


def test_two_levels_state_a_quarter_of_their_change():
    better, error = judged(fourth(10.0, 0.3, steps=(1.0, 0.5)))
    assert better[0] == pytest.approx(10.0)
    assert error[0] == pytest.approx(0.3 * 15 / 16 / 4)


def test_tolerances_are_of_frequencies_and_near_zero_of_the_least():
    values = np.array([100.0, 1e-20])
    assert within(values, np.array([1e-3, 1e-12]), 1e-5, 1e-6)
    assert not within(values, np.array([3e-3, 1e-12]), 1e-5, 1e-6)
    assert not within(values, np.array([1e-3, 1e-12]), 1e-5, 1e-9)
    assert not within(values, np.array([np.nan, 0.0]), 1.0, 1.0)


def test_layers_that_the_coarsest_steps_missed_count_the_whole_difference():
    levels = fourth(10.0, 0.3, 0.05)
    errors = [judged(levels, layer)[1][0] for layer in (0.01, 0.1, 1.0)]
    assert errors[1] == pytest.approx(4 * errors[0])
    assert errors[2] == pytest.approx(3 * errors[1])
