"""Polynomials by their control values, against numpy's own."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from antinode.beam import curves

RNG = np.random.default_rng(16)


def powers(control):
    """The same polynomial in powers of t."""
    p, t = len(control) - 1, Polynomial([0, 1])
    terms = [np.prod([p - i for i in range(j)]) / np.prod(range(1, j + 1)) for j in range(p + 1)]
    return sum(
        c * n * t**j * (1 - t) ** (p - j)
        for j, (c, n) in enumerate(zip(control, terms, strict=True))
    )


@pytest.mark.parametrize("degree", [1, 2, 4, 8])
def test_values_parts_integrals_and_moments(degree):
    control = RNG.uniform(0.5, 2, (3, degree + 1))
    t = RNG.uniform(0, 1, 3)
    want = [powers(c) for c in control]
    assert curves.value(control, t) == pytest.approx(
        [f(s) for f, s in zip(want, t, strict=True)], rel=1e-13
    )
    assert curves.value(control, [0.0, 0, 0]).tolist() == control[:, 0].tolist()
    assert curves.value(control, [1.0, 1, 1]).tolist() == control[:, -1].tolist()
    piece = curves.part(control, np.full(3, 0.2), np.full(3, 0.7))
    middle = [f(0.2 + 0.5 * s) for f, s in zip(want, t, strict=True)]
    assert curves.value(piece, t) == pytest.approx(middle, rel=1e-13)
    found = curves.moments(control, 3.0, t)
    for q, moment in enumerate(found):
        exact = [(f * Polynomial([0, 3]) ** q * 3).integ()(s) for f, s in zip(want, t, strict=True)]
        assert moment == pytest.approx(exact, rel=1e-12)


def test_sums_and_products():
    f, g = RNG.uniform(0.5, 2, (2, 4)), RNG.uniform(0.5, 2, (2, 3))
    t = np.array([0.3, 0.9])
    F, G = curves.value(f, t), curves.value(g, t)
    assert curves.value(curves.product(f, g), t) == pytest.approx(F * G, rel=1e-14)
    assert curves.value(curves.total(f, g), t) == pytest.approx(F + G, rel=1e-14)
    assert curves.value(curves.raised(f, 7), t) == pytest.approx(F, rel=1e-14)
    P, Q = curves.Polynomial(f), curves.Polynomial(g)
    mixed = np.float64(2) * (P * Q - Q) + P
    assert curves.value(mixed.control, t) == pytest.approx(2 * (F * G - G) + F, rel=1e-13)


def test_a_small_end_keeps_its_digits():
    """D^4 from 1 to 1e-12: nothing cancels near the thin end."""
    D = np.array([[1.0, 1e-3]])
    quartic = curves.product(curves.product(D, D), curves.product(D, D))
    t = 1 - 1e-5
    exact = (1 - t + 1e-3 * t) ** 4
    assert curves.value(quartic, [t])[0] == pytest.approx(exact, rel=1e-14)


def test_a_polynomial_is_fitted_exactly():
    control = RNG.uniform(0.5, 2, (2, 9))
    values = curves.value(control[:, None], curves.places(8))
    assert curves.fitted(values) == pytest.approx(control, rel=1e-11)
