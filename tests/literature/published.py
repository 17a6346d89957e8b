"""What the tests of this folder share: printed numbers, their last digit, and tables of stations.

A published number is kept as the text that was printed, so that its last digit is known. antinode
must agree within one unit of that digit: some tables are rounded, others cut off.

Where the numbers were read: Ozgumus and Kaya in the reprint that the test names, Hodges and Pierce
as quoted in the tests of AeroBeams.jl, Greenhill as quoted in encyclopaedias. The other tables were
written down without a copy at hand, before antinode was run on them; a slip of memory would not
agree to the last digit. What did not agree was left out, never adjusted.
"""

from collections.abc import Callable, Iterable
from decimal import Decimal

import numpy as np

import antinode as an


def last_digit(printed: str) -> float:
    """Return one unit of the last printed digit."""
    return float(Decimal(1).scaleb(Decimal(printed).as_tuple().exponent))


def check_printed(found: Iterable[float], printed: str) -> None:
    """Compare with the numbers of one printed row, each within one unit of its last digit."""
    for value, text in zip(found, printed.split(), strict=True):
        assert abs(value - float(text)) <= last_digit(text), f"{value} is not {text}"


def omegas(problem: an.Beam, modes: int, family: str = "bending") -> np.ndarray:
    """Return the circular frequencies of the elastic modes [rad/s]."""
    result = an.solve_modes(problem, modes, tolerance=1e-8, families=(family,))
    return np.sqrt([m.omega2 for m in result.family(family) if m.number])


def unit_beam(left: str, right: str, EA: float | None = None) -> an.Beam:
    """Return a uniform beam with m = EI = L = 1, so that omega = (beta L)^2."""
    return an.Beam.from_stations([0.0, 1.0], 1.0, 1.0, EA, ends=an.Ends(left, right))


def extrapolated(found: Callable[[int], np.ndarray], stations: int) -> np.ndarray:
    """Return the limit of many stations: straight lines between them err as 1/stations^2."""
    coarse, fine = found(stations), found(2 * stations)
    return (4 * fine - coarse) / 3
