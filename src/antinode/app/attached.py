"""What a beam carries, as entries of its file: added with sensible numbers, and taken out.

Pure: a state gives the changes that add or remove an entry.
"""

from __future__ import annotations

import math
from typing import Any

from antinode.beam.file import BeamFile
from antinode.errors import InputError

from .state import State, with_changes

KINDS = {
    "mass": "point_masses",
    "spring": "springs",
    "support": "springs",
    "pedestal": "pedestals",
    "joint": "joints",
    "dashpot": "dashpots",
    "axial force": "loads.point_forces",
}
"""What can be added, and the table of the file that it goes into."""
_MOST = 200


def entries(state: State, table: str) -> list[dict[str, Any]]:
    """Return the entries of a table of a beam file, with all changes."""
    node: Any = with_changes(state.file.tables, state.changes).get("beam", {})
    for key in table.split("."):
        node = node.get(key, {}) if isinstance(node, dict) else {}
    return [dict(entry) for entry in node] if isinstance(node, list | tuple) else []


def attached(state: State) -> dict[str, str]:
    """Return what is attached: path of each entry, and its name."""
    names = {table: kind for kind, table in reversed(KINDS.items())}
    return {
        f"beam.{table}.{k}": f"{'support' if _holds(entry) else name} {k + 1}"
        for table, name in names.items()
        for k, entry in enumerate(entries(state, table))
    }


def _holds(entry: dict[str, Any]) -> bool:
    """Tell whether an entry is a support: a spring that nothing moves."""
    return any(entry.get(key) in (math.inf, "inf") for key in ("translational", "rotational"))


def places(state: State) -> list[float]:
    """Return where something is attached [m]."""
    table = state.problem.table if isinstance(state.problem, BeamFile) else None
    if table is None:
        return []
    attached = (
        *(table.point_masses, table.springs, table.pedestals),
        *(table.joints, table.dashpots),
    )
    found = [entry.x for kind in attached for entry in kind]
    return found + [force.x for force in (table.loads.point_forces if table.loads else ())]


def added(state: State, kind: str) -> tuple[dict[str, Any], str]:
    """Return the changes that add an entry where there is most room, and its number's path.

    Raises
    ------
    InputError
        If there are too many, or the beam has no middle.
    """
    table = KINDS[kind]
    present = entries(state, table)
    if len(present) >= _MOST:
        raise InputError(f"{len(present)} entries of {table} are there; write more into the file")
    entry, number = _entry(state, kind)
    path = f"beam.{table}"
    return {path: [*present, entry]}, f"{path}.{len(present)}.{number}"


def removed(state: State, path: str) -> dict[str, Any]:
    """Return the changes that take an entry out."""
    table, _, number = path.removeprefix("beam.").rpartition(".")
    present = entries(state, table)
    return {f"beam.{table}": [entry for k, entry in enumerate(present) if k != int(number)]}


def _entry(state: State, kind: str) -> tuple[dict[str, Any], str]:
    """Return an entry whose number does something to the first modes, and its key."""
    beam = state.beam
    L = beam.length
    EI = float(beam.bending_stiffness.mean())
    taken = sorted({float(beam.x[0]), float(beam.x[-1]), *places(state)})
    wide = max(range(len(taken) - 1), key=lambda k: taken[k + 1] - taken[k])
    middle = float(f"{(taken[wide] + taken[wide + 1]) / 2:.6g}")
    sizes = {
        "mass": ("mass", beam.mass / 10),
        "spring": ("translational", 10 * EI / L**3),
        "support": ("translational", float("inf")),
        "joint": ("rotational", L / EI / 10),
        "pedestal": ("beam_stiffness", 30 * EI / L**3),
        "dashpot": ("translational", (EI * beam.mass / L**3) ** 0.5 / 10),
        "axial force": ("force", -EI / L**2),
    }
    key, size = sizes[kind]
    more = {"mass": float(f"{beam.mass / 20:.2g}")} if kind == "pedestal" else {}
    return {"x": middle, **more, key: float(f"{size:.2g}")}, key
