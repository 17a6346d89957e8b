"""Drawn beams in 30 digits: `DrawnBeam(...).omega2(guess)`, by Taylor series along the beam.

    Y' = alpha psi - s Q,  psi' = M/EI,  M' = alpha Q - beta psi,  Q' = m omega^2 Y

Sections are those of textbooks, in the form pi/4 (D^2 - d^2), pi/64 (D^4 - d^4), and Cowper's table
with m = d/D; dimensions are straight lines over the whole beam. Each step is short against the
distance to the nearest place where a dimension would vanish, so that 48 terms leave 30 digits. No
transfer matrix of a uniform segment, no average, no control value is shared with the package.
"""

from dataclasses import dataclass

from mpmath import mp, mpf, pi

DIGITS, TERMS = 36, 48


def times(a, b):
    """The product of two series."""
    return [sum(a[i] * b[k - i] for i in range(k + 1)) for k in range(len(a))]


def over(a, b):
    """The quotient of two series."""
    found = []
    for k in range(len(a)):
        known = sum(found[i] * b[k - i] for i in range(k))
        found.append((a[k] - known) / b[0])
    return found


def plus(*series):
    return [sum(terms) for terms in zip(*series, strict=True)]


def scaled(c, a):
    return [c * x for x in a]


def constant(c):
    return [mpf(c)] + [mpf(0)] * (TERMS - 1)


def tube(nu, D, t):
    """A, I and kappa A of a tube as series."""
    d = plus(D, scaled(-2, t))
    D2, d2 = times(D, D), times(d, d)
    area = scaled(pi / 4, plus(D2, scaled(-1, d2)))
    second = scaled(pi / 64, plus(times(D2, D2), scaled(-1, times(d2, d2))))
    m2 = over(d2, D2)
    square = times(plus(constant(1), m2), plus(constant(1), m2))
    below = plus(scaled(7 + 6 * nu, square), scaled(20 + 12 * nu, m2))
    kappa = over(scaled(6 * (1 + nu), square), below)
    return area, second, times(kappa, area)


def circle(nu, D):
    return tube(nu, D, scaled(mpf(1) / 2, D))


def rectangle(nu, w, h):
    area = times(w, h)
    second = scaled(mpf(1) / 12, times(area, times(h, h)))
    return area, second, scaled(10 * (1 + nu) / (12 + 11 * nu), area)


def box(nu, w, h, t):
    inner = [plus(side, scaled(-2, t)) for side in (w, h)]
    area = plus(times(w, h), scaled(-1, times(*inner)))
    cubes = [times(a, times(b, times(b, b))) for a, b in ((w, h), inner)]
    second = scaled(mpf(1) / 12, plus(cubes[0], scaled(-1, cubes[1])))
    return area, second, None


@dataclass
class DrawnBeam:
    """A beam of one interval: `section` and its dimensions at both ends, E, rho, nu, and N."""

    section: object
    dimensions: tuple
    E: float
    rho: float
    nu: float = 0.3
    length: float = 1.0
    N: float = 0.0
    timoshenko: bool = False
    ends: tuple = ("clamped", "free")

    def _coefficients(self, x, omega2):
        """1/EI, s, alpha, beta, mu as series about x."""
        lines = []
        for a, b in self.dimensions:
            slope = (mpf(b) - mpf(a)) / mpf(self.length)
            lines.append([mpf(a) + slope * x, slope] + [mpf(0)] * (TERMS - 2))
        nu, E, rho, N = (mpf(str(v)) for v in (self.nu, self.E, self.rho, self.N))
        area, second, shear = self.section(nu, *lines)
        s, alpha, rotary = constant(0), constant(1), constant(0)
        if self.timoshenko:  # Haringx
            s = over(constant(2 * (1 + nu) / E), shear)
            alpha = plus(constant(1), scaled(N, s))
            rotary = scaled(rho * omega2, second)
        beta = plus(scaled(N, alpha), rotary)
        return over(constant(1 / E), second), s, alpha, beta, scaled(rho * omega2, area)

    def _steps(self):
        """Places at which series are made: a dimension changes by a tenth of itself at most."""
        x, L = mpf(0), mpf(self.length)
        while x < L:
            h = L / 8
            for a, b in self.dimensions:
                here, slope = mpf(a) + (mpf(b) - mpf(a)) / L * x, abs(mpf(b) - mpf(a)) / L
                if slope:
                    h = min(h, here / slope / 5)
            h = min(h, L - x)
            yield x, h
            x += h

    def determinant(self, omega2):
        """Zero at an eigenvalue."""
        starts = {"clamped": (2, 3), "free": (0, 1), "pinned": (1, 3)}
        wanted = {"clamped": (0, 1), "free": (2, 3), "pinned": (0, 2)}
        states = [[mpf(i == k) for i in range(4)] for k in starts[self.ends[0]]]
        for x, h in self._steps():
            columns = self._coefficients(x, omega2)
            states = [self._across(columns, z, h) for z in states]
        (a, b), (c, d) = ([z[i] for i in wanted[self.ends[1]]] for z in states)
        return a * d - b * c

    @staticmethod
    def _across(columns, start, h):
        f, s, alpha, beta, mu = columns
        Y, psi, M, Q = ([v] for v in start)
        for n in range(TERMS - 1):

            def at(a, z, n=n):
                return sum(a[k] * z[n - k] for k in range(n + 1))

            rates = (
                at(alpha, psi) - at(s, Q),
                at(f, M),
                at(alpha, Q) - at(beta, psi),
                at(mu, Y),
            )
            for z, rate in zip((Y, psi, M, Q), rates, strict=True):
                z.append(rate / (n + 1))
        return [sum(c * h**k for k, c in enumerate(z)) for z in (Y, psi, M, Q)]

    def omega2(self, guess):
        """The eigenvalue nearest a guess that is good to some digits."""
        with mp.workdps(DIGITS):
            a, b = mpf(guess), mpf(guess) * (1 + mpf(10) ** -9)
            Da, Db = self.determinant(a), self.determinant(b)
            for _ in range(3):
                a, b, Da = b, b - Db * (b - a) / (Db - Da), Db
                Db = self.determinant(b)
            return b
