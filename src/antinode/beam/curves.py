"""Polynomials inside intervals, by their control values (Bernstein's form).

A property has the values ``c_0 ... c_p`` on an interval and runs there as

    f(t) = sum_j c_j B_j(t),   B_j(t) = p! / (j! (p-j)!) t^j (1-t)^(p-j),   t = 0 ... 1

so that `c_0` and `c_p` stand at its ends, and two values are a straight line. Where they all are
positive, so is f, and every sum below is one of positive terms: nothing cancels, and sums,
products, parts and integrals are exact to rounding, however much f changes over the interval.

Arrays have the shape (..., n, p + 1): n intervals, before them cases.
Source: R. T. Farouki, V. T. Rajan, Computer Aided Geometric Design 5 (1988) 1-26.
"""

from __future__ import annotations

from functools import cache
from math import comb
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from antinode.arrays import Array


def value(control: Array, t: ArrayLike) -> Array:
    """Return f at the place `t`, one for each interval, or one for all; exact at both ends."""
    t = np.asarray(t, dtype=float)[..., None]
    while control.shape[-1] > 1:
        control = control[..., :-1] * (1 - t) + control[..., 1:] * t
    return np.asarray(control[..., 0])


def part(control: Array, start: ArrayLike, end: ArrayLike) -> Array:
    """Return the control values of f on the parts of intervals between two places."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    degree = control.shape[-1] - 1
    return np.stack([_blossom(control, start, degree - j, end) for j in range(degree + 1)], axis=-1)


def _blossom(control: Array, start: Array, times: int, end: Array) -> Array:
    """Return f's polar form of which so many arguments are `start`, the others `end`."""
    degree = control.shape[-1] - 1
    for t in [start] * times + [end] * (degree - times):
        control = control[..., :-1] * (1 - t[..., None]) + control[..., 1:] * t[..., None]
    return np.asarray(control[..., 0])


@cache
def _products(p: int, q: int) -> Array:
    """Return what control values i and j of two factors give to those of the product."""
    weights = np.zeros((p + q + 1, p + 1, q + 1))
    for i in range(p + 1):
        for j in range(q + 1):
            weights[i + j, i, j] = comb(p, i) * comb(q, j) / comb(p + q, i + j)
    return weights


def product(f: Array, g: Array) -> Array:
    """Return the control values of f g."""
    weights = _products(f.shape[-1] - 1, g.shape[-1] - 1)
    return np.asarray(np.einsum("kij,...i,...j->...k", weights, f, g))


def raised(control: Array, degree: int) -> Array:
    """Return f with as many control values as a polynomial of a higher degree has."""
    more = degree - (control.shape[-1] - 1)
    return product(control, np.ones(more + 1)) if more > 0 else control


def total(f: Array, g: Array) -> Array:
    """Return the control values of f + g."""
    degree = max(f.shape[-1], g.shape[-1]) - 1
    return np.asarray(raised(f, degree) + raised(g, degree))


def integral(control: Array) -> Array:
    """Return the control values of the integral of f from t = 0, one more than those of f."""
    sums = np.cumsum(control, axis=-1) / control.shape[-1]
    return np.concatenate([np.zeros_like(sums[..., :1]), sums], axis=-1)


def moments(control: Array, length: Any, t: ArrayLike, most: int = 2) -> list[Array]:
    """Return ``integral of f s^q ds``, q = 0 ... most, over the first part of every interval.

    Parameters
    ----------
    control : array, shape (..., p + 1)
    length : array_like
        Of the intervals; s runs from 0 to `length`.
    t : array_like
        Share of it at which the integral ends.
    """
    found, step = [], np.array([0.0, 1.0])
    for power in range(most + 1):
        found.append(np.asarray(value(integral(control), t) * length ** (power + 1)))
        control = product(control, step)
    return found


def fitted(values: Array) -> Array:
    """Return the control values of the polynomial through values at `places` of its degree."""
    return np.asarray(values @ _interpolation(values.shape[-1] - 1).T)


def places(degree: int) -> Array:
    """Return where a polynomial of a degree is fitted: both ends, and Chebyshev's places inside."""
    return np.asarray((1 - np.cos(np.pi * np.arange(degree + 1) / degree)) / 2)


@cache
def _interpolation(degree: int) -> Array:
    t = places(degree)[:, None]
    j = np.arange(degree + 1)
    choose = np.array([comb(degree, k) for k in j])
    return np.asarray(np.linalg.inv(choose * t**j * (1 - t) ** (degree - j)))


class Polynomial:
    """A property with the arithmetic of polynomials: sums, products, and multiples by numbers.

    Parameters
    ----------
    control : ndarray (..., n, p + 1)
    """

    __array_ufunc__ = None  # numpy's scalars leave the arithmetic to this class

    def __init__(self, control: Array) -> None:
        self.control = control

    def __add__(self, other: Polynomial) -> Polynomial:
        return Polynomial(total(self.control, other.control))

    def __sub__(self, other: Polynomial) -> Polynomial:
        return Polynomial(total(self.control, -other.control))

    def __mul__(self, other: Polynomial | float) -> Polynomial:
        if isinstance(other, Polynomial):
            return Polynomial(product(self.control, other.control))
        return Polynomial(self.control * other)

    __rmul__ = __mul__
