"""Which eigenvalue is the rotation of a body whose end forces follow: traced from no load.

Without axial force its omega^2 is zero. As all forces grow from nothing to what they are, it moves
without a jump, beside that of a rigid body. Real eigenvalues do not pass each other: the rotation
stays the lowest that is not exactly zero, until two of them meet and become a pair. Where the
lowest is also next to the rigid body's, it is that one; else it is traced, in steps of the forces
so small that what it moves to is not in doubt.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from antinode.arrays import Array
from antinode.riccati.chain import Chain
from antinode.riccati.roots import Eigenvalue

from .loading import loaded_chain
from .rigid import rigid_rotation

Solve = Callable[[Chain], Sequence[Eigenvalue]]

_STEP = 1 / 8  # of all forces, at first and at most
_LEAST = 1 / 512
_CLEAR = 1 / 3  # of the distance to the next eigenvalue, up to which one is that traced
_SLOWER = 2.0  # steps grow by that


def elastic(
    found: Sequence[Eigenvalue], rigid: int, chain: Chain | None = None
) -> list[Eigenvalue]:
    """Return the eigenvalues without the rigid ones: zeros, and the lowest that N moved off zero.

    Past buckling elastic modes lie below the translation. Of a `chain` whose end forces follow the
    rotation is set aside.
    """
    others = [value for value in found if value.omega2 != 0.0]
    if chain is not None and chain.follows and rigid > len(found) - len(others):
        held = rigid == 1
        pivot = (chain.nodes[-1] if chain.right == "pinned" else 0.0) if held else None
        others.pop(rotation_among(others, chain, pivot))
        return others
    return others[rigid - (len(found) - len(others)) :]


def rotation_among(
    found: Sequence[Eigenvalue],
    chain: Chain,
    pivot: float | None = None,
    solve: Solve | None = None,
) -> int:
    """Return which eigenvalue, of those that are not exactly zero, is the rotation.

    Parameters
    ----------
    found : sequence of Eigenvalue
        The lowest of the chain.
    chain : Chain
    pivot : float, optional
        Where the chain is held, from its left end [m]; it is free by default.
    solve : callable, optional
        Returns the lowest eigenvalues of a chain, as many as were found.
    """
    values = np.array([complex(value.value) for value in found])
    near = int(np.argmin(np.abs(values - rigid_rotation(chain, pivot))))
    if values[near].real <= np.min(values.real):
        return near
    place = trace(chain, pivot, solve or _solver_of(len(found) + 1))
    return near if place is None else int(np.argmin(np.abs(values - place)))


def trace(chain: Chain, pivot: float | None, solve: Solve) -> complex | None:
    """Return omega^2 of the rotation, traced from no load; None where it cannot be [rad^2/s^2]."""
    slope = complex(rigid_rotation(chain, pivot))
    share, here, step = 0.0, 0j, _STEP
    while share < 1.0:
        step = min(step, 1.0 - share)
        expected = here + slope * step
        values = _values(solve(loaded_chain(chain, share + step)))
        if not len(values):
            return None
        away = np.sort(np.abs(values - expected))
        clear = len(away) < 2 or away[0] <= _CLEAR * away[1]
        if not clear and step > _LEAST:
            step /= 2
            continue
        if not clear:  # two meet, or part: of these the one next to a rigid body's
            two = values[np.argsort(np.abs(values - expected))[:2]]
            values = two[[np.argmin(np.abs(two - rigid_rotation(chain, pivot) * (share + step)))]]
        new = complex(values[np.argmin(np.abs(values - expected))])
        slope, here, share = (new - here) / step, new, share + step
        step = min(_SLOWER * step, _STEP)
    return here


def _values(found: Sequence[Eigenvalue]) -> Array:
    """Return omega^2 of all that are not exactly zero, once for each pair."""
    values = [complex(v.value) for v in found if v.omega2 != 0.0 and v.imaginary >= 0.0]
    return np.array(values)


def _solver_of(wanted: int) -> Solve:
    """Return what finds so many eigenvalues of a chain, none where they are not proven."""
    from antinode.riccati import readable
    from antinode.riccati.roots import CountingError

    from .following import eigenvalues_alone, translates_freely

    def solve(chain: Chain) -> Sequence[Eigenvalue]:
        try:
            return eigenvalues_alone(readable, chain, wanted, int(translates_freely(chain)), 1e-8)
        except (CountingError, FloatingPointError):
            return []

    return solve
