"""Numbers that hardly any beam has: a unit was likely missed.

A bar carries sound at ``c = sqrt(EA/m)``, whatever its section; its section has the radius
``r = sqrt(EI/EA)``. Both are taken as means over the length, of mass and of compliance, in which
neither a rigid piece nor one without mass of its own counts.

Sources: sqrt(E/rho) of beryllium 12.9 km/s, steel and aluminium 5.1, lead 1.2, soft rubber some
0.03 (CRC Handbook of Chemistry and Physics, speed of sound in solids, extensional waves in rods).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array

from .attachments import Spring, gather, pushing_springs
from .beam import Beam
from .families import BENDING, LONGITUDINAL
from .profile import Profile, interpolated

FASTEST, SLOWEST = 14e3, 20.0
"""Of waves along a bar, sqrt(EA/m) [m/s]: above beryllium's, and below that of soft rubber."""
STOUTEST, SLENDEREST = 0.5, 1e-4
"""Radius of gyration sqrt(EI/EA) over the length: half of it; and that of a wire, which hangs."""

WIDEST = 25.0
"""Width of a section on a drawing [m]: beyond the feet of the widest towers of one tube."""
MOST_STRAIN = 0.1
"""abs(N)/EA beyond which a beam is hardly one: metals yield below 0.01."""
_GRAVITY_MM = 9806.65  # mm/s^2

_MEANT = "if it is meant so, ignore this"


def doubts(beam: Beam) -> list[str]:
    """Return where the numbers of a beam are not of this world, a sentence each.

    Parameters
    ----------
    beam : Beam

    Returns
    -------
    list of str
        Empty for any usual structure.
    """
    per_length = beam.mass / beam.length
    own = replace(beam, attachments=()).mass / beam.length if beam.attachments else per_length
    pulled = [
        *_wide_sections(beam),
        *_weight_from_clamp(beam),
        *_gravity_in_mm(beam),
        *_springs_that_push(beam),
    ]
    EI = 1 / _mean_compliance(beam, "bending_stiffness")
    if beam.axial_stiffness is None:
        alone = _bending_alone(beam, math.sqrt(EI / per_length), math.sqrt(EI / own))
        return [*pulled, *alone]
    EA = 1 / _mean_compliance(beam, "axial_stiffness")
    speeds = list(_wave_speed(float(np.sqrt(EA / per_length)), float(np.sqrt(EA / own))))
    speeds += [] if speeds else _strain(beam)
    return [*pulled, *speeds, *_slenderness(beam, float(np.sqrt(EI / EA)))]


def _mean_compliance(beam: Beam, name: str) -> float:
    h, table = np.diff(beam.x), getattr(beam, name)
    middle = beam.column_at(name, np.s_[:], np.full(len(h), 0.5))
    return float(_mean_of_inverse(h, table[:, 0], middle, table[:, -1]))


def mean_compliance(stiffness: Profile) -> Array:
    """Return the means of 1/stiffness over the length, by Simpson's rule on each interval."""
    a, b = stiffness.ends[..., 0], stiffness.ends[..., 1]
    middle = interpolated(a, b, 0.5, stiffness.interpolation)
    return _mean_of_inverse(np.diff(stiffness.x), a, middle, b)


def _mean_of_inverse(h: Array, a: Array, middle: Array, b: Array) -> Array:
    return np.asarray(((1 / a + 4 / middle + 1 / b) / 6) @ h / np.sum(h))


OF_MANY = (
    f"a wave runs along the body faster than in any material, sqrt(EA/m) above {FASTEST:g} m/s "
    "(steel 5,100 m/s): check the units of axial_stiffness [N] and mass_per_length [kg/m, not the "
    f"kg of each piece]; {_MEANT}",
    f"a wave runs along the body slower than in soft rubber, sqrt(EA/m) below {SLOWEST:g} m/s "
    "(steel 5,100 m/s): check the units of axial_stiffness [N, not kN or MN] and mass_per_length "
    f"[kg/m]; {_MEANT}",
    f"the section's radius of gyration sqrt(EI/EA) is more than {STOUTEST:g} of the length, so "
    "this is no beam: check the units of bending_stiffness [N m^2], axial_stiffness [N] and x [m]",
    f"the axial force strains the beam by N/EA > {MOST_STRAIN:.0%}, which hardly any material "
    "bears (metals yield below 1%): check the units of axial_force [N] and axial_stiffness [N]; "
    f"{_MEANT}",
)
"""What is doubted of many bodies without attachments, in the order of `doubts_of_many`."""


def doubts_of_many(
    mass: Array, EI: Profile, EA: Profile, strained: npt.NDArray[np.bool_]
) -> npt.NDArray[np.bool_]:
    """Tell which of many bodies have numbers that are not of this world, shape (4, bodies).

    Parameters
    ----------
    mass : array, shape (bodies,)
        Of each [kg].
    EI, EA : Profile
        Of each, or of them all.
    strained : array of bool, shape (bodies,)
        Which are strained by more than `MOST_STRAIN`.
    """
    length = float(EA.x[-1] - EA.x[0])
    bending, axial = 1 / mean_compliance(EI), 1 / mean_compliance(EA)
    speed, r = np.sqrt(axial * length / mass), np.sqrt(bending / axial)
    fast, slow = speed > FASTEST, speed < SLOWEST
    told = fast, slow, r > STOUTEST * length, strained & ~(fast | slow)
    return np.stack(np.broadcast_arrays(*told))


def _wave_speed(loaded: float, bare: float) -> Iterator[str]:
    """Doubt sqrt(EA/m), with point masses and without."""
    if loaded > FASTEST:
        thousand = SLOWEST < loaded / 1e3 < FASTEST
        system = ", as numbers in mm, N and t give it in mm/s" if thousand else ""
        yield (
            f"a wave runs along this beam at sqrt(EA/m) = {loaded:.3g} m/s, faster than in any "
            f"material (steel 5,100 m/s, beryllium 12,900){system}: check the units of "
            "axial_stiffness [N] and mass_per_length [kg/m, not the kg of each piece]; " + _MEANT
        )
    elif bare < SLOWEST:
        yield (
            f"a wave runs along this beam at sqrt(EA/m) = {bare:.3g} m/s, slower than in soft "
            "rubber (steel 5,100 m/s): check the units of axial_stiffness [N, not kN or MN] and "
            "mass_per_length [kg/m]; " + _MEANT
        )


def largest_strain(beam: Beam) -> tuple[float, float, float]:
    """Return abs(N)/EA where it is largest, N there [N], and x [m]; of a beam that has EA."""
    k = np.arange(len(beam.x) - 1)
    ends = [np.full(len(k), t) for t in (0.0, 1.0)]
    N = np.array([beam.axial_force_at(k, t) for t in ends])
    strain = np.abs(N) / np.array([beam.column_at("axial_stiffness", k, t) for t in ends])
    side, row = np.unravel_index(np.argmax(strain), strain.shape)
    return float(strain[side, row]), float(N[side, row]), float(beam.x[row + side])


def _strain(beam: Beam) -> Iterator[str]:
    """Doubt what the axial force does to the length."""
    strain, N, x = largest_strain(beam)
    if strain > MOST_STRAIN:
        yield (
            f"the axial force of {N:.4g} N at x = {x:g} m strains the "
            f"beam by N/EA = {strain:.0%}, which hardly any material bears (metals "
            "yield below 1%): check the units of axial_force [N] and axial_stiffness [N]; " + _MEANT
        )


def _gravity_in_mm(beam: Beam) -> Iterator[str]:
    """Doubt an axial acceleration that is gravity's in mm/s^2."""
    a = beam.axial_acceleration
    if abs(abs(a) - _GRAVITY_MM) < 0.005 * _GRAVITY_MM:
        yield (
            f"the axial acceleration of {a:.6g} m/s^2 is that of gravity in mm/s^2: gravity is "
            "9.80665 [m/s^2]; " + _MEANT
        )


def _slenderness(beam: Beam, r: float) -> Iterator[str]:
    """Doubt sqrt(EI/EA) against the length."""
    section = f"the section's radius of gyration sqrt(EI/EA) = {r:.3g} m"
    if r > STOUTEST * beam.length:
        thousand = r / 1e3 < STOUTEST * beam.length
        system = " (bending_stiffness in N mm^2 gives such a radius)" if thousand else ""
        yield (
            f"{section} is no small part of the length of {beam.length:.4g} m, so this is no "
            f"beam{system}: check the units of bending_stiffness [N m^2], axial_stiffness [N] and "
            "x [m]"
        )
    elif r < SLENDEREST * beam.length and _is_bare(beam):
        yield (
            f"{section} is {r / beam.length:.1e} of the length of {beam.length:.4g} m, a wire that "
            "nothing holds straight: check the units of x [m, not mm], bending_stiffness [N m^2] "
            "and axial_stiffness [N]; " + _MEANT
        )


def _bending_alone(beam: Beam, loaded: float, bare: float) -> Iterator[str]:
    """Doubt sqrt(EI/m) = r c against the length, where no EA tells the two apart."""
    check = "check the units of bending_stiffness [N m^2], mass_per_length [kg/m] and x [m]"
    if loaded > FASTEST * STOUTEST * beam.length:
        yield (
            f"sqrt(EI/m) = {loaded:.3g} m^2/s is more than a beam of {beam.length:.4g} m can have "
            f"in any material (a steel tube one m wide: 1,800 m^2/s): {check}; " + _MEANT
        )
    elif bare < SLOWEST * SLENDEREST * beam.length and _is_bare(beam):
        yield (
            f"sqrt(EI/m) = {bare:.3g} m^2/s is less than a beam of {beam.length:.4g} m can have in "
            f"any material (a steel wire one mm thick: 1.3 m^2/s): {check}; " + _MEANT
        )


def _wide_sections(beam: Beam) -> Iterator[str]:
    """Doubt sections of a drawing that are wider than what is built: mm without a unit."""
    sizes = beam.drawing.dimensions if beam.drawing is not None else {}
    for name in ("outer_diameter", "width", "height"):
        if name in sizes and np.max(sizes[name]) > WIDEST:
            yield (
                f"{name} is up to {np.max(sizes[name]):.4g} m: wider than {WIDEST:g} m hardly any "
                f"beam is; numbers without a unit are metres: write '40 mm', or {name} [mm] in the "
                f"heading of a table; {_MEANT}"
            )


def _weight_from_clamp(beam: Beam) -> Iterator[str]:
    """Doubt a weight that pulls a cantilever away from its clamp: a mast stands, gravity points."""
    left, right = beam.ends.of(LONGITUDINAL)
    sprung = any(isinstance(item, Spring) and item.axial for item in beam.attachments)
    if sprung or (left, right) == ("fixed", "fixed"):
        return
    a, x = beam.axial_acceleration, beam.x
    if (left == "fixed" and beam.ends.left == "clamped" and a > 0) or (
        right == "fixed" and beam.ends.right == "clamped" and a < 0
    ):
        sign, place = ("+", x[0]) if a > 0 else ("-", x[-1])
        yield (
            f"the weight of {abs(a):.5g} m/s^2 along {sign}x pulls away from the clamped end at x "
            f"= {place:g} m: the beam hangs from it, and the tension stiffens it; a mast that "
            f"stands on this end has gravity = {-a:.5g}; if it hangs, ignore this"
        )


def pushed_at(beam: Beam) -> list[float]:
    """Return the stations of springs that no passive support has [m]."""
    if not beam.attachments:
        return []
    points = gather(beam.attachments, beam.x, BENDING, 0.0).values()
    return [float(beam.x[point.node]) for point in points if pushing_springs(point)]


def _springs_that_push(beam: Beam) -> Iterator[str]:
    for x in pushed_at(beam):
        yield (
            f"the springs at x = {x:g} m have K_xtheta^2 above K_x K_theta: they push the beam "
            "away and feed it energy, which no soil or pile head does: check the coupling [N] "
            "against translational [N/m] times rotational [N m/rad]"
        )


def _is_bare(beam: Beam) -> bool:
    """Tell whether nothing along the beam holds it, neither a tension nor a support."""
    return beam.is_unloaded and not beam.attachments
