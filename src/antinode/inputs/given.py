"""What Python callers give where a number or a column is wanted: in SI, whatever it was.

A plain number is SI, as in files. A text carries its unit (``"3 ft"``); so may each row of a
column, a column of pandas or xarray by ``attrs["units"]``, and a quantity of pint.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from antinode.errors import InputError
from antinode.text import short

from .units import to_si, unit_factor


def in_si(name: str, values: Any, unit: str) -> Any:
    """Return what was given as numbers in an SI unit, or as it is where no unit stands in it.

    Parameters
    ----------
    name : str
        Of the argument, for messages.
    values : float, str, array_like, Series, DataArray or Quantity
    unit : str
        The SI unit, such as ``"N m^2"``; ``""`` of a pure number.

    Raises
    ------
    InputError
        If a text is no number with a unit of that kind, or an attribute names no such unit.
    """
    try:
        if hasattr(values, "magnitude") and hasattr(values, "to"):
            return np.asarray(values.to(unit or "dimensionless").magnitude, dtype=float)
        if isinstance(values, str):
            return to_si(values, unit)
        return _column_in_si(values, unit)
    except InputError:
        raise
    except Exception as error:  # pint's errors share no base with others
        raise InputError(
            f"{name} is {short(values)}: {error}; a plain number is in {unit or '1'}"
        ) from error


def written_unit(key: str) -> str:
    """Return a unit as texts have it from how it stands in a key: ``N_m_per_rad``, ``kg_m2``."""
    above, _, below = key.replace("m2", "m^2").replace("_", " ").partition(" per ")
    if not below:
        return above
    return f"{above}/({below})" if " " in below else f"{above}/{below}"


def _column_in_si(values: Any, unit: str) -> Any:
    """Return a column with its texts as numbers; what has no unit is left to others as it is."""
    array, factor = np.asarray(values), _factor_of(values, unit)
    if array.dtype.kind not in "OUT":
        return values if factor == 1.0 else array * factor
    rows = np.array(values, dtype=object)
    for place, item in np.ndenumerate(rows):
        if isinstance(item, str):
            try:
                rows[place] = to_si(item, unit)
            except ValueError as error:
                where = ", ".join(str(k + 1) for k in place)
                raise ValueError(f"row {where} is '{item[:40]}'; {error}") from error
        elif factor != 1.0:
            rows[place] = item * factor
    return rows


def _factor_of(values: Any, unit: str) -> float:
    """Return the factor of a column whose attributes name a unit; 1 without."""
    attributes = getattr(values, "attrs", None)
    written = attributes.get("units") if isinstance(attributes, Mapping) else None
    if isinstance(written, Mapping):  # of a whole DataFrame, by its columns
        written = written.get(getattr(values, "name", None))
    return 1.0 if written in (None, "", "1") else unit_factor(str(written), unit)
