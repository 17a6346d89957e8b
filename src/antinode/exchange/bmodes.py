"""Main files of BModes, `.bmi`: ends, rotor speed, the mass at the tip, and the sections' table.

A line is a value and its name; what stands behind is passed over. The beam runs from the hub's
radius, or the top of a tower's rigid base, to the radius, or height. The mass at the tip has its
centre cm_axial beyond the tip and cm_loc beside it, with moments of inertia about that centre; a
turn in the plane of cm_loc moves the centre along the beam, so that m cm_loc^2 counts there.
After BModes, `BldVib.f90`, its mass matrix of the tip (NREL).
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from antinode.errors import InputError
from antinode.inputs.reading import read_bytes
from antinode.text import short

from .sections import MOST_BYTES, read_sections

NUMBERS = (
    *("beam_type", "rot_rpm", "rpm_mult", "romg", "romg_mult", "radius", "hub_rad", "precone"),
    *("bl_thp", "hub_conn", "tip_mass", "cm_loc", "cm_axial", "ixx_tip", "iyy_tip", "izz_tip"),
    *("ixy_tip", "izx_tip", "iyz_tip", "sec_mass_mult", "flp_iner_mult", "lag_iner_mult"),
    *("flp_stff_mult", "edge_stff_mult", "tor_stff_mult", "axial_stff_mult", "tow_support"),
)
FACTORS = {
    "mass_den": "sec_mass_mult",
    "flp_iner": "flp_iner_mult",
    "edge_iner": "lag_iner_mult",
    "flp_stff": "flp_stff_mult",
    "edge_stff": "edge_stff_mult",
    "tor_stff": "tor_stff_mult",
    "axial_stff": "axial_stff_mult",
}
"""What multiplies a column of the sections."""
ENDS: dict[int, dict[str, str]] = {
    1: {"left": "clamped"},
    2: {"left": "free"},
    3: {"left": "free", "left_axial": "fixed", "left_torsion": "fixed"},
}
"""What holds the root, by hub_conn."""
TOWER = 2


def read_main_file(path: Path, plane: int) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Read a main file of BModes and the table of sections that it names.

    Parameters
    ----------
    path : Path
    plane : {1, 2}
        Flap or fore-aft, or edge or side-side.

    Returns
    -------
    dict
        The table `[beam]`.
    tuple of str
        What was left out.

    Raises
    ------
    InputError
        If a value misses or is none, or the tower stands on a platform, a monopile or wires.
    """
    text = read_bytes(path, MOST_BYTES, "a main file of BModes").decode("utf-8", errors="replace")
    values, sections = _values(text, path)
    _check(values, sections, path)
    tower = values["beam_type"] == TOWER
    if tower:  # as BModes: side-side is fore-aft
        values |= {"edge_stff_mult": values.get("flp_stff_mult", 1.0)}
        values |= {"lag_iner_mult": values.get("flp_iner_mult", 1.0)}
    factors = {column: values.get(name, 1.0) for column, name in FACTORS.items()}
    length = values["radius"] - values.get("hub_rad", 0.0)
    table, notes = read_sections(path.parent / sections, plane, length, factors)
    table |= {"name": path.stem[:200], "ends": ENDS[int(values["hub_conn"])]}
    mass, more = _tip(values, plane, in_plane=(plane == 1) == tower)
    if mass:
        table["point_masses"] = [*table.get("point_masses", []), {"x": length, **mass}]
    if not tower:
        table |= _rotation(values, plane)
        more += [f"{name} counts as 0" for name in ("precone", "bl_thp") if values.get(name)]
    return table, (*notes, *more)


def _values(text: str, path: Path) -> tuple[dict[str, float], str]:
    """Return the numbers by name, and the name of the table of sections."""
    values: dict[str, float] = {}
    sections = ""
    for number, line in enumerate(text.splitlines(), 1):
        value, names = _parted(line)
        if "sec_props_file" in names:
            sections = value
        for name in names:
            if name in NUMBERS and name not in values:
                values[name] = _number(value, f"{path}, line {number}: {name}")
    return values, sections


def _parted(line: str) -> tuple[str, list[str]]:
    """Return the value of a line, without quotes, and the two words behind it that may name it."""
    found = re.match(r"\s*(?:'([^']*)'|\"([^\"]*)\"|(\S+))(.*)", line)
    if not found:
        return "", []
    value = next(part for part in found.groups()[:3] if part is not None)
    return value, [word.strip(":,").lower() for word in found[4].replace(":", " ").split()[:2]]


def _number(word: str, where: str) -> float:
    try:
        value = float(re.sub("[dD]", "e", word))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{where} is {short(word)}; it must be a number: correct it")
    return value


def _check(values: Mapping[str, float], sections: str, path: Path) -> None:
    for name in ("beam_type", "radius", "hub_conn"):
        if name not in values:
            raise InputError(f"{path}: there is no line of {name}; is it a main file of BModes?")
    if not sections:
        raise InputError(f"{path}: there is no line of sec_props_file; name the table of sections")
    if values["beam_type"] not in (1, TOWER):
        raise InputError(f"{path}: beam_type is {values['beam_type']:g}; allowed are 1 and 2")
    if values["hub_conn"] not in ENDS:
        raise InputError(
            f"{path}: hub_conn is {values['hub_conn']:g}; allowed are 1 (clamped), 2 (free) and 3 "
            "(held along and about the axis): for other ends change it in the beam file"
        )
    if values["beam_type"] == TOWER and values.get("tow_support"):
        raise InputError(
            f"{path}: tow_support is {values['tow_support']:g}; platforms, monopiles and guy wires "
            f"are not read: convert {short(sections)} with --length, and add springs and masses"
        )
    if not values["radius"] > values.get("hub_rad", 0.0) >= 0:
        raise InputError(
            f"{path}: the beam runs from hub_rad = {values.get('hub_rad', 0.0):g} m to radius = "
            f"{values['radius']:g} m; the radius must be the larger one"
        )


def _tip(
    values: Mapping[str, float], plane: int, *, in_plane: bool
) -> tuple[dict[str, float], list[str]]:
    """Return the mass at the tip, and what is left out; in_plane where cm_loc lies in the plane."""
    mass, beside = values.get("tip_mass", 0.0), values.get("cm_loc", 0.0)
    moments = [name for name in ("ixx_tip", "iyy_tip", "izz_tip") if values.get(name)]
    if not mass:
        return {}, [f"left out, without tip_mass: {', '.join(moments)}"] if moments else []
    notes = []
    if beside and in_plane:
        notes.append(f"cm_loc = {beside:g} m counts as tip_mass cm_loc^2 in the rotary inertia")
    elif beside:
        notes.append(f"left out: cm_loc = {beside:g} m, which couples this plane with torsion")
    if any(values.get(name) for name in ("ixy_tip", "izx_tip", "iyz_tip")):
        notes.append("left out: products of inertia at the tip, which couple planes")
    about = values.get("iyy_tip" if plane == 1 else "ixx_tip", 0.0)
    return {
        "mass": mass,
        "offset": values.get("cm_axial", 0.0),
        "rotary_inertia": about + (mass * beside**2 if in_plane else 0.0),
        "polar_inertia": values.get("izz_tip", 0.0) + mass * beside**2,
    }, notes


def _rotation(values: Mapping[str, float], plane: int) -> dict[str, Any]:
    """Return the table of a blade's rotation, empty at rest."""
    rate = values.get("rot_rpm", values.get("romg", 0.0))
    rate *= values.get("rpm_mult", values.get("romg_mult", 1.0)) * math.pi / 30
    if not rate:
        return {}
    which = "out_of_plane" if plane == 1 else "in_plane"
    return {"rotation": {"rate": rate, "axis": -values.get("hub_rad", 0.0), "plane": which}}
