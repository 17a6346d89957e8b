"""The families of modes: for each law, what of a beam it reads, and how its results are called.

This table and the laws themselves are the only places that name a law; everything else - chains,
files, tables, figures - asks the table. A family more is one entry here and one law below.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from antinode.riccati import laws
from antinode.riccati.laws import Law

if TYPE_CHECKING:
    from .beam import Beam

FamilyName = laws.LawName
BENDING: FamilyName = "bending"
LONGITUDINAL: FamilyName = "longitudinal"
TORSION: FamilyName = "torsion"


class Quantity(NamedTuple):
    """A component of the state as it is shown."""

    symbol: str
    unit: str
    text: str


@dataclass(frozen=True)
class Family:
    """One family of modes.

    Attributes
    ----------
    law : Law
    columns : dict
        The beam's table for each column of the law.
    symbol : str
        Of the stiffness, with its unit.
    ends : tuple of str
        Fields of `Ends` for the left and right end.
    default_end : dict or None
        The family's end where none is given, by the lateral one; None where it is the lateral one.
    inertia, springs, joint : str or tuple of str
        Fields of `PointMass`, `Spring` (one for each displacement) and `Joint` that act in it.
    rotary : bool
        Whether a mass off its station, and its rotary inertia, act in it.
    rigid : tuple of str
        What its rigid modes do: moving without, and with, a turn where it has both.
    quantities : tuple of Quantity
        The components of its states (equation 56).
    more : tuple of str
        The beam's tables for what the law may have besides its columns.
    freedoms : tuple of int
        Of the displacements, among three translations along x, y, z and three rotations about them.
    directions : tuple of str
        Names of forces along the displacements.
    """

    law: Law
    columns: Mapping[str, str]
    symbol: str
    ends: tuple[str, str]
    default_end: Mapping[str, str] | None
    inertia: str
    springs: tuple[str, ...]
    joint: str
    rotary: bool
    rigid: tuple[str, ...]
    quantities: tuple[Quantity, ...]
    freedoms: tuple[int, ...]
    directions: tuple[str, ...]
    more: tuple[str, ...] = ()

    @property
    def name(self) -> FamilyName:
        """The law's name."""
        return self.law.name

    @property
    def stiffness(self) -> str:
        """The beam's table of stiffness."""
        return self.columns["stiffness"]

    @cached_property
    def tables(self) -> tuple[str, ...]:
        """The beam's tables that it must read."""
        return tuple(self.columns.values())

    def used(self, beam: Beam) -> tuple[str, ...]:
        """Return the tables of a beam that it reads besides: those that are given, and count."""
        given = [name for name in self.more if getattr(beam, name) is not None]
        if not beam.is_timoshenko:
            given = [name for name in given if name not in TIMOSHENKO]
        elif "rotary_inertia_per_length" in given and "radius_of_gyration" in given:
            given.remove("radius_of_gyration")
        return tuple(given)

    def steep(self, beam: Beam) -> tuple[str, ...]:
        """Return those of them whose ratio over a step counts, as it does for any stiffness."""
        return tuple(name for name in self.used(beam) if name in ("shear_stiffness",))

    def holding(self, beam: Beam) -> tuple[str, ...]:
        """Return the tables of a beam that hold it where they are not zero."""
        return tuple(name for name in self.used(beam) if name == "foundation_stiffness")


TIMOSHENKO = "shear_stiffness", "rotary_inertia_per_length", "radius_of_gyration"
"""Tables that Euler-Bernoulli's theory leaves out."""


_AXIAL_END = {"clamped": "fixed", "pinned": "fixed", "free": "free", "sliding": "free"}
_TORSION_END = {"clamped": "fixed", "pinned": "free", "free": "free", "sliding": "free"}

FAMILIES: Mapping[FamilyName, Family] = {
    BENDING: Family(
        law=laws.BENDING,
        columns={
            "mass": "mass_per_length",
            "stiffness": "bending_stiffness",
            "axial_force": "axial_force",
        },
        symbol="EI [N m^2]",
        ends=("left", "right"),
        default_end=None,
        inertia="mass",
        springs=("translational", "rotational"),
        joint="rotational",
        rotary=True,
        rigid=("translation", "rotation"),
        quantities=(
            Quantity("Y", "m", "lateral displacement"),
            Quantity("theta", "rad", "slope"),
            Quantity("M", "N m", "bending moment EI Y''"),
            Quantity("Q_y", "N", "lateral force M' + N Y'"),
        ),
        freedoms=(1, 5),
        more=(*TIMOSHENKO, "foundation_stiffness", "added_mass_per_length", "tangential_load"),
        directions=("lateral", "moment"),
    ),
    LONGITUDINAL: Family(
        law=laws.BAR,
        columns={"mass": "mass_per_length", "stiffness": "axial_stiffness"},
        symbol="EA [N]",
        ends=("left_axial", "right_axial"),
        default_end=_AXIAL_END,
        inertia="mass",
        springs=("axial",),
        joint="axial",
        rotary=False,
        rigid=("axial translation",),
        quantities=(
            Quantity("X", "m", "axial displacement"),
            Quantity("Q_x", "N", "compressive force -EA X'"),
        ),
        freedoms=(0,),
        directions=("axial",),
    ),
    TORSION: Family(
        law=laws.SHAFT,
        columns={"mass": "polar_inertia_per_length", "stiffness": "torsional_stiffness"},
        symbol="GJ [N m^2]",
        ends=("left_torsion", "right_torsion"),
        default_end=_TORSION_END,
        inertia="polar_inertia",
        springs=("torsional",),
        joint="torsional",
        rotary=False,
        rigid=("axial rotation",),
        quantities=(
            Quantity("phi", "rad", "rotation about the axis"),
            Quantity("T", "N m", "torque GJ phi'"),
        ),
        freedoms=(3,),
        directions=("torsional",),
    ),
}


def tells(beam: object, family: FamilyName) -> bool:
    """Tell whether a beam has all tables that a family reads."""
    return all(getattr(beam, table) is not None for table in FAMILIES[family].tables)
