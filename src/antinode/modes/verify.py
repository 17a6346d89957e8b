"""Built-in checks against closed forms, in seconds.

Every row compares frequencies of the default method with a formula that shares nothing with it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.ends import End, Ends
from antinode.beam.families import BENDING, LONGITUDINAL

from .solve import solve_one

ALLOWED = 1e-10
"""Largest relative error of a frequency that passes."""


@dataclass(frozen=True)
class Check:
    """One comparison.

    Attributes
    ----------
    name, formula : str
        What was computed, and the closed form it was compared with.
    modes : int
        How many frequencies were compared.
    worst : float
        Largest relative difference of a frequency.
    """

    name: str
    formula: str
    modes: int
    worst: float

    @property
    def passed(self) -> bool:
        """Whether the worst difference is within `ALLOWED`."""
        return self.worst <= ALLOWED

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "name": self.name,
            "formula": self.formula,
            "modes": self.modes,
            "worst_relative_error": self.worst,
            "passed": self.passed,
        }


def run_checks() -> list[Check]:
    """Compute all checks.

    Returns
    -------
    list of Check
    """
    return list(_checks())


def _checks() -> Iterator[Check]:
    for segments in (1, 100, 1000):
        for left, right, text, function, guess in _UNIFORM:
            roots = [_root(function, guess(k)) for k in range(1, 11)]
            beam = _uniform(segments, Ends(left, right))
            yield _compare(f"{left}-{right}, {segments} segments", text, beam, np.array(roots) ** 4)
    for load in (-5.0, 0.5, 0.99):
        yield _pinned_under_load(load)
    yield _divergent_column()
    yield _bar()


def _beta(sign: float) -> Callable[[float], float]:
    """Return cos z + sign / cosh z, whose roots are those of cos z cosh z = -sign."""
    return lambda z: math.cos(z) + sign / math.cosh(z)


def _tangents(z: float) -> float:
    """Return sin z - cos z tanh z, whose roots are those of tan z = tanh z."""
    return math.sin(z) - math.cos(z) * math.tanh(z)


_UNIFORM: tuple[tuple[End, End, str, Callable[[float], float], Callable[[int], float]], ...] = (
    ("free", "free", "cos z cosh z = 1", _beta(-1.0), lambda k: (k + 0.5) * math.pi),
    ("clamped", "free", "cos z cosh z = -1", _beta(1.0), lambda k: (k - 0.5) * math.pi),
    ("clamped", "clamped", "cos z cosh z = 1", _beta(-1.0), lambda k: (k + 0.5) * math.pi),
    ("clamped", "pinned", "tan z = tanh z", _tangents, lambda k: (k + 0.25) * math.pi),
    ("pinned", "pinned", "sin z = 0", math.sin, lambda k: k * math.pi),
)


def _root(function: Callable[[float], float], guess: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(function, guess - 0.4, guess + 0.4, xtol=1e-15, rtol=1e-15))


def _uniform(segments: int, ends: Ends, axial_force: float = 0.0) -> Beam:
    x = np.linspace(0.0, 1.0, segments + 1)
    one = np.ones(segments + 1)
    return Beam.from_stations(x, one, one, one, axial_force * one, ends=ends)


def _compare(name: str, formula: str, beam: Beam, omega2: np.ndarray) -> Check:
    result = solve_one(beam, len(omega2), families=(BENDING,))
    found = np.array([m.omega2 for m in result.modes if m.number])
    worst = float(np.max(np.abs(found / omega2 - 1))) / 2
    return Check(name, formula, len(omega2), worst)


def _pinned_under_load(load: float) -> Check:
    z = np.arange(1, 11) * math.pi
    N = load * math.pi**2
    beam = _uniform(100, Ends("pinned", "pinned"), N)
    name = f"pinned-pinned, N = {load:g} Euler load"
    return _compare(name, "w^2 = z^4 - N z^2", beam, z**4 - N * z**2)


def _divergent_column() -> Check:
    z = np.arange(1, 11) * math.pi
    N = 1.5 * math.pi**2
    beam = _uniform(100, Ends("pinned", "pinned"), N)
    return _compare("pinned-pinned, past buckling", "w^2 = z^4 - N z^2", beam, z**4 - N * z**2)


def _bar() -> Check:
    result = solve_one(_uniform(100, Ends()), 10, families=(LONGITUDINAL,))
    found = np.array([m.omega2 for m in result.modes if m.number])
    exact = (np.arange(1, 11) * math.pi) ** 2
    worst = float(np.max(np.abs(found / exact - 1))) / 2
    return Check("free-free bar, longitudinal", "w = k pi sqrt(EA/m)/L", 10, worst)
