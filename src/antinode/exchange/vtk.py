"""Modes for ParaView: VTK XML (.vtu) with the beam as lines along x.

Every mode is a vector in the point data, (0, Y, 0) or (X, 0, 0) [m], which the filter "Warp By
Vector" bends the beam with, or a rotation (phi, 0, 0) [rad]; moments and forces are scalars beside
it. The properties of the beam are cell data.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.beam.checks import TABLES
from antinode.beam.families import FAMILIES
from antinode.inputs.reading import COLUMN_UNITS
from antinode.modes.result import ModalResult, Mode

from .beam_toml import shear_keys

LINE = 3
"""VTK's number for a cell of two points."""


def write_vtu(path: Path, result: ModalResult) -> tuple[str, ...]:
    """Write the modes of a beam as an unstructured grid of lines.

    Parameters
    ----------
    path : Path
    result : ModalResult

    Returns
    -------
    tuple of str
        What the file does not hold.
    """
    path.write_text(vtu_text(result), encoding="utf-8")
    theory = ", ".join(f"{key} = '{value}'" for key, value in shear_keys(result.beam).items())
    return (f"{theory} is left out",) if theory else ()


def vtu_text(result: ModalResult) -> str:
    """Return the file as text."""
    points = np.zeros((len(result.x), 3))
    points[:, 0] = result.x
    left = np.flatnonzero(np.diff(result.x) > 0)  # two points at one x are the sides of a joint
    cells = np.stack([left, left + 1], axis=1)
    parts = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">',
        "<Points>",
        _array("points", points),
        "</Points>",
        "<Cells>",
        _array("connectivity", cells.ravel()),
        _array("offsets", 2 * np.arange(1, len(cells) + 1)),
        _array("types", np.full(len(cells), LINE, dtype=np.uint8)),
        "</Cells>",
        "<PointData>",
        *_point_data(result),
        "</PointData>",
        "<CellData>",
        *_cell_data(result.beam, (result.x[left] + result.x[left + 1]) / 2),
        "</CellData>",
        "</Piece>",
        "</UnstructuredGrid>",
        "</VTKFile>",
    ]
    return "\n".join(parts) + "\n"


def array_name(mode: Mode) -> str:
    """Return the name of a mode's array: its name with its frequency."""
    if mode.omega2 < 0:
        return f"{mode.name}, grows at {mode.growth_rate_per_s:.6g} 1/s"
    return f"{mode.name}, {mode.frequency_hz:.6g} Hz"


def _point_data(result: ModalResult) -> Iterable[str]:
    for mode in result.modes:
        family, name = FAMILIES[mode.family], array_name(mode)
        vector = np.zeros((len(result.x), 3))
        vector[:, family.freedoms[0] % 3] = mode.shape  # a rotation about x points along x
        yield _array(f"{name} [{family.quantities[0].unit}]", vector)
        for index, (symbol, unit, _) in enumerate(family.quantities[1:], 1):
            yield _array(f"{name}: {symbol} [{unit}]", mode.states[:, index])


def _cell_data(beam: Beam, x: Array) -> Iterable[str]:
    k = np.clip(np.searchsorted(beam.x, x, side="right") - 1, 0, len(beam.x) - 2)
    t = (x - beam.x[k]) / np.diff(beam.x)[k]
    for name in TABLES:
        if name != "axial_force" and getattr(beam, name) is not None:
            yield _array(f"{name} [{COLUMN_UNITS[name] or '1'}]", beam.column_at(name, k, t))
    yield _array("axial_force [N]", beam.axial_force_at(k, t))


def _array(name: str, values: np.ndarray[Any, Any]) -> str:
    """Return an array as an element; floats with all their digits."""
    kind = {"f": "Float64", "u": "UInt8", "i": "Int64"}[values.dtype.kind]
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    body = " ".join(repr(v) for v in values.ravel().tolist())
    head = f'<DataArray type="{kind}" Name={quoteattr(name)}{components} format="ascii">'
    return f"{head}\n{body}\n</DataArray>"
