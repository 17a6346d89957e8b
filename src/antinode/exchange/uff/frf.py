"""Natural frequencies from frequency responses: peaks, and a curve fit about each of them.

About a peak every response is, with s = i omega and one pole for all of them,

    H(s) = (a + b s) / (omega_0^2 + 2 zeta omega_0 s + s^2) + c.

a, b and c follow linearly; omega_0 and zeta minimise what is left. The standard deviation of
omega_0 / 2 pi is that of the fit, with the change of the result in a window of twice the width:
what neighbouring modes and the form of the curve do to it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from antinode.arrays import Array, Complex

PROMINENCE = 6.0
"""By how much a peak stands out of its surroundings, of the responses' summed squares [dB]."""
FLOOR = 1e-6
"""Smallest relative standard deviation that is stated: files keep six digits."""
WORST = 0.06, 0.4
"""Largest share of the responses about a peak that a fit may leave: for each of them, and at most.

Noise in one response alone looks like a mode more often than in many at once.
"""
SHARPEST = 0.2
"""Least half-power width of a mode in spacings of lines: a sharper peak may be one bad line."""
_LINES = 6  # on either side of a peak, at least
_WIDTHS = 3.0  # half-power widths on either side
_MOST_DAMPED = 0.3


@dataclass(frozen=True)
class Peak:
    """A mode found in frequency responses.

    Attributes
    ----------
    frequency_hz, sd_hz : float
        Of the undamped mode, and its standard deviation.
    damping : float
        Ratio zeta.
    residues : array, shape (responses,)
        Complex, to a common scale.
    """

    frequency_hz: float
    sd_hz: float
    damping: float
    residues: Complex


def find_modes(frequency_hz: Array, responses: Complex) -> tuple[Peak, ...]:
    """Find the modes in frequency responses.

    Parameters
    ----------
    frequency_hz : array, shape (lines,)
        Increasing and positive.
    responses : array, shape (lines, responses)
        Displacement over force.

    Returns
    -------
    tuple of Peak
        In order of frequency.
    """
    from scipy.signal import find_peaks

    scale = np.max(np.abs(responses), axis=0)
    H = responses[:, scale > 0] / scale[scale > 0]
    # accelerations show all modes alike
    level = 10 * np.log10(np.sum(np.abs(H * frequency_hz[:, None] ** 2) ** 2, axis=1) + 1e-300)
    at, _ = find_peaks(level, prominence=PROMINENCE)
    bounds = np.concatenate([[0], (at[1:] + at[:-1]) // 2, [len(level) - 1]])
    peaks = []
    for k, i in enumerate(at):
        found = _fit_peak(frequency_hz, H, level, int(i), (int(bounds[k]), int(bounds[k + 1])))
        if found is not None:
            residues = np.zeros(len(scale), dtype=complex)
            residues[scale > 0] = found.residues * scale[scale > 0]
            peaks.append(Peak(found.frequency_hz, found.sd_hz, found.damping, residues))
    return tuple(peaks)


def _fit_peak(f: Array, H: Complex, level: Array, at: int, bounds: tuple[int, int]) -> Peak | None:
    """Fit a pole to the lines about a peak; None where the curve is none of a mode."""
    width = _half_power_lines(level, at)
    fits = []
    for times in (1, 2):
        reach = times * max(_LINES, math.ceil(_WIDTHS * width))
        part = slice(max(at - reach, bounds[0]), min(at + reach, bounds[1]) + 1)
        if part.stop - part.start < _LINES + 1:
            return None
        fits.append(_fit(f[part], H[part], float(f[at]), width * _spacing(f, at) / f[at] / 2))
    narrow, wide = fits
    seen = 2 * narrow.damping * narrow.f > SHARPEST * _spacing(f, at)
    inside = f[0] < narrow.f < f[-1] and narrow.damping < _MOST_DAMPED
    if not (seen and inside and narrow.left < min(WORST[0] * H.shape[1], WORST[1])):
        return None
    sd = math.hypot(narrow.sd, narrow.f - wide.f, FLOOR * narrow.f)
    return Peak(narrow.f, sd, narrow.damping, narrow.residues)


def _half_power_lines(level: Array, at: int) -> float:
    """Return how many lines apart the level is 3 dB below a peak."""
    below = level < level[at] - 3
    left = at - int(np.argmax(below[at::-1])) if np.any(below[: at + 1]) else at - 1
    right = at + int(np.argmax(below[at:])) if np.any(below[at:]) else at + 1
    return float(max(right - left - 1, 1))


def _spacing(f: Array, at: int) -> float:
    near = f[max(at - 1, 0) : at + 2]
    return float(np.ptp(near)) / (len(near) - 1)


@dataclass(frozen=True)
class _Fit:
    f: float
    damping: float
    sd: float
    left: float
    residues: Complex


def _fit(f: Array, H: Complex, f0: float, damping: float) -> _Fit:
    from scipy.optimize import least_squares

    s = 1j * f / f0  # in units of the peak's omega

    def basis(pole: Array) -> Complex:
        w, zeta = np.exp(pole)
        D = w**2 + 2 * zeta * w * s + s**2
        return np.stack([1 / D, s / D, np.ones_like(s)], axis=1)

    def left(pole: Array) -> Array:
        Q, _ = np.linalg.qr(basis(pole))
        rest = H - Q @ (Q.conj().T @ H)
        return np.concatenate([rest.real.ravel(), rest.imag.ravel()])

    start = np.array([0.0, math.log(min(max(damping, 1e-6), 0.1))])
    bounds = ([-0.5, math.log(1e-8)], [0.5, 0.0])
    found: Any = least_squares(left, start, bounds=bounds, x_scale=[1e-3, 1.0], xtol=1e-12)
    w, zeta = np.exp(found.x)
    B = basis(found.x)
    a, b, _ = np.linalg.lstsq(B, H, rcond=None)[0]
    free = max(2 * H.size - 6 * H.shape[1] - 2, 1)
    normal = found.jac.T @ found.jac
    variance = np.linalg.pinv(normal)[0, 0] * 2 * found.cost / free
    share = 2 * found.cost / float(np.sum(np.abs(H - H.mean(axis=0)) ** 2) or 1.0)
    sd = math.sqrt(max(float(variance), 0.0)) * w * f0
    return _Fit(float(w * f0), float(zeta), float(sd), share, a + 1j * w * b)
