"""What a modal solution is: named modes with certificates, errors and shapes; immutable."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from antinode.arguments import ByValue, choice, numbers
from antinode.arrays import Array, Complex
from antinode.beam.attachments import Pedestal, attachment_dict
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FamilyName
from antinode.errors import InputError
from antinode.methods import ModeMethods, ModesMethods
from antinode.riccati.chain import Chain
from antinode.riccati.shapes import moved_masses, propagate
from antinode.text import counted
from antinode.version import __version__

from .dataset import modal_dataset
from .hertz import error_hz, error_of_root, growth_rate, hertz

if TYPE_CHECKING:
    import xarray

Kind = Literal["rigid", "elastic", "divergent", "flutter", "overdamped"]
Method = Literal["riccati", "tmm"]
Normalisation = Literal["amplitude", "mass"]
Damping = Literal["auto", "none", "complex"]

_STEERING = "control of the thrust's direction"
NOT_MODELLED = (
    "shear deformation and rotary inertia (their effect is estimated, with kGA = EA/4.9 of a "
    "thin-walled tube where none is given: kappa = 0.53)",
    "added mass of wetted parts",
    "damping",
    "shell modes of the wall",
    _STEERING,
)
"""What the model of Euler and Bernoulli leaves out; Timoshenko's all but the first."""


def not_modelled(beam: Beam, damped: bool = False) -> tuple[str, ...]:
    """Return what the model of a beam leaves out; `damped` where its modes are complex."""
    first = 1 if beam.has_shear else 0
    solved = {"damping"} if damped else set()
    solved |= {_STEERING} if beam.is_unloaded else set()
    rigid_in_shear = beam.is_timoshenko and not beam.has_shear
    return beam.left_out + tuple(
        words.replace("and rotary inertia (their", "(its") if rigid_in_shear else words
        for words in NOT_MODELLED[first:]
        if (beam.added_mass_per_length is None or not words.startswith("added mass"))
        and words not in solved
    )


@dataclass(frozen=True, eq=False, repr=False)
class Mode(ModeMethods, ByValue):
    """One natural mode with its certificate.

    Attributes
    ----------
    family : {"bending", "longitudinal", "torsion"}
    number : int
        1, 2, ... in order of omega^2; 0 for a rigid mode.
    name : str
        ``"bending 1"``, ``"rigid rotation"``, ...
    kind : {"rigid", "elastic", "divergent", "flutter", "overdamped"}
        Divergent where omega^2 < 0: the motion grows instead of vibrating. Flutter where it grows
        while it oscillates, as it may where end forces follow; its twin that decays is elastic.
        Overdamped where it decays without vibrating: s is real and negative.
    omega2 : float
        [rad^2/s^2]; of an oscillation that grows or decays the square of its circular frequency.
    bracket_omega2 : tuple of float
        Encloses the eigenvalue of the segment chain, rounding included [rad^2/s^2].
    counts : tuple of int
        How many eigenvalues lie below either end of the bracket, or -1 where nothing is certified.
    error_omega2 : float
        Distance to the eigenvalue of the beam as given [rad^2/s^2]: that to the bracket's end,
        which is certain, and the estimated error of representing what varies by uniform segments.
        NaN where the method certifies nothing.
    modal_mass : float
        Integral of m Y^2 for the shape as normalised [kg m^2 / m^2]; of rho I_p phi^2 in torsion
        [kg m^2].
    residual : float
        Relative difference of the Rayleigh quotient of the shape from omega2.
    model_error : float or None
        Estimated relative effect of shear and rotary inertia on the frequency (negative: they
        lower it; -1: past buckling with shear), with kGA = EA/4.9 where none is given, that of a
        thin-walled tube; None where they are solved, where the beam does not tell, and for rigid
        modes.
    effect_of_shear : float or None
        What they do to the frequency where they are solved: f/f_EB - 1, at the same axial force.
        None in Euler-Bernoulli's theory, for rigid modes, and past buckling.
    growth : float
        Rate at which an oscillation grows, or decays where negative [1/s]; 0 where it does neither.
    unloaded_omega2 : float or None
        omega^2 of the same mode without axial force, where it was asked for.
    states : array, shape (points, 4) or (points, 2)
        Along `ModalResult.x`: Y, theta, M, Q_y, or X, Q_x, or phi, T; of a complex mode at the
        instant when its largest displacement is.
    eigenvalue : complex or None
        s [1/s] of a complex mode, Im s >= 0; None where modes are real or end forces alone follow.
    error_per_s : float or None
        Distance of s to that of the beam as given [1/s].
    phasors : array of complex or None
        States of a complex mode: amplitude and phase of the motion ``Re(phasors exp(s t))``.
    left : array of complex or None
        Its left eigenvector w along `ModalResult.x`, with ``w^T (2 s M + C) v = 1``: small changes
        of the matrices move s by ``-w^T (s^2 dM + s dC + dK) v``.
    """

    family: FamilyName
    number: int
    name: str
    kind: Kind
    omega2: float
    bracket_omega2: tuple[float, float]
    counts: tuple[int, int]
    error_omega2: float
    modal_mass: float
    residual: float
    model_error: float | None
    states: Array = field(repr=False)
    unloaded_omega2: float | None = None
    growth: float = 0.0
    effect_of_shear: float | None = None
    eigenvalue: complex | None = None
    error_per_s: float | None = None
    phasors: Complex | None = field(default=None, repr=False)
    left: Complex | None = field(default=None, repr=False)

    @property
    def by_shear(self) -> float | None:
        """What shear and rotary inertia do to the frequency: solved, estimated, or one of each."""
        solved, estimated = self.effect_of_shear, self.model_error
        if solved is None or estimated is None:
            return estimated if solved is None else solved
        return (1 + solved) * (1 + estimated) - 1  # rotary inertia alone is solved

    @property
    def eigenvalue_per_s(self) -> complex:
        """S of the motion ``exp(s t)``, the one of its pair that has Im s >= 0 [1/s]."""
        if self.eigenvalue is not None:
            return self.eigenvalue
        if self.omega2 < 0:
            return complex(math.sqrt(-self.omega2), 0.0)
        return complex(self.growth, math.sqrt(self.omega2))

    @property
    def damping_ratio(self) -> float:
        """-Re s/abs(s): negative where the motion grows, NaN for s = 0."""
        s = self.eigenvalue_per_s
        return -s.real / abs(s) + 0.0 if s else math.nan

    @property
    def frequency_hz(self) -> float:
        """Natural frequency [Hz]; NaN for omega^2 < 0."""
        return hertz(self.omega2)

    @property
    def growth_rate_per_s(self) -> float:
        """Rate at which the motion grows or decays [1/s]; NaN where it only oscillates."""
        if self.eigenvalue is not None:
            return self.eigenvalue.real
        return self.growth or growth_rate(self.omega2)

    @property
    def bracket_hz(self) -> tuple[float, float]:
        """The bracket in frequency [Hz]; NaN where omega^2 < 0, from 0 where it encloses zero."""
        low, high = self.bracket_omega2
        return hertz(max(low, 0.0) if high > 0 else low), hertz(high)

    @property
    def error_hz(self) -> float:
        """Half-width of the interval of frequency that holds the beam's own [Hz]."""
        if self.error_per_s is not None and self.omega2 >= 0:
            return self.error_per_s / (2 * math.pi)
        return error_hz(self.omega2, self.error_omega2)

    @property
    def error_growth_rate_per_s(self) -> float:
        """The same for the growth rate [1/s]."""
        if self.error_per_s is not None:
            return self.error_per_s
        if self.growth:
            return self.error_omega2 / (2 * abs(self.eigenvalue_per_s))
        return error_of_root(-self.omega2, self.error_omega2) if self.omega2 < 0 else math.nan

    @property
    def shift(self) -> float:
        """Relative change of the frequency by the axial force; NaN if unknown or not elastic."""
        if self.unloaded_omega2 is None or self.kind != "elastic" or self.unloaded_omega2 <= 0:
            return math.nan
        return math.sqrt(self.omega2 / self.unloaded_omega2) - 1

    @property
    def shape(self) -> Array:
        """Displacement Y, X or phi along `ModalResult.x`, shape (points,)."""
        return np.asarray(self.states[:, 0])


@dataclass(frozen=True, eq=False)
class Solution:
    """The modes of one family along the chain that was solved: exact between its nodes.

    Attributes
    ----------
    chain : Chain
        Uniform segments, from x = 0.
    omega2 : array, shape (k,)
        [rad^2/s^2], of the modes in their order; complex, as are the states, where one flutters.
    states : array, shape (n + 1, k, s)
        At the nodes, SI, as normalised.
    """

    chain: Chain
    omega2: Array
    states: Array = field(repr=False)

    def at(self, x: Array) -> Array:
        """Return the states at positions from the left end [m], shape (points, k, s)."""
        nodes = self.chain.nodes
        segment = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, len(nodes) - 2)
        start = self.states[segment]
        return propagate(self.chain, start, self.omega2, x - nodes[segment], segment)


@dataclass(frozen=True, eq=False, repr=False)
class ModalResult(ModesMethods, ByValue):
    """The modes of a beam, in order of family and omega^2.

    Attributes
    ----------
    beam : Beam
    modes : tuple of Mode
    x : array, shape (points,)
        Where the shapes are given [m].
    method, tolerance, normalisation
        As asked for.
    segments : dict
        Number of uniform segments that represent the beam, by family.
    solutions : dict
        The `Solution` of each family, which `at` evaluates.
    certificate : dict
        What proves that no bending mode is missing and none too many: ``{"kind": "counts"}``; where
        end forces follow "winding", with the region and the record of the proof; "none" where
        nothing is proven.
    noted : tuple of str
        What was noticed before the modes were known, by the file or the solver: among `warnings`.
    """

    beam: Beam
    modes: tuple[Mode, ...]
    x: Array = field(repr=False)
    method: Method
    tolerance: float
    normalisation: Normalisation
    segments: dict[str, int]
    solutions: dict[FamilyName, Solution] = field(repr=False, compare=False)
    noted: tuple[str, ...]
    certificate: Mapping[str, Any] = field(default_factory=lambda: {"kind": "counts"})

    def __str__(self) -> str:
        lines = [f"{self.beam.name}: {counted(len(self.modes), 'mode')}"]
        for mode in self.modes:
            value = (
                f"{mode.frequency_hz:12.6g} Hz{_plus_minus(mode.error_hz)}"
                if mode.omega2 >= 0
                else f"grows at {mode.growth_rate_per_s:.6g} 1/s"
            )
            lines.append(f"  {mode.name:<20} {mode.kind:<10} {value}")
        return "\n".join([*lines, *(f"  warning: {w}" for w in self.warnings)])

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """What a user should know before trusting the numbers, and what to do about it."""
        return (*self.noted, *self._own_warnings())

    @property
    def follows(self) -> bool:
        """Whether a force of the beam turns with its end: bending is then not self-adjoint."""
        return any(self.beam.following())

    @property
    def is_complex(self) -> bool:
        """Whether modes are complex: of dashpots, feedback, or loss."""
        return any(mode.eigenvalue is not None for mode in self.modes)

    @property
    def families(self) -> tuple[FamilyName, ...]:
        """The families that were solved."""
        return tuple(self.solutions)

    def family(self, family: FamilyName) -> tuple[Mode, ...]:
        """Return the modes of one family; none if it was not solved."""
        choice("the family", family, FamilyName)
        return tuple(mode for mode in self.modes if mode.family == family)

    def mode(self, family: FamilyName, number: int) -> Mode:
        """Return an elastic or divergent mode by its family and number."""
        for mode in self.modes:
            if (mode.family, mode.number) == (family, number):
                return mode
        have = ", ".join(m.name for m in self.modes if m.number)
        raise InputError(f"there is no mode {family} {number} in this result; it has {have}")

    def at(self, x: npt.ArrayLike, family: FamilyName = BENDING) -> Array:
        """Evaluate the modes of a family anywhere along the beam.

        Parameters
        ----------
        x : array_like, shape (points,)
            Positions [m] on the beam.
        family : {"bending", "longitudinal", "torsion"}

        Returns
        -------
        array, shape (points, modes, 4) or (points, modes, 2)
            The components of `FAMILIES` for every mode of the family, exact for the chain.
        """
        self._check_solved(family)
        points = np.atleast_1d(numbers("x", x)) - self.beam.x[0]
        if np.any((points < 0) | (points > self.beam.length * (1 + 1e-12))):
            low, high = self.beam.x[0], self.beam.x[-1]
            raise InputError(f"x must lie on the beam, from {low:g} to {high:g} m")
        return self.solutions[family].at(points)

    def frequencies_hz(self, family: FamilyName = BENDING) -> Array:
        """Return the frequencies of modes 1, 2, ... of a family [Hz], NaN where divergent."""
        self._check_solved(family)
        return np.array([m.frequency_hz for m in self.family(family) if m.number])

    def _check_solved(self, family: str) -> None:
        if family not in self.solutions:
            have = ", ".join(map(repr, self.solutions))
            raise InputError(f"there are no {family} modes in this result; it has {have}")

    @cached_property
    def pedestal_motion(self) -> Array:
        """How far the masses of pedestals move in bending modes, shape (pedestals, modes).

        By station, in the unit of the shapes; beside a beam that hardly moves it may be large.
        """
        own = self.solutions.get(BENDING)
        moved = {} if own is None else moved_masses(own.chain, own.states, own.omega2)
        if not moved:
            return np.zeros((0, len(self.family(BENDING))))
        return np.array([moved[node] for node in sorted(moved)])

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers for JSON, without the shapes."""
        return {
            "schema_version": 1,
            "name": self.beam.name,
            "attachments": [attachment_dict(item) for item in self.beam.attachments],
            "modes": [_mode_dict(mode, self.follows) for mode in self.modes],
            **self._pedestals(),
            "certificate": dict(self.certificate),
            "method": self.method,
            "tolerance": self.tolerance,
            "segments": dict(self.segments),
            "warnings": list(self.warnings),
            **_theory(self.beam),
            "not_modelled": list(not_modelled(self.beam, self.is_complex)),
        }

    def _pedestals(self) -> dict[str, Any]:
        """Return where pedestals stand, and how far their masses move in each bending mode."""
        moved = self.pedestal_motion
        if not moved.size or np.iscomplexobj(moved):
            return {}
        places = sorted(i.x for i in self.beam.attachments if isinstance(i, Pedestal))
        rows = zip(places, moved.tolist(), strict=True)
        names = [mode.name for mode in self.family(BENDING)]
        return {
            "pedestals": [
                {"x_m": x, "displacement": dict(zip(names, map(null, row), strict=True))}
                for x, row in rows
            ]
        }

    def to_dataset(self) -> xarray.Dataset:
        """Return the result as a labelled xarray Dataset with units in every variable's attrs."""
        attributes = {
            "title": f"Natural modes of {self.beam.name}",
            "source": f"antinode {__version__}",
            "method": self.method,
            "tolerance": self.tolerance,
            "normalisation": self.normalisation,
            "warnings": "\n".join(self.warnings),
        }
        return modal_dataset(self.modes, self.x, self.families, attributes)


def _theory(beam: Beam) -> dict[str, str]:
    """Return which theory is solved, and how the axial force and shear meet in it."""
    if not beam.is_timoshenko:
        return {"theory": "euler_bernoulli"}
    return {"theory": "timoshenko", "shear_form": beam.shear_form}


def _plus_minus(error: float) -> str:
    return "" if math.isnan(error) else f" +- {error:.1e}"


def _mode_dict(mode: Mode, follows: bool) -> dict[str, Any]:
    s = mode.eigenvalue_per_s
    of_pair: dict[str, Any] = {
        "eigenvalue_per_s": [s.real, s.imag],
        "damping_ratio": null(mode.damping_ratio),
        "growth_rate_per_s": s.real,
    }
    if mode.error_per_s is not None:
        of_pair["error_per_s"] = null(mode.error_per_s)
    return _plain_dict(mode) | (of_pair if follows or mode.eigenvalue is not None else {})


def _plain_dict(mode: Mode) -> dict[str, Any]:
    return {
        "family": mode.family,
        "number": mode.number,
        "name": mode.name,
        "kind": mode.kind,
        "frequency_hz": null(mode.frequency_hz),
        "error_hz": null(mode.error_hz),
        "bracket_hz": [null(v) for v in mode.bracket_hz],
        "omega2": mode.omega2,
        "bracket_omega2": list(mode.bracket_omega2),
        "counts": list(mode.counts),
        "error_omega2": null(mode.error_omega2),
        "growth_rate_per_s": null(mode.growth_rate_per_s),
        "error_growth_rate_per_s": null(mode.error_growth_rate_per_s),
        "unloaded_frequency_hz": null(hertz(mode.unloaded_omega2))
        if mode.unloaded_omega2 is not None
        else None,
        "shift": null(mode.shift),
        "model_error": mode.model_error,
        "effect_of_shear": mode.effect_of_shear,
        "modal_mass": null(mode.modal_mass),
        "residual": null(mode.residual),
    }


def null(value: float) -> float | None:
    """Return None for NaN, as JSON wants it."""
    return None if math.isnan(value) else value
