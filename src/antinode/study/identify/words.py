"""What an identification leaves open, in words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .estimates import Direction, Estimates
from .unknowns import Unknown

MOST = 6
_NAMED = 4


def brief(value: float) -> str:
    """Write a number with two digits, without an exponent where it is of common size."""
    if not 1e-4 <= abs(value) < 1e6:
        return f"{value:.1e}"
    return np.format_float_positional(value, 2, unique=False, fractional=False, trim="-")


def amount(item: Unknown, sizes: float) -> str:
    """Say by how much an unknown moves along a direction, with its unit or in per cent."""
    if item.log:
        return f"{brief(100 * abs(sizes) * item.size)} %"
    unit = f" {item.unit}" if item.unit else ""
    return f"{brief(abs(sizes) * item.size)}{unit}"


def direction_text(estimates: Estimates, direction: Direction) -> str:
    """Say what trades off with what along a direction that the data do not determine."""
    items = estimates.unknowns.items
    step = min(1.0, estimates.noise / max(direction.singular_value, 1e-300))
    named = list(zip(direction.entries, direction.parts, strict=True))[:_NAMED]
    if len(direction.entries) == 1:
        return f"{items[direction.entries[0]].label} is not determined by the data"
    moves = [
        f"{items[k].label} {'up' if part > 0 else 'down'} by {amount(items[k], part * step)}"
        for k, part in named
    ]
    more = len(direction.entries) - len(named)
    rest = f" and {more} more" if more else ""
    names = " and ".join(items[k].label for k, _ in named[:2])
    return (
        f"{names} trade off: {', '.join(moves)}{rest} together change all frequencies by about "
        f"{_share(direction.singular_value * step / estimates.noise)}"
    )


def _share(change: float) -> str:
    return "nothing" if change < 1e-3 else f"{change:.2g} standard deviations"


def directions_text(estimates: Estimates) -> Iterator[str]:
    """Yield sentences on what the data do not determine, the worst first."""
    found = estimates.undetermined
    number = len(estimates.unknowns.items) - int(estimates.at_bound.sum())
    if not found:
        yield f"the data determine all {number} directions of the parameters"
        return
    count = f"{number - len(found)} of {number} directions of the parameters"
    yield f"the data determine {count} better than their priors (or natural sizes) do; not:"
    for direction in found[:MOST]:
        yield direction_text(estimates, direction)
    if len(found) > MOST:
        yield f"... and {len(found) - MOST} more directions"


def correlations_text(estimates: Estimates) -> Iterator[str]:
    """Yield sentences on strong correlations, the strongest first."""
    items, pairs = estimates.unknowns.items, estimates.strong_correlations
    for i, j, r in pairs[:MOST]:
        way = "together" if r > 0 else "against each other"
        yield f"{items[i].label} and {items[j].label} move {way} (correlation {r:+.3f})"
    if len(pairs) > MOST:
        yield f"... and {len(pairs) - MOST} more pairs beyond +-0.95"
