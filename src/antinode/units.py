"""SI floats that may be written with a unit: ``"120 kN"`` becomes ``120000.0``.

A plain number is already SI (an angle in radians). A string carries its unit; it is converted by
pint, which is imported only when a string is met. Use the annotated types in pydantic models::

    class Cavitator(Frozen):
        diameter: Annotated[Length, Field(gt=0)]
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BaseModel, ConfigDict, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import PydanticCustomError, core_schema

if TYPE_CHECKING:
    import pint


@cache
def _registry() -> pint.UnitRegistry[float]:
    import pint

    return pint.UnitRegistry()


def to_si(value: object, unit: str) -> float:
    """Convert a number or a string with a unit to a float in `unit`.

    Parameters
    ----------
    value : float or str
        ``0.08``, ``"80 mm"`` or ``"0.08"`` (a string without a unit is taken as SI).
    unit : str
        The SI unit of the result, e.g. ``"m"``, ``"N m^2"``; ``""`` for a pure number.

    Returns
    -------
    float
        The value in `unit` [unit].

    Raises
    ------
    ValueError
        If the text is not a number with a unit of the right dimension, or is not a number at all.
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise ValueError(f"needs a number, or a string with a unit such as '1 {unit}'".rstrip())
    if not isinstance(value, str):
        return float(value)
    return _parse(value, unit)


@cache
def _parse(text: str, unit: str) -> float:
    try:
        return float(text)
    except ValueError:
        pass
    if len(text) > 80:
        raise ValueError("needs a number with a unit, at most 80 characters long")
    number, _, suffix = text.strip().partition(" ")
    try:
        magnitude = float(number)
    except ValueError:
        magnitude, suffix = _split_number(text)
    return magnitude * unit_factor(suffix, unit)


def _split_number(text: str) -> tuple[float, str]:
    """Split ``"80mm"`` into ``(80.0, "mm")``."""
    text = text.strip()
    for end in range(len(text), 0, -1):
        try:
            return float(text[:end]), text[end:].strip()
        except ValueError:
            continue
    raise ValueError("needs a number first, then its unit, such as '1.5 m'")


@cache
def unit_factor(written: str, unit: str) -> float:
    """Return the factor that turns a number of `written` units into SI `unit`.

    Raises
    ------
    ValueError
        If `written` is not a unit, has an offset (degC), or has another dimension than `unit`.
    """
    if written.strip() == unit:
        return 1.0
    registry = _registry()
    try:
        quantity = registry.Quantity(1.0, registry.parse_units(written))
        factor = float(quantity.to(unit or "dimensionless").magnitude)
    except Exception as error:  # pint raises tokenizer, attribute and dimension errors of its own
        raise ValueError(f"'{written}' is no unit of {unit or 'a pure number'}") from error
    if not math.isfinite(factor) or factor <= 0:
        raise ValueError(f"'{written}' is no unit of {unit or 'a pure number'}")
    return factor


@dataclass(frozen=True)
class Unit:
    """Marks a float of a pydantic model as a quantity in an SI unit."""

    symbol: str

    def __get_pydantic_core_schema__(
        self, source: Any, handler: GetCoreSchemaHandler
    ) -> core_schema.CoreSchema:
        def convert(value: object) -> float:
            try:
                result = to_si(value, self.symbol)
            except ValueError as error:
                raise PydanticCustomError(
                    "quantity", "{reason}", {"reason": str(error), "unit": self.symbol}
                ) from error
            if math.isnan(result):
                raise PydanticCustomError(
                    "quantity", "{reason}", {"reason": "is not a number", "unit": self.symbol}
                )
            return result

        return core_schema.no_info_before_validator_function(convert, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        unit = self.symbol or "1"
        number = {**handler(schema), "description": f"SI number [{unit}]"}
        text = {"type": "string", "description": f"a number with a unit, e.g. '1 {unit}'"}
        return {"anyOf": [number, text], "unit": unit}


Length = Annotated[float, Unit("m")]
Angle = Annotated[float, Unit("rad")]
Speed = Annotated[float, Unit("m/s")]
Force = Annotated[float, Unit("N")]
Mass = Annotated[float, Unit("kg")]
Pressure = Annotated[float, Unit("Pa")]
Density = Annotated[float, Unit("kg/m^3")]
Viscosity = Annotated[float, Unit("Pa s")]
Acceleration = Annotated[float, Unit("m/s^2")]
Number = Annotated[float, Unit("")]


class Frozen(BaseModel):
    """An immutable input: unknown keys are errors, infinities and NaN are refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
