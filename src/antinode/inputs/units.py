"""SI floats that may be written with a unit: ``"120 kN"`` becomes ``120000.0``.

A plain number is already SI (an angle in radians). A string carries its unit; it is converted by
pint, which is imported only for a unit that is not a common one. Use the annotated types in
pydantic models::

    class Cavitator(Frozen):
        diameter: Annotated[Length, Field(gt=0)]
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Annotated, Any, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    ValidationError,
)
from pydantic_core import PydanticCustomError, PydanticKnownError, core_schema

from .explain import explained
from .known_units import FACTORS
from .written import split_number, tidy_unit

if TYPE_CHECKING:
    import pint

_LONGEST = 80  # characters of a number with its unit


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
        raise ValueError(f"it needs a number{_with_unit(unit)}")
    if isinstance(value, str):
        return _parse(value, unit)
    try:
        return float(value)
    except OverflowError:
        raise ValueError("it needs a number below 1e308") from None


def _with_unit(unit: str) -> str:
    return f", or a text with a unit such as '1 {unit}'" if unit else ""


@lru_cache(maxsize=10_000)
def _parse(text: str, unit: str) -> float:
    try:
        return float(text)
    except ValueError:
        pass
    if len(text) > _LONGEST:
        raise ValueError(f"it needs a number with a unit, at most {_LONGEST} characters long")
    try:
        magnitude, suffix = split_number(text)
    except ValueError as error:
        if "may be" in str(error):
            raise
        raise ValueError(f"it needs a number{_with_unit(unit)}") from None
    return magnitude * unit_factor(suffix, unit) if suffix else magnitude


@lru_cache(maxsize=1000)
def unit_factor(written: str, unit: str) -> float:
    """Return the factor that turns a number of `written` units into SI `unit`.

    Raises
    ------
    ValueError
        If `written` is not a unit, has an offset (degC), or has another dimension than `unit`.
    """
    written = written.strip()
    known = _known_factor(written, unit)
    if known is not None:
        return known
    given, written = written, tidy_unit(written)
    known = _known_factor(written, unit)
    if known is not None:
        return known
    wrong = f"'{given}' is no unit of {unit}" if unit else "it needs a pure number, without a unit"
    if "N" in unit and re.search(r"\blbs?\b", written):
        wrong += ": lb is a mass, the force is lbf"
    if _POWER_OF_POWER.search(written) or _TWO_DIGITS.search(written):
        raise ValueError(wrong)
    registry = _registry()
    try:
        parsed = registry.parse_units(written)
        zero, factor = (
            float(registry.Quantity(value, parsed).to(unit or "dimensionless").magnitude)
            for value in (0.0, 1.0)
        )
        base = dict(registry.Quantity(1.0, parsed).to_base_units().unit_items())
        angle = float(str(base.get("radian", 0)))
    except Exception as error:  # pint raises tokenizer, attribute and dimension errors of its own
        raise ValueError(wrong) from error
    if zero != 0 or not math.isfinite(factor) or factor <= 0:  # degC, dB
        raise ValueError(wrong)
    if angle <= 0 or "rad" in unit:
        return factor
    if unit == "Hz":  # rad/s, rpm: pint takes a radian for 1, but a cycle has 2 pi
        return factor / (2 * math.pi)
    raise ValueError(wrong)


def _known_factor(written: str, unit: str) -> float | None:
    return 1.0 if written == unit else FACTORS.get(unit, {}).get(written)


_TWO_DIGITS = re.compile(r"\d\d")
_POWER = r"(?:\^|\*\*|[\u00b2\u00b3\u00b9\u2070-\u2079])"
_POWER_OF_POWER = re.compile(f"{_POWER}[^A-Za-z]*{_POWER}")
"""What no unit needs, but keeps a parser busy for ever, as 9^9^9 does."""


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
                raise PydanticKnownError("finite_number")
            return result

        return core_schema.no_info_before_validator_function(convert, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: core_schema.CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        unit = self.symbol or "1"
        number = {_JSON_NAMES.get(key, key): value for key, value in handler(schema).items()}
        number["description"] = f"SI number [{unit}]"
        text = {"type": "string", "description": f"a number with a unit, e.g. '1 {self.symbol}'"}
        if not self.symbol:
            text["description"] = "the number as a text"
        return {"anyOf": [number, text], "unit": unit}


_JSON_NAMES = {
    "gt": "exclusiveMinimum",
    "ge": "minimum",
    "lt": "exclusiveMaximum",
    "le": "maximum",
}
"""Keywords of JSON Schema for the bounds that pydantic leaves under its own names."""


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

    if not TYPE_CHECKING:  # what reads the code takes the arguments from the fields

        def __init__(self, **data: Any) -> None:
            """Make it from its fields; say in one sentence what is wrong with them."""
            try:
                super().__init__(**data)
            except ValidationError as error:
                raise explained(type(self), error) from None

        __init__.__pydantic_base_init__ = True  # tables of files are not made by it

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy with some values replaced, and nothing kept that followed from the old."""
        copied = super().model_copy(update=update, deep=deep)
        for name in set(copied.__dict__) - set(type(self).model_fields):
            del copied.__dict__[name]
        return copied
