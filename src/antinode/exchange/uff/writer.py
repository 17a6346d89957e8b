"""Modes as a universal file: units (164), nodes (15), trace line (82), modes (55).

Lengths are m, frequencies Hz; a shape has six values a node, X, Y, the rotation
about x and the slope about z. The format
keeps six digits. A dataset 55 has no place for a divergent mode: those are left out.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FAMILIES
from antinode.modes.result import ModalResult, Mode


def write_uff(path: Path, result: ModalResult) -> tuple[str, ...]:
    """Write the modes of a beam.

    Parameters
    ----------
    path : Path
    result : ModalResult

    Returns
    -------
    tuple of str
        What the file leaves out.
    """
    path.write_text(uff_text(result), encoding="ascii", errors="replace")
    left = [mode.name for mode in result.modes if mode.omega2 < 0]
    notes = ["modes alone: the properties of the beam are left out"]
    if left:
        notes.append(f"divergent, and left out: {', '.join(left)}")
    return tuple(notes)


def uff_text(result: ModalResult) -> str:
    """Return the file as text."""
    kept = np.append([True], np.diff(result.x) > 0)
    x = result.x[kept]
    parts = [
        _dataset(164, _units()),
        _dataset(15, (_node(k, s) for k, s in enumerate(x, 1))),
        _dataset(82, _trace(len(x))),
    ]
    modes = [mode for mode in result.modes if mode.omega2 >= 0]
    for number, mode in enumerate(modes, 1):
        parts.append(_dataset(55, _mode(result, mode, number, kept)))
    return "".join(parts)


def _dataset(number: int, lines: Iterable[str]) -> str:
    return "\n".join(["    -1", f"{number:6d}", *lines, "    -1"]) + "\n"


def _line(text: str) -> str:
    """Return a record of 80 printable characters."""
    return "".join(c if c.isprintable() else " " for c in text)[:80] or "NONE"


def _units() -> Iterable[str]:
    yield f"{1:10d}{'SI: m, N, K':<20}{1:10d}"
    yield "".join(f"{factor:25.17E}" for factor in (1.0, 1.0, 1.0)).replace("E", "D")
    yield f"{273.15:25.17E}".replace("E", "D")


def _node(number: int, x: float) -> str:
    return f"{number:10d}{0:10d}{0:10d}{8:10d}{x:13.5E}{0.0:13.5E}{0.0:13.5E}"


def _trace(count: int) -> Iterable[str]:
    yield f"{1:10d}{count:10d}{8:10d}"
    yield _line("beam")
    for first in range(1, count + 1, 8):
        yield "".join(f"{k:10d}" for k in range(first, min(first + 8, count + 1)))


def _mode(result: ModalResult, mode: Mode, number: int, kept: Array) -> Iterable[str]:
    yield _line(mode.name)
    yield _line(f"{mode.kind}, frequency {mode.frequency_hz:.9g} +- {mode.error_hz:.1e} Hz")
    yield _line(f"{mode.family} {mode.number} of {result.beam.name}")
    yield _line("SI; 6 values: X, Y, 0, rotation about x, 0, slope dY/dx")
    yield "NONE"
    yield "".join(f"{value:10d}" for value in (1, 2, 3, 8, 2, 6))
    yield "".join(f"{value:10d}" for value in (2, 4, 1, number))
    yield "".join(f"{v:13.5E}" for v in (mode.frequency_hz, mode.modal_mass, 0.0, 0.0))
    freedoms = FAMILIES[mode.family].freedoms
    for node, row in enumerate(mode.states[kept], 1):
        six = np.zeros(6)
        six[list(freedoms)] = row[: len(freedoms)]
        yield f"{node:10d}"
        yield "".join(f"{value:13.5E}" for value in six)
