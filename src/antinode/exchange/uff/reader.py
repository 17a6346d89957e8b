"""Measured modes (dataset 55) and frequency responses (58) of a universal file as observations.

The nodes (15 or 2411) give the line of the beam, which follows an axis of the file. A mode that
moves mostly along it is longitudinal, one that only turns about it is torsion; bending is taken
across it in one plane. Frequency responses become frequencies by `frf.find_modes`: one row each,
with a standard deviation of its own.
"""

from __future__ import annotations

import math
import os
import tempfile
import warnings
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Complex
from antinode.beam.families import BENDING, LONGITUDINAL, TORSION
from antinode.errors import InputError
from antinode.exchange.units import SI, System
from antinode.extras import import_extra
from antinode.inputs.reading import read_bytes
from antinode.text import counted

from .frf import Peak, find_modes

Row = dict[str, Any]
MOST_BYTES = 200_000_000
TYPES = (15, 55, 58, 164, 2411)
"""Datasets that are read; others are passed over."""
_FRF = 4  # function type of a dataset 58
_ORDERS = {8: 0, 11: 1, 12: 2}  # times i omega: displacement, velocity, acceleration
_MOST_MODES = 500


@dataclass(frozen=True)
class Geometry:
    """Where the nodes are.

    Attributes
    ----------
    x : dict
        Along the beam [m], by node; empty where the file does not tell.
    axis, lateral : int
        Components 0, 1, 2 along the beam, and across it in the plane of bending.
    """

    x: Mapping[int, float]
    axis: int
    lateral: int


def read_measurements(
    path: Path, system: System = SI, plane: int = 1
) -> tuple[list[Row], tuple[str, ...]]:
    """Read measured modes, or frequency responses.

    Parameters
    ----------
    path : Path
    system : System
        Units of lengths, where the file does not say them (dataset 164).
    plane : {1, 2}
        Across the beam: the axis after its own one (y for a beam along x), or the one after that.

    Returns
    -------
    list of dict
        Rows of observations, as an identification file has them.
    tuple of str
        What was left out or assumed.

    Raises
    ------
    InputError
        If the file cannot be read, or has neither modes nor frequency responses.
    """
    sets = _sets(path)
    geometry, notes = _geometry(sets, system, plane)
    try:
        rows, more = _rows(sets, geometry, path)
    except InputError:
        raise
    except (KeyError, TypeError, ValueError, IndexError, ArithmeticError) as error:
        raise _unreadable(path, error) from error
    return rows, (*notes, *more)


def _rows(sets: Sequence[Row], geometry: Geometry, path: Path) -> tuple[list[Row], tuple[str, ...]]:
    modes = [s for s in sets if s["type"] == 55 and s.get("analysis_type") in (2, 3, 7)]
    responses = [s for s in sets if s["type"] == 58 and s.get("func_type") == _FRF]
    if modes:
        return _mode_rows(modes, geometry, path)
    if responses:
        return _response_rows(responses, geometry, path)
    raise InputError(
        f"{path}: there are neither modes (dataset 55) nor frequency responses (58, function type "
        "4) in it; export them"
    )


def _sets(path: Path) -> list[Row]:
    """Return the datasets that matter, as pyuff reads them."""
    content = read_bytes(path, MOST_BYTES, "a universal file")
    pyuff = import_extra("pyuff", "exchange")
    handle, copy = tempfile.mkstemp(suffix=".uff")  # pyuff wants a name, and keeps no ending
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            uff = pyuff.UFF(copy)
            types = np.atleast_1d(uff.get_set_types()).tolist()
            if not types:
                raise ValueError("no datasets between lines of -1")
            wanted = [k for k, number in enumerate(types) if number in TYPES]
            return [uff.read_sets(k) for k in wanted]
    except Exception as error:  # pyuff raises Exception itself
        raise _unreadable(path, error) from error
    finally:
        os.unlink(copy)


def _unreadable(path: Path, error: Exception) -> InputError:
    return InputError(
        f"{path}: this is no readable universal file ({type(error).__name__}); the file may be cut "
        "off: export it again"
    )


# --- geometry --------------------------------------------------------------------------------


def _geometry(sets: Sequence[Row], system: System, plane: int) -> tuple[Geometry, tuple[str, ...]]:
    at: dict[int, Array] = {}
    for data in sets:
        if data["type"] in (15, 2411):
            columns = (data.get(key, ()) for key in ("node_nums", "x", "y", "z"))
            for node, *place in zip(*columns, strict=False):
                at[int(node)] = np.array(place, dtype=float)
    places = np.array(list(at.values())).reshape(-1, 3)
    if len(places) < 2 or not np.all(np.isfinite(places)):
        return Geometry({}, 0, plane), (
            "there are no nodes (dataset 15 or 2411): every mode is taken for bending, without its "
            "shape",
        )
    spread = np.ptp(places, axis=0)
    axis = int(np.argmax(spread))
    lateral = (axis + plane) % 3
    if np.sort(spread)[1] > 0.2 * spread[axis]:
        return Geometry({}, axis, lateral), (
            "the nodes lie on no line along an axis of the file: shapes are left out",
        )
    factors = [s["length"] for s in sets if s["type"] == 164 and s.get("length")]
    factor = float(factors[0]) if factors else system.length
    names = "xyz"
    note = f"the beam runs along {names[axis]}, bending is read along {names[lateral]} (--plane)"
    return Geometry({n: float(p[axis]) / factor for n, p in at.items()}, axis, lateral), (note,)


# --- modes -----------------------------------------------------------------------------------


def _mode_rows(
    modes: Sequence[Row], geometry: Geometry, path: Path
) -> tuple[list[Row], tuple[str, ...]]:
    """Return one row with the modes of the file, by family and frequency."""
    found: dict[str, list[tuple[float, Row | None]]] = {}
    left = Counter[str]()
    for data in modes:
        hz = _frequency(data)
        if not hz > 0:
            left["without frequency (rigid)"] += 1
            continue
        if str(data.get("id2", "")).startswith("rigid,"):  # as antinode writes it
            left["of a rigid body"] += 1
            continue
        family, nodes, shape = _shape(data, geometry)
        if family:
            found.setdefault(family, []).append((hz, _shape_row(family, nodes, shape, geometry)))
        else:
            left["across the other plane"] += 1
    if not found:
        raise InputError(f"{path}: none of its modes can be used; try --plane 2")
    row: Row = {"name": path.stem[:80]}
    for family, entries in found.items():
        entries = sorted(entries, key=lambda entry: entry[0])[:_MOST_MODES]
        row[family] = [hz for hz, _ in entries]
        for number, (_, shape_row) in enumerate(entries, 1):
            if shape_row:
                row.setdefault("shapes", []).append({**shape_row, "number": number})
    notes = tuple(f"{counted(n, 'mode')} {why} left out" for why, n in left.items())
    return [row], (*notes, "a dataset 55 states no uncertainty: give sd or relative_sd")


def _frequency(data: Row) -> float:
    """Return the frequency of a mode [Hz], of a complex one |lambda| / 2 pi."""
    hz = float(data["freq"]) if "freq" in data else abs(complex(data["eig"])) / (2 * math.pi)
    return hz if math.isfinite(hz) else 0.0


def _shape(data: Row, geometry: Geometry) -> tuple[str, list[int], Array]:
    """Return the family of a mode, its nodes, and its displacements along its own direction."""
    parts = [_real(np.asarray(data[key])) for key in ("r1", "r2", "r3")]
    nodes = [int(n) for n in data["node_nums"]]
    size = [float(np.sum(part**2)) for part in parts]
    if not geometry.x:
        return BENDING, nodes, np.zeros(0)
    across = 3 - geometry.axis - geometry.lateral
    turn = data.get(f"r{4 + geometry.axis}")
    if not any(size) and turn is not None and np.any(turn):
        return TORSION, nodes, _real(np.asarray(turn))
    if size[geometry.axis] > size[geometry.lateral] + size[across]:
        return LONGITUDINAL, nodes, parts[geometry.axis]
    if size[geometry.lateral] < size[across] or not size[geometry.lateral] > 0:
        return "", nodes, parts[across]
    return BENDING, nodes, parts[geometry.lateral]


def _real(values: npt.NDArray[Any]) -> Array:
    """Return complex displacements, turned so that they are as real as can be."""
    z = values.astype(complex)
    turn = np.sum(z**2)
    return np.asarray((z * np.exp(-0.5j * np.angle(turn))).real if turn else z.real)


def _shape_row(family: str, nodes: Sequence[int], shape: Array, geometry: Geometry) -> Row | None:
    """Return a shape as an identification file has it, from the nodes whose place is known."""
    known = [
        (geometry.x[n], float(v)) for n, v in zip(nodes, shape, strict=False) if n in geometry.x
    ]
    known = sorted((x, v) for x, v in known if math.isfinite(v))
    if len(known) < 3 or not any(v for _, v in known):
        return None
    x, values = zip(*known, strict=True)
    return {"family": family, "x": list(x), "displacement": list(values)}


# --- frequency responses ---------------------------------------------------------------------


def _response_rows(
    responses: Sequence[Row], geometry: Geometry, path: Path
) -> tuple[list[Row], tuple[str, ...]]:
    """Return one row for each mode that the frequency responses show."""
    f = np.asarray(responses[0]["x"], dtype=float)
    for data in responses:
        x = np.asarray(data["x"], dtype=float)
        if x.shape != f.shape or not np.allclose(x, f, rtol=1e-6):
            raise InputError(
                f"{path}: its frequency responses have different lines (response node "
                f"{data.get('rsp_node')}); export them with the same ones"
            )
    used = (f > 0) & np.isfinite(f)
    H = np.stack([_receptance(data, f)[used] for data in responses], axis=1)
    if len(f[used]) < 20 or not np.all(np.diff(f[used]) > 0) or not np.all(np.isfinite(H)):
        raise InputError(f"{path}: its frequency responses have less than 20 sound lines")
    peaks = find_modes(f[used], H)
    if not peaks:
        raise InputError(f"{path}: no peak stands out of its frequency responses; check them")
    rows: list[Row] = []
    numbers = Counter[str]()
    left = 0
    for peak in peaks:
        family, shape = _residue_shape(peak, responses, geometry)
        if not family:
            left += 1
            continue
        numbers[family] += 1
        rows.append(_peak_row(peak, family, numbers[family], shape))
    note = f"{counted(left, 'mode')} across the other plane left out"
    text = counted(len(responses), "frequency response")
    return rows, (f"{counted(len(rows), 'mode')} from {text}", *([note] if left else []))


def _receptance(data: Row, f: Array) -> Complex:
    """Return a response as displacement over force; one of unknown kind is taken for that."""
    order = _ORDERS.get(int(data.get("ordinate_spec_data_type") or 0), 0)
    H = np.asarray(data["data"], dtype=complex)
    if len(H) != len(f):
        raise ValueError("as many values as lines")
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(H / (2j * np.pi * f) ** order)


def _peak_row(peak: Peak, family: str, number: int, shape: Row | None) -> Row:
    row: Row = {
        "name": f"{family} {number}, damping {peak.damping:.2g}",
        family: [math.nan] * (number - 1) + [peak.frequency_hz],
        "sd": peak.sd_hz,
    }
    return row if shape is None else {**row, "shapes": [{**shape, "number": number}]}


def _residue_shape(
    peak: Peak, responses: Sequence[Row], geometry: Geometry
) -> tuple[str, Row | None]:
    """Return the family of a mode and its shape, from the residues of one line of responses."""
    if not geometry.x:
        return BENDING, None
    moving, fixed = _roving(responses)
    common = Counter(_point(data, fixed) for data in responses).most_common(1)[0][0]
    chosen = [k for k, data in enumerate(responses) if _point(data, fixed) == common]
    residues = _real(peak.residues[chosen])
    by_axis: list[dict[int, float]] = [{}, {}, {}]
    for k, value in zip(chosen, residues, strict=True):
        node, direction = _point(responses[k], moving)
        if 1 <= abs(direction) <= 3:
            by_axis[abs(direction) - 1][node] = math.copysign(1, direction) * float(value)
    size = [sum(v * v for v in part.values()) for part in by_axis]
    across = 3 - geometry.axis - geometry.lateral
    if size[geometry.axis] > size[geometry.lateral] + size[across]:
        family, part = LONGITUDINAL, by_axis[geometry.axis]
    elif size[across] > size[geometry.lateral]:
        return "", None
    else:
        family, part = BENDING, by_axis[geometry.lateral]
    return family, _shape_row(family, list(part), np.array(list(part.values())), geometry)


def _roving(responses: Sequence[Row]) -> tuple[str, str]:
    """Return what moves along the beam, response or reference, and what stays."""
    many = {key: len({_point(data, key) for data in responses}) for key in ("rsp", "ref")}
    return ("rsp", "ref") if many["rsp"] >= many["ref"] else ("ref", "rsp")


def _point(data: Row, key: str) -> tuple[int, int]:
    return int(data.get(f"{key}_node") or 0), int(data.get(f"{key}_dir") or 0)
