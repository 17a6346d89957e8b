"""Numbers as a report prints them: so many digits, powers of ten, a minus sign."""

from __future__ import annotations

import math

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_MOST_DIGITS = 13
_PLAIN = 1e7  # from here on, and where so many digits would stand, powers of ten


def number(value: float | None, digits: int = 5) -> str:
    """Return a number with so many significant digits; a dash where there is none."""
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    mantissa, _, exponent = f"{value + 0.0:.{digits}g}".partition("e")
    if exponent and 1 <= abs(value) < _PLAIN:
        mantissa = f"{float(f'{mantissa}e{exponent}'):.0f}"
    elif exponent:
        power = str(int(exponent)).translate(_RAISED)
        bare = mantissa == "1" and value < 1
        mantissa = f"10{power}" if bare else f"{mantissa} × 10{power}"
    return mantissa.replace("-", "−")


def small(value: float) -> str:
    """Return an error or a residual: one decimal and its power of ten."""
    if value == 0 or math.isnan(value):
        return "0" if value == 0 else "–"
    mantissa, _, exponent = f"{value:.1e}".partition("e")
    return f"{mantissa} × 10{str(int(exponent)).translate(_RAISED)}".replace("-", "−")


def percent(fraction: float | None) -> str:
    """Return a fraction as a signed percentage."""
    if fraction is None or math.isnan(fraction):
        return "–"
    text = f"{100 * fraction:+.3g}" if abs(fraction) > 5e-9 else "0"
    return f"{text.replace('-', '−')} %"


def signed(value: float, decimals: int = 3) -> str:
    """Return a number with its sign."""
    if math.isnan(value):
        return "–"
    return f"{value:+.{decimals}f}".replace("-", "−")


def apart(low: float, high: float) -> tuple[str, str]:
    """Return two numbers with as many decimals as tell them apart, rounded outwards."""
    if not high > low:
        return number(low, 10), number(high, 10)
    decimals = max(0, math.ceil(-math.log10(high - low)))
    whole = len(str(int(max(abs(low), abs(high)))))
    decimals = min(decimals, max(0, _MOST_DIGITS - whole))
    scale = 10.0**decimals
    texts = (
        f"{math.floor(low * scale) / scale:.{decimals}f}",
        f"{math.ceil(high * scale) / scale:.{decimals}f}",
    )
    return texts[0].replace("-", "−"), texts[1].replace("-", "−")
