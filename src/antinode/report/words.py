"""What every report says first: equations, assumptions, signs, and what an error means."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from antinode.beam.families import BENDING, LONGITUDINAL, TORSION, FamilyName
from antinode.modes.result import NOT_MODELLED

from .blocks import Block, Equation, Section, bullets, paragraph, runs, table


class _Family(NamedTuple):
    """How a family of modes is introduced."""

    name: str
    equation: Equation
    symbols: str


_FAMILIES: Mapping[FamilyName, _Family] = {
    BENDING: _Family(
        "bending in one plane",
        Equation(runs("(EI Y'')'' + (N Y')' = ω^2 m Y"), "(E I Y'')'' + (N Y')' = omega^2 m Y"),
        "bending stiffness EI and mass per length m",
    ),
    LONGITUDINAL: _Family(
        "longitudinal vibration",
        Equation(runs("−(EA X')' = ω^2 m X"), "-(E A X')' = omega^2 m X"),
        "axial stiffness EA",
    ),
    TORSION: _Family(
        TORSION,
        Equation(runs("−(GJ φ')' = ω^2 ρI_p φ"), "-(G J phi')' = omega^2 rho I_p phi"),
        "torsional stiffness GJ and polar inertia per length ρI_p",
    ),
}

_SHEARED = _Family(
    "bending in one plane",
    Equation(
        runs("Y' = αψ − sQ, EIψ' = M, M' = αQ − (N + sN^2 + ω^2 ρI)ψ, Q' = ω^2 m Y"),
        "Y' = alpha psi - s Q, quad E I psi' = M, quad "
        "M' = alpha Q - (N + s N^2 + omega^2 rho I) psi, quad Q' = omega^2 m Y",
    ),
    "the turn ψ of the sections, bending stiffness EI, flexibility in shear s = 1/kGA (by Haringx; "
    "1/(kGA − N) by Engesser), α = 1 + sN, rotary inertia per length ρI and mass per length m",
)
_SHEARED_FAMILIES: Mapping[FamilyName, _Family] = {**_FAMILIES, BENDING: _SHEARED}
"""Bending where shear and rotary inertia are solved."""

_SIGNS = (
    ("x", "m", "along the axis from the nose or the left end", "aft, to the right"),
    ("Y, X", "m", "lateral and axial displacement", "up; aft"),
    ("φ", "rad", "rotation about the axis", "right-handed about x"),
    ("N", "N", "axial force", "compression"),
    ("Q", "N", "static shear force on the part ahead of x", "up"),
    ("M", "N m", "bending moment EI Y''", "ends bent up"),
    ("drag, lift", "N", "forces on the body", "aft; up"),
    ("thrust", "N", "at the tail", "forward"),
    ("angles", "rad", "cavitator, body, fins", "nose-up, or lifting"),
)
_BEAM_SIGNS = 6
"""Of these, how many concern any beam."""


def method_section(families: Sequence[FamilyName], *, vehicle: bool, sheared: bool) -> Section:
    """Return assumptions and conventions; `sheared` where shear and rotary inertia are solved."""
    return Section("Assumptions and conventions", tuple(_method(families, vehicle, sheared)))


def _method(families: Sequence[FamilyName], vehicle: bool, sheared: bool) -> list[Block]:
    told = [(_SHEARED_FAMILIES if sheared else _FAMILIES)[name] for name in families]
    what = "vehicle is a straight free-free" if vehicle else "structure is a straight"
    theory = "Timoshenko" if sheared else "Euler-Bernoulli"
    why = _WHY_SOLVED[vehicle] if sheared else _WHY_LEFT_OUT
    first = (
        f"The {what} {theory} beam under a static axial force N(x): {why}. "
        f"{_listed([family.name for family in told]).capitalize()} "
        f"{'are solved apart' if len(told) > 1 else 'is solved'}:"
    )
    return [
        paragraph(first),
        *(family.equation for family in told),
        paragraph(
            f"with {_listed([family.symbols for family in told])}. A prime is a derivative by x. "
            "What is assumed:"
        ),
        bullets([*(_OF_A_VEHICLE if vehicle else _OF_A_BEAM), *_ALWAYS]),
        paragraph("Not in the model: " + "; ".join(NOT_MODELLED[sheared:]) + "."),
        _sign_table(vehicle),
        paragraph(_ERROR.format(part=_SOLVED if sheared else _ESTIMATED)),
        paragraph(_NAMES),
    ]


def _listed(words: Sequence[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


_OF_A_VEHICLE = (
    "The body is rigid for the hydrodynamics: cavity and forces follow from the condition alone, "
    "by the correlations listed with their ranges below, and do not change as the body vibrates.",
    "The rigid body is in dynamic balance: thrust and drag accelerate it, and the inertia of its "
    "own mass closes N, Q and M at both ends.",
    "Static deflection, Q and M are reported; they do not change the frequencies.",
)
_OF_A_BEAM = (
    "Ends and attachments are ideal: masses are rigid, springs and joints linear, supports rigid.",
)
_ALWAYS = (
    "N is static, and the only load that changes the frequencies. What makes it keeps its "
    "direction when the beam bends; only the force at a free end may turn with the end, as the "
    "inputs say.",
    "Displacements are small and the material is linear elastic.",
)
_ERROR = (
    "What an error means. The frequencies are roots of the equations above; the number of modes "
    "below any frequency follows from the solution itself (the counts), so that none is missing. "
    "A bracket encloses the root for the beam as divided into segments, rounding included. The "
    "error adds what dividing a beam that varies has cost: the frequency of the beam as given lies "
    "within f ± error. Neither covers what the model leaves out; {part}."
)
_SOLVED = (
    "the column “shear, rot. inertia” tells what these do, each mode solved with and without them"
)
_ESTIMATED = (
    "the column “shear, rot. inertia” estimates what these would do, with kGA = EA/4.9 where none "
    "is given, that of a thin-walled tube (κ = 0.53; solid sections have 0.85 to 0.89)"
)
_WHY_SOLVED = {
    True: "[model] theory says so, and shear and rotary inertia count by the columns of the "
    "stations, or by EA as of a thin tube and by the hull",
    False: "shear and rotary inertia are given, or follow from the sections",
}
_WHY_LEFT_OUT = "shear and rotary inertia are left out, and their effect is estimated"
_NAMES = (
    "Names. Rigid modes have number 0 and are set aside by their index; the others are numbered "
    "1, 2, … in the order of ω^2, whatever its sign. A mode with ω^2 < 0 is divergent: it has no "
    "frequency, and its motion grows at the rate given, as exp(rate · t)."
)


def _sign_table(vehicle: bool) -> Block:
    rows = _SIGNS if vehicle else _SIGNS[:_BEAM_SIGNS]
    head = ("symbol", "unit", "meaning", "positive")
    return table("Signs and units.", head, rows, left=(0, 1, 3), wide=(2,))
