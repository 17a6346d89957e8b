"""Results as tables of pandas, and the loads of a case as a file.

The unit of every column stands in ``attrs["units"]``, and in its name where a mix-up is costly.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.beam.checks import TABLES
from antinode.extras import import_extra
from antinode.inputs.reading import COLUMN_UNITS
from antinode.modes.dataset import SCALARS
from antinode.modes.solve import beam_of
from antinode.show.loads_table import internal_forces, loads_csv, loads_dataset, loads_dict
from antinode.show.writing import write_result
from antinode.vehicle.statics import static_shape

if TYPE_CHECKING:
    import pandas

    from antinode.beam.beam import Beam
    from antinode.modes.result import ModalResult
    from antinode.modes.solve import HasBeam
    from antinode.stability.result import Stability
    from antinode.vehicle.case import Case
    from antinode.vehicle.loads import Loads

_LOADS = {"x": "m", "N": "N", "Q": "N", "M": "N m", "M_bent": "N m", "u_Y": "m", "u_X": "m"}


def frame(columns: dict[str, Any], units: dict[str, str]) -> pandas.DataFrame:
    """Return columns as a DataFrame that knows their units.

    Raises
    ------
    InputError
        If pandas is not installed.
    """
    table: pandas.DataFrame = import_extra("pandas", "dataset").DataFrame(columns)
    table.attrs["units"] = {name: unit for name, unit in units.items() if name in table}
    return table


def beam_frame(problem: Beam | HasBeam) -> pandas.DataFrame:
    """Return a beam as its stations, as `Beam` takes them: two rows at one x where one jumps.

    Returns
    -------
    DataFrame
        x and the columns that are given, SI: ``Beam(**table, interpolation=...)`` is the beam,
        without what is attached. Polynomials inside intervals, as tapered sections have them, are
        not in it: they stand by their ends.
    """
    beam = beam_of(problem)
    given = {n: t for n in TABLES if (t := getattr(beam, n)) is not None}
    if beam.interpolation == "step" and not beam.is_curved and _stepped(given):
        rows = {n: np.append(t[:, 0], t[-1, 0]) for n, t in given.items()}
        return frame({"x": beam.x, **rows}, COLUMN_UNITS)
    x = np.repeat(beam.x, 2)[1:-1]
    rows = {n: t[:, [0, -1]].ravel() for n, t in given.items()}
    again = np.append(False, x[1:] == x[:-1])
    for values in rows.values():
        again &= np.append(False, values[1:] == values[:-1])
    kept = {name: values[~again] for name, values in {"x": x, **rows}.items()}
    return frame(kept, COLUMN_UNITS)


def _stepped(tables: dict[str, Any]) -> bool:
    """Tell whether nothing runs inside intervals: N may, beside steps of the rest."""
    return all(np.array_equal(table[:, 0], table[:, -1]) for table in tables.values())


def modes_frame(result: ModalResult) -> pandas.DataFrame:
    """Return modes as a table, one row a mode, by their names."""
    columns: dict[str, Any] = {
        name: [getattr(mode, name) for mode in result.modes]
        for name in ("family", "number", "name", "kind")
    }
    for name, _, _ in SCALARS:
        values = (getattr(mode, name) for mode in result.modes)
        columns[name] = [np.nan if value is None else float(value) for value in values]
    table = frame(columns, {name: unit for name, unit, _ in SCALARS})
    return table.set_index("name")


def stability_frame(result: Stability) -> pandas.DataFrame:
    """Return the changes of stability as a table, one row each, by rising factor."""
    rows = [each.to_dict() for each in result.critical]
    names = ("kind", "load_factor", "error", "frequency_hz", "frequency_error_hz", "change")
    columns: dict[str, Any] = {name: [row[name] for row in rows] for name in names}
    columns["modes"] = [", ".join(each.modes) for each in result.critical]
    columns["proven"] = [each.proven for each in result.critical]
    return frame(columns, {"frequency_hz": "Hz", "frequency_error_hz": "Hz"})


def along_frame(result: Any) -> pandas.DataFrame:
    """Return the changes of stability along an input as a table, one row each."""
    rows = [each.to_dict() for each in result.critical]
    columns: dict[str, Any] = {
        name: [row[name] for row in rows] for name in ("kind", "value", "frequency_hz", "change")
    }
    for k, name in enumerate(("low", "high")):
        columns[name] = [each.bracket[k] for each in result.critical]
    columns["modes"] = [", ".join(each.modes) for each in result.critical]
    columns["proven"] = [each.proven for each in result.critical]
    unit = result.line.unit
    return frame(columns, {"value": unit, "low": unit, "high": unit, "frequency_hz": "Hz"})


def loads_frame(loads: Loads, points: int = 201) -> pandas.DataFrame:
    """Return N, Q and M along the straight body; two rows where N or Q jumps.

    Parameters
    ----------
    loads : Loads
    points : int
        Number of evenly spaced positions, beside the breakpoints.
    """
    x = np.unique(np.concatenate([np.linspace(0, loads.length, points), loads.breakpoints]))
    sides = [(loads.axial_force(x, side), loads.shear_force(x, side)) for side in ("left", "right")]
    (N0, Q0), (N1, Q1) = sides
    keep = np.ones(2 * len(x), dtype=bool)
    keep[1::2] = (N0 != N1) | (Q0 != Q1)
    pairs = {
        "x": (x, x),
        "N": (N0, N1),
        "Q": (Q0, Q1),
        "M": (loads.bending_moment(x),) * 2,
    }
    rows = {name: np.stack(pair, axis=1).ravel()[keep] for name, pair in pairs.items()}
    return frame(rows, _LOADS)


def case_frame(case: Case, points: int = 201) -> pandas.DataFrame:
    """Return N, Q, M and the static deflection along the body, as `antinode loads` writes them.

    Parameters
    ----------
    case : Case
    points : int
        Number of evenly spaced positions, beside the breakpoints.
    """
    table = internal_forces(case, static_shape(case), points)
    return frame({name: table[name] for name in _LOADS}, _LOADS)


def response_frame(result: Any) -> pandas.DataFrame:
    """Return a response as a table: frequency or time, then the columns of each output."""
    columns = dict(result.columns())
    units = {name: name.rpartition("[")[2].rstrip("]") for name in columns if "[" in name}
    return frame(columns, units)


def save_loads(case: Case, path: str | Path) -> None:
    """Write the loads of a case, with N, Q, M and the static deflection, by the ending.

    Parameters
    ----------
    case : Case
    path : str or Path
        .json (all that is known), .csv or .nc (along the body).

    Raises
    ------
    InputError
        If the ending is another, or the file cannot be written.
    """
    shape = static_shape(case)
    write_result(
        Path(path),
        loads_dict(case, shape),
        lambda: loads_csv(case, shape),
        lambda: loads_dataset(case, shape),
    )
