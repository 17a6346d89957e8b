"""The identification file: a case or a beam, observations of it, and what of it may change.

It has the name of a case or beam file, `observations` (rows, or the name of a CSV file), tables
`[[parameters]]` for numbers of the case and `[[distributions]]` for columns of its stations, and
`[fit]`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, create_model, model_validator

from antinode.beam.families import BENDING, FamilyName
from antinode.beam.file import TABLES, BeamFile
from antinode.errors import InputError
from antinode.inputs.explain import validate
from antinode.inputs.reading import read_beside_case, toml_source
from antinode.inputs.units import Frozen, Number, Unit
from antinode.methods import ProblemMethods
from antinode.study.design.loading import load_subject
from antinode.study.design.subject import OfBeam, OfVehicle, subject_of
from antinode.vehicle.case import Case
from antinode.vehicle.condition import OperatingCondition

from .observation_table import read_observations

Quantity = float | str
"""A number, or a text with the unit of the key that it belongs to."""


def _measured(value: object) -> object:
    """Take NaN and an empty text for a mode that was not measured."""
    empty = isinstance(value, str) and value.strip().lower() in ("", "nan")
    return None if empty or (isinstance(value, float) and math.isnan(value)) else value


Frequency = Annotated[
    Annotated[float, Unit("Hz"), Field(gt=0)] | None,
    BeforeValidator(_measured),
]


class ShapeRow(Frozen):
    """An observed shape, which finds the mode that its frequency belongs to."""

    family: FamilyName = Field(default=BENDING, description="family of the mode")
    number: int = Field(
        ge=1, le=500, strict=True, description="place of its frequency in the row, from 1"
    )
    x: tuple[Annotated[float, Unit("m")], ...] = Field(
        min_length=3, description="where it was measured [m]"
    )
    displacement: tuple[float, ...] = Field(
        min_length=3, description="displacements there, to any scale"
    )

    @model_validator(mode="after")
    def _check_shape(self) -> Self:
        if len(self.x) != len(self.displacement):
            wrong = f"displacement has {len(self.displacement)} values, but x has {len(self.x)}"
            raise ValueError(f"{wrong}: give one for each place")
        if not any(self.displacement):
            raise ValueError("displacement is zero everywhere: give the measured shape")
        return self


class RowBase(Frozen):
    """What was observed in one condition."""

    name: str = Field(default="", max_length=80, description="shown in tables")
    bending: tuple[Frequency, ...] = Field(
        default=(),
        max_length=500,
        description="frequencies of bending 1, 2, ... [Hz]; nan where not measured",
    )
    longitudinal: tuple[Frequency, ...] = Field(
        default=(),
        max_length=500,
        description="frequencies of longitudinal 1, 2, ... [Hz]; nan where not measured",
    )
    torsion: tuple[Frequency, ...] = Field(
        default=(),
        max_length=500,
        description="frequencies of torsion 1, 2, ... [Hz]; nan where not measured",
    )
    shapes: tuple[ShapeRow, ...] = Field(
        default=(), description="observed shapes; they pair modes by MAC in place of the number"
    )
    relative_sd: Annotated[Number, Field(gt=0)] | None = Field(
        default=None, description="standard deviation of the row's frequencies, relative"
    )
    sd: Annotated[float, Unit("Hz"), Field(gt=0)] | None = Field(
        default=None, description="standard deviation of the row's frequencies [Hz]"
    )
    weight: Annotated[Number, Field(gt=0)] = Field(
        default=1.0, description="factor on the row's residuals"
    )
    mass_state: str | None = Field(
        default=None, description="name of a mass state of the case, in place of burn_fraction"
    )
    inputs: dict[str, Quantity] = Field(
        default={},
        description="other numbers of the case, or of the beam, as they were in this row, by "
        "their paths, e.g. {'point_masses.0.mass' = '2 kg'}",
    )

    def settings(self) -> dict[str, float]:
        """Return what the row sets of the condition, SI."""
        values = {key: getattr(self, key) for key in OperatingCondition.model_fields}
        return {key: value for key, value in values.items() if value is not None}


def _optional(key: str) -> tuple[Any, Any]:
    """Return a key of the condition as one that a row may leave to the case."""
    info = OperatingCondition.model_fields[key]
    annotation: Any = info.annotation
    if info.metadata:
        annotation = Annotated[annotation, *info.metadata]
    text = f"{info.description}; by default the case's"
    return annotation | None, Field(default=None, description=text)


_FIELDS: dict[str, Any] = {key: _optional(key) for key in OperatingCondition.model_fields}
ObservationRow: type[RowBase] = create_model(
    "ObservationRow",
    __base__=RowBase,
    __doc__="What was observed in one condition; keys of the condition stand for the case's.",
    **_FIELDS,
)


class Prior(Frozen):
    """What is known of a parameter before the data."""

    mean: Quantity | None = Field(
        default=None, description="mean (of a lognormal one the median); by default the start"
    )
    sd: Quantity = Field(
        description="standard deviation; of a lognormal prior that of the logarithm"
    )
    kind: Literal["normal", "lognormal"] = Field(default="normal", description="its distribution")


class Parameter(Frozen):
    """A number of the case that may change."""

    key: str = Field(
        min_length=1,
        max_length=200,
        description="its path, e.g. vehicle.cavitator.diameter; of a beam springs.0.translational",
    )
    name: str | None = Field(default=None, max_length=60, description="shown in tables")
    per_row: bool = Field(default=False, description="a value of its own for every row")
    start: Quantity | None = Field(
        default=None, description="where to start; by default the case's, or the row's"
    )
    lower: Quantity | None = Field(default=None, description="lower bound")
    upper: Quantity | None = Field(default=None, description="upper bound")
    prior: Prior | None = Field(default=None, description="what is known beforehand")
    scale: Literal["linear", "log"] = Field(
        default="linear", description="log: the logarithm is what is fitted"
    )


class Distribution(Frozen):
    """A column of the stations that may change along the body, on a logarithmic scale."""

    column: str = Field(
        min_length=1,
        max_length=100,
        description="mass_per_length, mass_per_length:NAME, bending_stiffness, axial_stiffness "
        "or radius; of a beam any column of its stations",
    )
    name: str | None = Field(default=None, max_length=60, description="shown in tables")
    segments: bool = Field(default=False, description="one value for each row of the column")
    control_points: int | tuple[Annotated[float, Unit("m")], ...] | None = Field(
        default=None, description="number of evenly spaced points, or their x [m]"
    )
    interpolation: Literal["linear", "cubic"] = Field(
        default="cubic", description="of the logarithm between control points"
    )
    fitted: Literal["factor", "value"] = Field(
        default="factor",
        description="what the points hold: a factor on the case's column, or the column itself",
    )
    relative_to: str | None = Field(
        default=None,
        description="another column: the values are then ratios to that one as fitted",
    )
    lower: Annotated[Number, Field(gt=0)] | None = Field(
        default=None, description="least factor on the start, below 1"
    )
    upper: Annotated[Number, Field(gt=0)] | None = Field(
        default=None, description="largest factor on the start, above 1"
    )
    prior_sd: Annotated[Number, Field(gt=0)] | None = Field(
        default=None, description="standard deviation of the logarithm about the start"
    )
    smoothness: Annotated[Number, Field(ge=0)] = Field(
        default=0.0,
        description="weight of the logarithm's second differences: 1 over their standard deviation",
    )

    @model_validator(mode="after")
    def _check_choice(self) -> Self:
        if self.segments == (self.control_points is not None):
            raise ValueError("give segments = true, or control_points: one of the two")
        points = self.control_points
        if isinstance(points, int) and not 1 <= points <= 200:
            raise ValueError(f"control_points is {points}; 1 to 200 are allowed")
        if isinstance(points, tuple) and (not points or any(b <= a for a, b in pairwise(points))):
            raise ValueError("control_points must increase from the nose aft: sort them")
        return self


class Fit(Frozen):
    """How to fit."""

    starts: int = Field(default=1, ge=1, le=1000, strict=True, description="number of starts")
    seed: int = Field(default=0, ge=0, strict=True, description="of the further starts")
    max_evaluations: int = Field(
        default=200, ge=1, le=100_000, strict=True, description="of the model, for each start"
    )
    tries: int = Field(
        default=4,
        ge=0,
        le=1000,
        strict=True,
        description="further descents from beside a kink of the loads at which one has jammed",
    )
    loss: Literal["linear", "soft_l1", "huber", "cauchy", "arctan"] = Field(
        default="linear", description="of the residuals; all but linear forgive outliers"
    )
    tolerance: Annotated[Number, Field(ge=1e-15, le=0.1)] = Field(
        default=1e-10, description="relative change of the cost at which a fit ends"
    )
    frequency_tolerance: Annotated[Number, Field(ge=1e-11, le=1e-4)] = Field(
        default=1e-8, description="relative error of a frequency by what varies inside segments"
    )
    relative_sd: Annotated[Number, Field(gt=0)] | None = Field(
        default=None, description="standard deviation of every frequency, relative"
    )
    sd: Annotated[float, Unit("Hz"), Field(gt=0)] | None = Field(
        default=None, description="standard deviation of every frequency [Hz]"
    )


class _Choices(Frozen):
    parameters: tuple[Parameter, ...] = Field(default=(), description="numbers that may change")
    distributions: tuple[Distribution, ...] = Field(
        default=(), description="columns of the stations that may change"
    )
    fit: Fit = Field(default=Fit(), description="how to fit")


class IdentificationFile(_Choices):
    """The file as it stands in TOML."""

    case: str = Field(
        min_length=1, description="name of the case file, or of a beam file, beside this one"
    )
    observations: tuple[ObservationRow, ...] = Field(
        min_length=1, description="what was observed: rows, or the name of a CSV file"
    )


class IdentificationProblem(ProblemMethods, _Choices):
    """A case or a beam file, observations of it, and what of it may change."""

    case: Case | BeamFile = Field(description="where to start")
    case_text: str = Field(
        default="", repr=False, description="its file, whose comments a fitted case keeps"
    )
    observations: tuple[ObservationRow, ...] = Field(min_length=1, description="what was observed")

    @property
    def subject(self) -> OfVehicle | OfBeam:
        """The case or the beam, as what may change asks for it."""
        return parameters_of(self.case)


def parameters_of(case: Case | BeamFile) -> OfVehicle | OfBeam:
    """Return a case or a beam as what may change asks for it."""
    return OfBeam(case, table="parameters") if isinstance(case, BeamFile) else subject_of(case)


def load_identification(path: str | Path, assignments: Iterable[str] = ()) -> IdentificationProblem:
    """Read an identification file with its case and its observations.

    Parameters
    ----------
    path : str or Path
        A TOML file.
    assignments : iterable of str
        Overrides of the identification file such as ``"fit.starts=8"``.

    Raises
    ------
    InputError
        If anything in it is wrong.
    """
    path = Path(path)
    tables, where = read_beside_case(path, assignments, "an identification file")
    elsewhere = {}
    if isinstance(table := tables.get("observations"), str):
        elsewhere["observations"] = path.parent / table
        tables["observations"] = read_observations(path.parent / table)
    elif table == []:
        raise InputError(f"{where}: observations is empty; give one row at the least")
    file = validate(IdentificationFile, tables, where, elsewhere, ("observations",))
    source = path.parent / file.case
    return IdentificationProblem(
        case=load_subject(source),
        case_text="" if source.suffix.lower() in TABLES else toml_source(source),
        observations=file.observations,
        **{k: getattr(file, k) for k in _Choices.model_fields},
    )
