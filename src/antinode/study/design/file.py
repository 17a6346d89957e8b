"""The study file: a case or a beam, what of it varies, how it varies, and what to compute.

It has the name of a case or beam file, tables `[[inputs]]` for numbers and columns of it,
`[design]`, and perhaps `outputs`, `[solve]`, `[run]`, `[tracking]` and `[figure]`.
"""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from antinode.beam.families import BENDING, FamilyName
from antinode.beam.file import BeamFile
from antinode.inputs.units import Frozen, Length, Number, Unit
from antinode.methods import StudyMethods
from antinode.response.file import ResponseFile
from antinode.response.numbers import Asked, asked_of
from antinode.vehicle.case import Case

from .subject import OfBeam, OfVehicle, subject_of
from .table import DesignTable

Quantity = float | str
"""A number, or a text with the unit of the key that it belongs to."""
MOST_CASES = 1_000_000_000
MOST_VALUES = 1_000_000

LOAD_OUTPUTS = {
    "sigma": ("1", "cavitation number"),
    "cavity_length": ("m", "length of the cavity"),
    "cavity_diameter": ("m", "largest diameter of the cavity"),
    "F_CX": ("N", "drag of the cavitator, aft"),
    "F_CY": ("N", "lift of the cavitator, up"),
    "F_fX": ("N", "drag of all fins, aft"),
    "F_fY": ("N", "lift of all fins, up"),
    "F_PX": ("N", "planing drag, aft"),
    "F_PY": ("N", "planing lift, up"),
    "x_P": ("m", "where the planing forces act"),
    "mass": ("kg", "mass of the body"),
    "x_M": ("m", "centre of mass from the nose"),
    "a_X": ("m/s^2", "acceleration, forward"),
    "a_Y": ("m/s^2", "acceleration of the centre of mass, up"),
    "beta": ("rad/s^2", "angular acceleration, nose-up"),
}
"""Unit and meaning of the outputs that have one number a case."""
MARGIN_OUTPUTS = {
    "flutter_factor": (
        "1",
        "factor on all axial forces at which flutter begins; NaN where none does. Solved a case at "
        "a time: a second or so each",
    ),
    "divergence_factor": (
        "1",
        "factor on all axial forces at which a mode first diverges, rotations included; NaN where "
        "none does before flutter. Solved with flutter_factor",
    ),
}
"""The same, of stability: without dashpots and loss factors."""
PROOF_OUTPUTS = {
    "proven": (
        "1",
        "1 where all modes of a case are proven to be found, 0 where not; NaN where it failed "
        "otherwise",
    )
}
"""The same, of the certificate."""
OF_BEAMS = ("mass", *MARGIN_OUTPUTS, *PROOF_OUTPUTS)
"""Those of them that a beam has."""
CASE_OUTPUTS = LOAD_OUTPUTS | MARGIN_OUTPUTS | PROOF_OUTPUTS
"""Unit and meaning of all of them."""
KINDS = ("elastic", "divergent", "flutter", "overdamped")
"""Kinds of modes in the order of their numbers."""
MODE_OUTPUTS = {
    "frequency_hz": ("Hz", "natural frequency; NaN where divergent or not solved"),
    "error_hz": ("Hz", "the frequency lies within this of frequency_hz"),
    "model_error": (
        "1",
        "estimated relative effect of shear and rotary inertia, which the model leaves out, with "
        "kGA = EA/4.9 (a thin-walled tube, kappa = 0.53), -1 where no frequency is left; "
        "from the shapes of some cases of each chunk: over wide ranges of loads up to 15 % of "
        "itself off what the case alone tells",
    ),
    "effect_of_shear": (
        "1",
        "relative effect of shear and rotary inertia, solved: f/f_EB - 1 at the same axial force; "
        "NaN where the theory leaves them out, and of complex modes",
    ),
    "omega2": ("rad^2/s^2", "eigenvalue"),
    "growth_rate_per_s": (
        "1/s",
        "growth rate of a divergent mode, or of a complex one: of dashpots, flutter; else NaN or 0",
    ),
    "damping_ratio": (
        "1",
        "-Re s over abs(s): of beams with dashpots, of vehicles on the water's stiffness; 0 "
        "without damping, negative where the motion grows",
    ),
    "kind": ("1", "0 elastic, 1 divergent, 2 flutter, 3 overdamped"),
}
"""Unit and meaning of the outputs that have one number a mode."""
OutputName = Literal[
    "frequency_hz",
    "error_hz",
    "model_error",
    "effect_of_shear",
    "omega2",
    "growth_rate_per_s",
    "damping_ratio",
    "kind",
    "flutter_factor",
    "divergence_factor",
    "proven",
    "sigma",
    "cavity_length",
    "cavity_diameter",
    "F_CX",
    "F_CY",
    "F_fX",
    "F_fY",
    "F_PX",
    "F_PY",
    "x_P",
    "mass",
    "x_M",
    "a_X",
    "a_Y",
    "beta",
]


class StudyInput(Frozen):
    """A number or a column of the case that varies, or the time of a history."""

    key: str = Field(
        min_length=1,
        max_length=200,
        description="its path, e.g. condition.speed, or a column, e.g. bending_stiffness, or time",
    )
    name: str | None = Field(
        default=None, max_length=60, description="of its coordinate; by default the key's last part"
    )
    values: tuple[Quantity, ...] | None = Field(
        default=None, max_length=MOST_VALUES, description="its values (grid, zip)"
    )
    low: Quantity | None = Field(default=None, description="lower end of its range")
    high: Quantity | None = Field(default=None, description="upper end of its range")
    number: int | None = Field(
        default=None, ge=1, le=MOST_VALUES, strict=True, description="of values from low to high"
    )
    spacing: Literal["linear", "log"] = Field(
        default="linear", description="of the values from low to high"
    )
    distribution: Literal["uniform", "loguniform", "normal", "lognormal", "triangular"] = Field(
        default="uniform",
        description="of random, latin_hypercube and sobol; low and high cut a normal one",
    )
    mean: Quantity | None = Field(
        default=None,
        description="of normal (median of lognormal, peak of triangular); by default the case's",
    )
    sd: Quantity | None = Field(
        default=None, description="of normal; of lognormal that of the logarithm"
    )
    factor: bool = Field(default=False, description="whether it multiplies the case's value")
    control_points: int | tuple[Length, ...] | None = Field(
        default=None,
        description="of a column: number of even points or their x [m], each a factor of its own",
    )
    interpolation: Literal["linear", "cubic"] = Field(
        default="cubic", description="of the factor's logarithm between control points"
    )

    @model_validator(mode="after")
    def _check_choice(self) -> Self:
        points = self.control_points
        if isinstance(points, int) and not 1 <= points <= 200:
            raise ValueError(f"control_points is {points}; 1 to 200 are allowed")
        if isinstance(points, tuple) and (not points or any(b <= a for a, b in pairwise(points))):
            raise ValueError("control_points must increase from the nose aft: sort them")
        if self.values is not None and not self.values:
            raise ValueError("values is empty; give one at the least")
        if self.values is not None and (self.low is not None or self.number is not None):
            raise ValueError("give values, or low, high and number: one of the two")
        return self


class Design(Frozen):
    """How the inputs vary together."""

    kind: Literal["grid", "zip", "random", "latin_hypercube", "sobol", "saltelli"] = Field(
        default="grid",
        description="every combination; side by side, as in a table or a time history; or samples "
        "(saltelli: those of antinode sensitivity, number times inputs + 2)",
    )
    number: int | None = Field(
        default=None, ge=1, strict=True, description="of samples (random, latin_hypercube, sobol)"
    )
    seed: int = Field(default=0, ge=0, strict=True, description="of the samples")
    table: str | None = Field(
        default=None,
        min_length=1,
        description="CSV or Parquet file with a column for each input and a row for each case, in "
        "place of [[inputs]] (zip)",
    )


class StudySolve(Frozen):
    """What to solve, and how well."""

    modes: int = Field(default=6, ge=1, le=100, strict=True, description="modes of each family")
    tolerance: Annotated[Number, Field(ge=1e-11, le=0.1)] = Field(
        default=1e-6, description="relative error of a frequency by what varies inside segments"
    )
    families: tuple[FamilyName, ...] = Field(
        default=(BENDING,), min_length=1, max_length=3, description="families of modes"
    )

    @model_validator(mode="after")
    def _check_families(self) -> Self:
        if len(set(self.families)) < len(self.families):
            told = ", ".join(self.families)
            raise ValueError(f"families names one twice ({told}); give each once")
        return self


class Run(Frozen):
    """How the work is divided; it belongs to the study, and the numbers depend on it (barely)."""

    chunk: int = Field(
        default=4096, ge=1, le=100_000, strict=True, description="cases that are solved together"
    )


class Tracking(Frozen):
    """Whether modes are followed by shape from case to case."""

    track: bool | None = Field(
        default=None,
        description="by default in grids, tables and histories of up to 20,000 cases",
    )
    points: int = Field(
        default=41, ge=9, le=501, strict=True, description="where shapes are compared along x"
    )
    doubtful: Annotated[Number, Field(ge=0, le=1)] = Field(
        default=0.8, description="likeness (MAC) of neighbours below which a mode is marked"
    )


class Excitation(Frozen):
    """A line in the figure: a frequency, or one that goes with the input along the axis."""

    name: str = Field(default="excitation", max_length=60, description="shown beside the line")
    frequency: Annotated[float, Unit("Hz")] = Field(default=0.0, description="at input 0 [Hz]")
    slope: Number = Field(default=0.0, description="Hz per SI unit of the input along the axis")


class StudyFigure(Frozen):
    """What `--plot` draws."""

    x: str | None = Field(
        default=None, max_length=60, description="name of the input along the axis; the first"
    )
    band: tuple[Annotated[float, Unit("Hz")], Annotated[float, Unit("Hz")]] | None = Field(
        default=(20.0, 2000.0), description="frequencies of equipment that are shaded [Hz]"
    )
    excitations: tuple[Excitation, ...] = Field(
        default=(), max_length=20, description="lines whose crossings with modes are marked"
    )


class Choices(Frozen):
    """What a study chooses, whatever its file names."""

    name: str = Field(default="", max_length=100, description="shown in figures and tables")
    inputs: tuple[StudyInput, ...] = Field(default=(), max_length=1000, description="what varies")
    design: Design = Field(default=Design(), description="how the inputs vary together")
    outputs: tuple[OutputName, ...] = Field(
        default=("frequency_hz", "error_hz", "model_error"),
        min_length=1,
        description="what is kept of every case; by default frequencies, their errors, and what "
        "shear does: effect_of_shear where the theory solves it, else model_error; of a vehicle "
        "with hydrodynamic_stiffness damping, growth and kind instead",
    )
    solve: StudySolve = Field(default=StudySolve(), description="what to solve, and how well")
    run_table: Run = Field(default=Run(), alias="run", description="how the work is divided")
    tracking: Tracking = Field(default=Tracking(), description="following modes by shape")
    figure: StudyFigure = Field(default=StudyFigure(), description="what --plot draws")


class StudyFile(Choices):
    """The file as it stands in TOML."""

    case: str = Field(
        min_length=1, description="name of the case file, or of a beam file, beside this one"
    )
    response: str | None = Field(
        default=None,
        min_length=1,
        description="name of a response file of the same case or beam: what each case then feels "
        "and carries is kept too",
    )


class Study(StudyMethods, Choices):
    """A case or a beam file, and what of it varies."""

    case: Case | BeamFile = Field(description="what the inputs are changed in")
    response: ResponseFile | None = Field(
        default=None, description="what each case is asked to bear, with its spectra and histories"
    )
    table: DesignTable | None = Field(
        default=None, description="the file of design.table, whose columns are the inputs"
    )

    @property
    def asked(self) -> tuple[Asked, ...]:
        """What the response of each case comes to."""
        own = self.response
        return () if own is None else asked_of(own.response.kind, own.outputs, own.equipment)

    @cached_property
    def subject(self) -> OfVehicle | OfBeam:
        """The case or the beam, as what varies asks for it."""
        return subject_of(self.case, self.response is not None)

    @property
    def vehicle_case(self) -> Case:
        """The case of a vehicle, which this study is of."""
        assert isinstance(self.case, Case)
        return self.case

    @model_validator(mode="before")
    @classmethod
    def _keep_what_shear_does(cls, data: Any) -> Any:
        if not isinstance(data, dict) or "outputs" in data:
            return data
        case = data.get("case")
        if isinstance(case, Case) and case.model.water_answers:
            return data | {"outputs": _OF_COMPLEX}
        effect = shear_output(case) if isinstance(case, Case | BeamFile) else "model_error"
        return data | {"outputs": ("frequency_hz", "error_hz", effect)}


_OF_COMPLEX = ("frequency_hz", "error_hz", "damping_ratio", "growth_rate_per_s", "kind")


def shear_output(case: Case | BeamFile) -> OutputName:
    """Return the output that tells what shear does: solved, or estimated where it is left out."""
    return "effect_of_shear" if subject_of(case).solves_shear else "model_error"
