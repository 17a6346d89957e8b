"""What a beam may carry at a station: masses, springs, pedestals, joints, dashpots, feedback."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arguments import numbers
from antinode.arrays import Array
from antinode.errors import InputError


class _Given:
    """What may be given as texts with units: ``PointMass(x="3 ft", mass="20 kg")``."""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if type(value) is not float and type(value) is not int:
                object.__setattr__(self, name, _number(type(self), name, value))


@dataclass(frozen=True)
class PointMass(_Given):
    """A rigid mass fixed to the beam.

    Parameters
    ----------
    x : float
        Station [m].
    mass : float
        [kg], positive.
    rotary_inertia : float
        About its own centre, across the beam [kg m^2].
    offset : float
        Of its centre along +x from the station [m].
    polar_inertia : float
        About the axis of the beam [kg m^2].
    """

    x: float
    mass: float
    rotary_inertia: float = 0.0
    offset: float = 0.0
    polar_inertia: float = 0.0


@dataclass(frozen=True)
class Spring(_Given):
    """Springs between the beam and the ground; infinite ones are supports.

    Parameters
    ----------
    x : float
        Station [m].
    translational, axial : float
        [N/m], zero or positive; `math.inf` holds Y, or X, at zero.
    rotational, torsional : float
        [N m/rad]; `math.inf` holds the slope, or the rotation about the axis, at zero.
    coupling : float
        K_xtheta [N], of either sign: the lateral force of a unit slope, and the moment of a unit
        displacement; not beside an infinite stiffness.
    """

    x: float
    translational: float = 0.0
    rotational: float = 0.0
    axial: float = 0.0
    torsional: float = 0.0
    coupling: float = 0.0


@dataclass(frozen=True)
class Pedestal(_Given):
    """A mass between two springs: beam, spring, mass, spring, ground; it moves sideways alone.

    Without a spring to the ground it hangs on the beam: an absorber. Neither weight nor springs of
    it act along the axis, and it does not turn.

    Parameters
    ----------
    x : float
        Station [m].
    mass : float
        [kg], positive.
    beam_stiffness : float
        Of the spring between beam and mass [N/m], positive.
    ground_stiffness : float
        Of the spring between mass and ground [N/m], zero or positive.
    """

    x: float
    mass: float
    beam_stiffness: float
    ground_stiffness: float = 0.0

    @property
    def static_stiffness(self) -> float:
        """Of both springs in line [N/m]: what the beam feels at rest."""
        k1, k2 = self.beam_stiffness, self.ground_stiffness
        return k1 * (k2 / (k1 + k2)) if k2 else 0.0

    @property
    def own_omega2(self) -> float:
        """omega^2 of the mass while the beam stands still [rad^2/s^2]."""
        return (self.beam_stiffness + self.ground_stiffness) / self.mass


@dataclass(frozen=True)
class Joint(_Given):
    """An elastic joint in line with the beam.

    Parameters
    ----------
    x : float
        Station inside the span [m].
    rotational : float
        Compliance [rad/(N m)]: slope on the right less slope on the left, over the moment.
    axial : float
        Compliance [m/N].
    torsional : float
        Compliance [rad/(N m)]: rotation on the right less that on the left, over the torque.
    """

    x: float
    rotational: float = 0.0
    axial: float = 0.0
    torsional: float = 0.0


@dataclass(frozen=True)
class Dashpot(_Given):
    """Dampers between the beam and the ground; undamped modes know nothing of them.

    Parameters
    ----------
    x : float
        Station [m].
    translational, axial : float
        Force over velocity [N s/m], zero or positive.
    rotational, torsional : float
        Moment over angular velocity [N m s/rad].
    """

    x: float
    translational: float = 0.0
    rotational: float = 0.0
    axial: float = 0.0
    torsional: float = 0.0


@dataclass(frozen=True)
class PointFeedback:
    """A force and a moment at a station that oppose the motion there: not of springs alone.

    With the displacement Y and the turn psi of the section, and their rates, the beam feels::

        force  = -(translational Y + force_of_turn psi)
                 - (translational_damping Y' + force_of_turn_rate psi')
        moment = -(moment_of_displacement Y + rotational psi)
                 - (moment_of_velocity Y' + rotational_damping psi')

    Where `force_of_turn` differs from `moment_of_displacement` no energy stands behind it, and it
    may drive the beam: linearised forces of a fluid, a control. Any number may have either sign.

    Parameters
    ----------
    x : float
        Station [m].
    translational, translational_damping : float
        [N/m], [N s/m].
    force_of_turn, moment_of_displacement : float
        [N] (per rad), [N m/m].
    force_of_turn_rate, moment_of_velocity : float
        [N s] (per rad), [N m s/m].
    rotational, rotational_damping : float
        [N m/rad], [N m s/rad].
    """

    x: float
    translational: float = 0.0
    force_of_turn: float = 0.0
    moment_of_displacement: float = 0.0
    rotational: float = 0.0
    translational_damping: float = 0.0
    force_of_turn_rate: float = 0.0
    moment_of_velocity: float = 0.0
    rotational_damping: float = 0.0

    @classmethod
    def of(
        cls, x: float, stiffness: npt.ArrayLike, damping: npt.ArrayLike = ((0, 0), (0, 0))
    ) -> PointFeedback:
        """Return it by its matrices: ``(force, moment) = -K (Y, psi) - C (Y', psi')``.

        Parameters
        ----------
        x : float
            Station [m].
        stiffness, damping : array_like, shape (2, 2)
            K [N/m, N; N, N m] and C [N s/m, N s; N s, N m s].
        """
        K, C = numbers("stiffness", stiffness), numbers("damping", damping)
        for name, matrix in (("stiffness", K), ("damping", C)):
            if matrix.shape != (2, 2):
                raise InputError(
                    f"the point feedback at x = {x:g} m: {name} has the shape {matrix.shape}; "
                    "(2, 2) is wanted: rows force and moment, columns Y and psi"
                )
        return cls(x, *K.ravel().tolist(), *C.ravel().tolist())

    @property
    def stiffness(self) -> Array:
        """K, shape (2, 2): rows force and moment, columns Y and psi."""
        rows = (self.translational, self.force_of_turn)
        return np.array([rows, (self.moment_of_displacement, self.rotational)])

    @property
    def damping(self) -> Array:
        """C, shape (2, 2)."""
        rows = (self.translational_damping, self.force_of_turn_rate)
        return np.array([rows, (self.moment_of_velocity, self.rotational_damping)])

    @property
    def gives_energy(self) -> bool:
        """Whether its damping gives energy to some motion."""
        (a, b), (c, d) = self.damping.tolist()
        return bool(a < 0 or d < 0 or 4 * a * d < (b + c) ** 2)


Attachment = PointMass | Spring | Pedestal | Joint | Dashpot | PointFeedback


def _number(kind: type, name: str, value: Any) -> Any:
    """Return a number in SI from what was given; what is none is left to `check_kinds`."""
    from antinode.inputs.given import in_si, written_unit

    unit = "m" if name == "x" else written_unit(_UNITS[kind][name])
    number = in_si(f"{name} of a {_NAMES[kind]}", value, unit)
    return float(number) if np.ndim(number) == 0 and np.isreal(number) else value


def name_of(item: Attachment) -> str:
    """Return what an attachment is: a point mass, a spring, a support or a joint."""
    if isinstance(item, Spring) and math.inf in (getattr(item, name) for name in _UNITS[Spring]):
        return "support"
    return _NAMES[type(item)]


_UNITS: dict[type, dict[str, str]] = {
    PointMass: {"mass": "kg", "rotary_inertia": "kg_m2", "offset": "m", "polar_inertia": "kg_m2"},
    Spring: {
        "translational": "N_per_m",
        "rotational": "N_m_per_rad",
        "axial": "N_per_m",
        "torsional": "N_m_per_rad",
        "coupling": "N",
    },
    Pedestal: {
        "mass": "kg",
        "beam_stiffness": "N_per_m",
        "ground_stiffness": "N_per_m",
    },
    Joint: {"rotational": "rad_per_N_m", "axial": "m_per_N", "torsional": "rad_per_N_m"},
    Dashpot: {
        "translational": "N_s_per_m",
        "rotational": "N_m_s_per_rad",
        "axial": "N_s_per_m",
        "torsional": "N_m_s_per_rad",
    },
    PointFeedback: {
        "translational": "N_per_m",
        "force_of_turn": "N",
        "moment_of_displacement": "N",
        "rotational": "N_m_per_rad",
        "translational_damping": "N_s_per_m",
        "force_of_turn_rate": "N_s",
        "moment_of_velocity": "N_s",
        "rotational_damping": "N_m_s_per_rad",
    },
}


def name_of_kind(kind: type) -> str:
    """Return what a kind of attachment is called."""
    return _NAMES[kind]


def attachment_dict(item: Attachment) -> dict[str, Any]:
    """Return an attachment as plain numbers for JSON, units in the keys.

    An infinite stiffness is null, and named under ``holds``.
    """
    values = {name: getattr(item, name) for name in _UNITS[type(item)]}
    plain = {
        f"{name}_{_UNITS[type(item)][name]}": None if value == math.inf else value
        for name, value in values.items()
    }
    held = [name for name, value in values.items() if value == math.inf]
    more = {"holds": held} if isinstance(item, Spring) else {}
    return {"kind": name_of(item), "x_m": item.x, **plain, **more}


_NAMES = {
    PointMass: "point mass",
    Spring: "spring",
    Pedestal: "pedestal",
    Joint: "joint",
    Dashpot: "dashpot",
    PointFeedback: "point feedback",
}
