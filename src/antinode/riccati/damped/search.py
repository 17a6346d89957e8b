r"""Zeros of the characteristic function D(s): secants through three places, from many starts.

What is known is divided out: eigenvalues found, their conjugates, and those at s = 0. What is left
over is told by sums of powers of all that a path encloses (Delves, Lyness, Math. Comp. 21 (1967)
543), and starts there.
"""

from __future__ import annotations

import numpy as np

from antinode.riccati.arrays import Array, Complex, Numbers

from .chain import Damped

_PASSES = 40
_SMALL = 1e-14
_NEAR = 1e-3  # of a start: the two places beside it


class Search:
    """Finds zeros in the upper half plane, and on the real axis.

    Parameters
    ----------
    damped : Damped
        Whose D it is.
    zeros : int
        Zeros at s = 0, divided out.
    unit : float
        Size of s [1/s] where zeros are looked for.
    mirrored : bool
        Whether the conjugate of every zero is one.
    floor : float
        Length of a step that rounding may leave near s = 0 [1/s].
    """

    def __init__(
        self,
        damped: Damped,
        zeros: int,
        unit: float,
        mirrored: bool = True,
        floor: float = 0.0,
    ) -> None:
        self.damped, self.zeros, self.unit, self.mirrored = damped, zeros, unit, mirrored
        self.floor = floor

    def deflated(self, s: Complex, known: list[complex]) -> tuple[Complex, Array]:
        """Return D with what is known divided out."""
        value, size = self.damped.characteristic(s)
        divisor = np.log((s / self.unit).astype(complex)) * self.zeros
        for root in known:
            divisor = divisor + np.log((s - root) / self.unit)
            if self.mirrored and root.imag:
                divisor = divisor + np.log((s - root.conjugate()) / self.unit)
        return value * np.exp(-1j * divisor.imag), size - divisor.real

    def run(self, starts: Complex, known: list[complex]) -> tuple[Complex, Array]:
        """Return where secants from each start end, and the length of their last step.

        Places that did not settle have an infinite step.
        """
        found = self.damped.other.find(
            starts,
            known,
            zeros=self.zeros,
            unit=self.unit,
            floor=self.floor,
            mirrored=self.mirrored,
        )
        return self._secants(starts, known) if found is None else found

    def _secants(self, starts: Complex, known: list[complex]) -> tuple[Complex, Array]:
        x = np.stack([starts, starts * (1 + _NEAR), starts * (1 + _NEAR * 1j)])
        with np.errstate(all="ignore"):
            y, size = self.deflated(x.ravel(), known)
            y, size = y.reshape(x.shape), size.reshape(x.shape)
            step = np.full(len(starts), np.inf)
            done = np.zeros(len(starts), bool)
            for _ in range(_PASSES):
                scale = np.max(size, axis=0)
                move = _muller(x, y * np.exp(size - scale))
                far = np.abs(move) > np.abs(x[2]) + 0.1 * self.unit
                move = np.where(far, move / np.abs(move) * (np.abs(x[2]) + 0.1 * self.unit), move)
                new = x[2] + move
                if self.mirrored:
                    new = np.where(new.imag < 0, new.conjugate(), new)
                    new = np.where(np.abs(new.imag) < 1e-13 * np.abs(new), new.real, new)
                open_ = np.flatnonzero(~done & np.isfinite(new))
                if not len(open_):
                    break
                moved = np.abs(new[open_] - x[2, open_])
                at, logarithm = self.deflated(new[open_], known)
                x[:, open_] = np.stack([x[1, open_], x[2, open_], new[open_]])
                y[:, open_] = np.stack([y[1, open_], y[2, open_], at])
                size[:, open_] = np.stack([size[1, open_], size[2, open_], logarithm])
                settled = (moved <= _SMALL * np.abs(new[open_])) | (at == 0)
                near = moved < 1e-9 * np.abs(new[open_]) + self.floor
                step[open_] = np.where(near, moved, np.inf)
                done[open_[settled]] = True
        return x[2], step


def _muller(x: Complex, y: Complex) -> Complex:
    """Return the steps from the last of three places to the nearest zero of their parabolas."""
    h1, h2 = x[1] - x[0], x[2] - x[1]
    d1, d2 = (y[1] - y[0]) / h1, (y[2] - y[1]) / h2
    a = (d2 - d1) / (h1 + h2)
    b = a * h2 + d2
    root = np.sqrt(b * b - 4 * a * y[2] + 0j)
    below = np.where(np.abs(b + root) > np.abs(b - root), b + root, b - root)
    move = -2 * y[2] / below
    return np.where((h1 == 0) | (h2 == 0) | (y[2] == 0), 0.0, move)


def left_over(sums: Complex, known: Numbers) -> Complex:
    """Return the zeros whose sums of powers 0 ... m remain when known ones are taken away.

    Parameters
    ----------
    sums : array, shape (n + 1,)
        Of all; the first is their number.
    known : array
        Ones among them.
    """
    number = round(sums[0].real) - len(known)
    if number < 1:
        return np.zeros(0, complex)
    p = [sums[k] - np.sum(known**k) for k in range(number + 1)]
    e = [1.0 + 0j]
    for k in range(1, number + 1):
        e.append(sum((-1) ** (i - 1) * e[k - i] * p[i] for i in range(1, k + 1)) / k)
    return np.roots([(-1) ** k * e[k] for k in range(number + 1)]).astype(complex)
