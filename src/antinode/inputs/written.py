"""Numbers and units as people write them: decimal commas, kNm², Nm^2, units glued together.

What could mean two things is refused, with both of them named.
"""

from __future__ import annotations

import re

_SPACES = "\u00a0\u202f\u2009'\u2019"
_POINT = re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:[,{_SPACES}]\d{{3}})+(?:\.\d*)?")
_WHOLE = rf"[+-]?(?:[1-9]\d{{0,2}}(?:[.{_SPACES}]\d{{3}})+|\d+)"
_COMMA = re.compile(rf"({_WHOLE}),(\d+)((?:[eE][+-]?\d+)?)")
_THOUSAND = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
_GROUPS = re.compile(r"[+-]?[1-9]\d{0,2}(?:(?:\.\d{3}){2,}|(?: \d{3})+(?:[.,]\d*)?)")
_FORTRAN = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))[dD]([+-]?\d+)")


def number(text: str) -> float:
    """Read a number: 2.5, 2,5, 1.234,5 or 1,234.5, 1 000 000, 1.0D+6.

    Raises
    ------
    ValueError
        If it is none, or could be two: 1,000 is 1 or 1000.
    """
    text = text.strip().replace("\u2212", "-")
    try:
        return float(text)
    except ValueError:
        pass
    if _THOUSAND.fullmatch(text):
        raise ValueError(
            f"{text} may be {text.replace(',', '')} or {text.replace(',', '.')}: write one of them"
        )
    if _POINT.fullmatch(text):
        return float(re.sub(f"[,{_SPACES}]", "", text))
    if _GROUPS.fullmatch(text):  # 1.000.000 or 1 000 000
        groups = text.replace(" ", "")
        return float(groups.replace(".", "") if " " not in text else groups.replace(",", "."))
    if found := _FORTRAN.fullmatch(text):
        return float(f"{found[1]}e{found[2]}")
    if found := _COMMA.fullmatch(text):
        whole = re.sub(f"[.{_SPACES}]", "", found[1])
        return float(f"{whole}.{found[2]}{found[3]}")
    raise ValueError(f"{text[:40]} is no number")


_DIGITS = rf"(?:\d[\d.,_{_SPACES}]*|\.\d+)(?:[eE][+-]?\d+)?"
_NUMBER = re.compile(rf"[+\-\u2212]?(?:{_DIGITS}|(?:inf|nan)(?![A-Za-z]))")


def split_number(text: str) -> tuple[float, str]:
    """Split ``80mm`` or ``2,5 kN`` into its number and its unit.

    Raises
    ------
    ValueError
        If it does not begin with a number.
    """
    found = _NUMBER.match(text.strip())
    if found is None:
        raise ValueError("it begins with no number")
    return number(found[0]), text.strip()[found.end() :].strip()


_SIGNS = str.maketrans(
    {**dict.fromkeys("\u00b7\u22c5\u2219\u00d7*", " "), **dict.fromkeys("°º", "deg")}
)
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"
_PLAIN = str.maketrans(_RAISED, "0123456789-")
_GLUED = re.compile(r"\b([kMGm]?N|kg|g|t)(mm|cm|m|s)(?![A-Za-z])")
_KILO = re.compile(r"\bK(?=(?:Nm?|g|m|Pa|Hz)(?![a-z]))")
_PASCAL = re.compile(r"\b([kMG])pa\b")


def tidy_unit(written: str) -> str:
    """Return a unit as pint reads it: kNm² as kN m^2, kg/m3 as kg/m^3, KN as kN.

    Raises
    ------
    ValueError
        If it means two things.
    """
    unit = re.sub(f"[{_RAISED}]+", lambda found: "^" + found[0].translate(_PLAIN), written)
    unit = unit.replace("**", "^").translate(_SIGNS)
    unit = re.sub(r"(?<=[A-Za-z\d])[.-](?=[A-Za-z])", " ", unit)  # kN-m^2, kg.m
    unit = re.sub(r"(?<=[A-Za-z])(?=-\d)", "^", unit)  # kg m-1
    unit = _KILO.sub("k", unit)
    unit = _PASCAL.sub(r"\1Pa", unit)
    unit = _GLUED.sub(r"\1 \2", re.sub(r"(?<=[A-Za-z])(?=\d)", "^", unit))
    if re.search(r"\btons?\b", unit):
        raise ValueError("a ton may be 1000 kg or 907 kg: write t for 1000 kg, or a number of kg")
    return " ".join(unit.split())
