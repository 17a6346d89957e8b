"""Critical loads in 40 digits, by Taylor series along the beam: no chain, no circle, no count.

The state [Y, psi, M, Q] obeys ``z' = A(x) z`` with columns that are linear in each interval; its
Taylor coefficients follow from those of A by a recurrence. Flutter is where D and its derivative by
omega^2 vanish together, divergence where the first coefficient of D at 0 that does not vanish by
the supports does.
"""

import mpmath
from mpmath import mpf

_TERMS = 70
_STEPS = 4


class Digits:
    """The characteristic function of a beam without attachments, under a factor on its N.

    Haringx' form of Timoshenko's theory where shear and rotary inertia are given.
    """

    def __init__(self, beam, digits=60):
        self.beam, self.digits = beam, digits
        self.straight = beam.interpolation != "log"
        assert self.straight

    def _column(self, name, k, start, share):
        table = getattr(self.beam, name)
        if table is None:
            return [mpf(0), mpf(0)]
        c = [mpf(float(v)) for v in table[k]]
        if len(c) == 2:
            return [c[0] + (c[1] - c[0]) * start, (c[1] - c[0]) * share]
        a, b, d = c[0], 2 * (c[1] - c[0]), c[0] - 2 * c[1] + c[2]  # control values of a parabola
        if len(c) == 3:
            return [a + (b + d * start) * start, (b + 2 * d * start) * share, d * share**2]
        b, d, e = 3 * (c[1] - c[0]), 3 * (c[0] - 2 * c[1] + c[2]), c[3] - c[0] + 3 * (c[1] - c[2])
        return [
            a + (b + (d + e * start) * start) * start,
            (b + (2 * d + 3 * e * start) * start) * share,
            (d + 3 * e * start) * share**2,
            e * share**3,
        ]

    def __call__(self, omega2, factor):
        mpmath.mp.dps = self.digits
        beam = self.beam
        assert beam.axial_acceleration == 0
        left, right = (mpf(v) * factor for v in beam.following())
        held = beam.ends.left == "clamped"
        z = [[0, 0, 1, 0], [0, 0, 0, 1]] if held else [[1, 0, 0, 0], [0, 1, 0, left]]
        z = [[mpf(v) for v in column] for column in z]
        for k in range(len(beam.x) - 1):
            h = (mpf(float(beam.x[k + 1])) - mpf(float(beam.x[k]))) / _STEPS
            for step in range(_STEPS):
                share = mpf(1) / _STEPS
                entries = self._entries(k, step * share, share, omega2, factor)
                z = [_passed(column, entries, h) for column in z]
        M, Q = [c[2] for c in z], [c[3] - right * c[1] for c in z]
        return M[0] * Q[1] - M[1] * Q[0]

    def _entries(self, k, start, share, omega2, factor):
        """Return 1/EI, alpha, beta, mu, s and the load that turns along a step, 0 to 1."""
        EI, m, N = (
            self._column(name, k, start, share)
            for name in ("bending_stiffness", "mass_per_length", "axial_force")
        )
        N = [factor * v for v in N]
        ratio = -EI[1] / EI[0]
        flexibility = [ratio**n / EI[0] for n in range(_TERMS if EI[1] else 1)]
        shear = self.beam.shear_stiffness
        s = mpf(0) if shear is None else 1 / mpf(float(shear[k, 0]))
        load = [factor * v for v in self._column("tangential_load", k, start, share)]
        alpha = [s * v for v in N]
        alpha[0] += 1
        rotary = self._column("rotary_inertia_per_length", k, start, share)
        beta = [mpf(0)] * (2 * len(N) - 1)
        for i, a in enumerate(alpha):
            for j, b in enumerate(N):
                beta[i + j] += a * b
        for i, r in enumerate(rotary):
            beta[i] += omega2 * r
        return flexibility, alpha, beta, [omega2 * v for v in m], [s], load

    def flutter(self, factor, omega2):
        """Return factor and omega^2 near a guess where two eigenvalues meet."""
        mpmath.mp.dps = self.digits
        step = mpf(10) ** (-self.digits // 3) * abs(mpf(omega2))

        def both(p, z):
            low, high = self(z - step, p), self(z + step, p)
            return [self(z, p), (high - low) / (2 * step)]

        found = mpmath.findroot(both, (mpf(factor), mpf(omega2)), tol=1e-30, maxsteps=20)
        return float(found[0]), float(found[1])

    def divergence(self, factor, zeros=0):
        """Return the factor near a guess where D over omega^2 to the number of its zeros is 0."""
        mpmath.mp.dps = self.digits
        step = mpf(10) ** (-self.digits // 4)

        def rest(p):
            if zeros == 0:
                return self(mpf(0), p)
            if zeros == 1:
                return (self(step, p) - self(-step, p)) / (2 * step)
            return (self(step, p) + self(-step, p) - 2 * self(mpf(0), p)) / step**2

        start = mpf(factor)
        near = (start * (1 - mpf("1e-6")), start * (1 + mpf("1e-6")))
        return float(mpmath.findroot(rest, near, tol=1e-25, verify=False))


def _passed(z, entries, h):
    """Return a state at the end of a step of length h."""
    flexibility, alpha, beta, mu, s, load = entries
    Y, psi, M, Q = ([v] for v in z)

    def times(a, b, n):
        return mpmath.fsum(a[i] * b[n - i] for i in range(min(n + 1, len(a))))

    for n in range(_TERMS):
        share = h / (n + 1)
        new = (
            times(alpha, psi, n) - times(s, Q, n),
            times(flexibility, M, n),
            times(alpha, Q, n) - times(beta, psi, n),
            times(mu, Y, n) + times(load, psi, n),
        )
        for series, value in zip((Y, psi, M, Q), new, strict=True):
            series.append(share * value)
    return [mpmath.fsum(series) for series in (Y, psi, M, Q)]
