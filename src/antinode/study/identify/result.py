"""What an identification gives: the fitted case, every unknown, observed against fitted."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from antinode.beam.attachments import feeds_back
from antinode.beam.families import BENDING, FamilyName
from antinode.errors import InputError
from antinode.methods import IdentificationMethods
from antinode.modes.result import not_modelled
from antinode.study.design.subject import Given, subject_of

from .estimates import Estimates
from .file import IdentificationProblem
from .fit import Start
from .observations import gather
from .unknowns import Unknowns
from .words import correlations_text, directions_text


@dataclass(frozen=True)
class Comparison:
    """One observed frequency against the fitted one.

    Attributes
    ----------
    row : int
        From 1.
    label : str
        Of the row.
    family : {"bending", "longitudinal", "torsion"}
    number : int
        Of the observed mode.
    paired : int
        Number of the computed mode that it belongs to.
    observed_hz, fitted_hz, sd_hz : float
        [Hz].
    mac : float
        Likeness of the shapes; NaN where none was observed.
    """

    row: int
    label: str
    family: FamilyName
    number: int
    paired: int
    observed_hz: float
    fitted_hz: float
    sd_hz: float
    mac: float

    @property
    def relative(self) -> float:
        """Fitted less observed, over observed [-]."""
        return self.fitted_hz / self.observed_hz - 1

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values."""
        return {
            "row": self.row,
            "name": self.label,
            "family": self.family,
            "number": self.number,
            "paired_number": self.paired,
            "observed_hz": self.observed_hz,
            "fitted_hz": self.fitted_hz,
            "relative_difference": self.relative,
            "sd_hz": self.sd_hz,
            "mac": _null(self.mac),
        }


@dataclass(frozen=True)
class Estimate:
    """One unknown as found.

    Attributes
    ----------
    name, unit : str
    value, start : float
    sd : float
        Standard deviation of the value; NaN at a bound, infinite where nothing determines it.
    interval : tuple of float
        95 %.
    determined : float
        Share of the prior's variance that the data removed; 1 without a prior.
    at_bound : bool
    """

    name: str
    unit: str
    value: float
    start: float
    sd: float
    interval: tuple[float, float]
    determined: float
    at_bound: bool

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain values."""
        return {
            "name": self.name,
            "unit": self.unit,
            "value": self.value,
            "start": self.start,
            "sd": _null(self.sd),
            "interval_95": [_null(v) for v in self.interval],
            "determined": self.determined,
            "at_bound": self.at_bound,
        }


@dataclass(frozen=True, repr=False)
class Identification(IdentificationMethods):
    """What was identified; immutable.

    Attributes
    ----------
    problem : IdentificationProblem
    case : Case or BeamFile
        With the values found, in the condition of its file.
    estimates : Estimates
        Covariance and what follows from it.
    comparisons : tuple of Comparison
    starts : tuple of Start
    cost : float
        Half the sum of squares at the end.
    interrupted : bool
        Whether it was stopped early: the values are the best so far.
    evaluations : int
    seconds : float
    warnings : tuple of str
    """

    problem: IdentificationProblem
    case: Given
    estimates: Estimates = field(repr=False)
    comparisons: tuple[Comparison, ...] = field(repr=False)
    starts: tuple[Start, ...]
    cost: float
    interrupted: bool
    evaluations: int
    seconds: float
    warnings: tuple[str, ...]

    @property
    def name(self) -> str:
        """Of the vehicle or the beam."""
        return subject_of(self.case).name

    @property
    def not_modelled(self) -> tuple[str, ...]:
        """What the model leaves out."""
        beam = self.case.beam()
        return not_modelled(beam, feeds_back(beam.attachments, BENDING))

    @property
    def unknowns(self) -> Unknowns:
        """What could change."""
        return self.estimates.unknowns

    @cached_property
    def parameters(self) -> tuple[Estimate, ...]:
        """Every unknown as found, in the order of the file."""
        e = self.estimates
        values, slopes = self.unknowns.values(e.vector), self.unknowns.slopes(e.vector)
        return tuple(
            Estimate(
                name=item.label,
                unit=item.unit,
                value=float(values[k]),
                start=item.start,
                sd=float(e.deviation[k] * slopes[k]),
                interval=e.interval(k),
                determined=float(e.determined[k]),
                at_bound=bool(e.at_bound[k]),
            )
            for k, item in enumerate(self.unknowns.items)
        )

    @cached_property
    def worst_relative(self) -> float:
        """Largest relative difference of a frequency [-]."""
        return max(abs(c.relative) for c in self.comparisons)

    @cached_property
    def rms_relative(self) -> float:
        """Root mean square of the relative differences [-]."""
        return math.sqrt(float(np.mean([c.relative**2 for c in self.comparisons])))

    def parameter(self, name: str) -> Estimate:
        """Return an unknown by its name."""
        for item in self.parameters:
            if item.name == name:
                return item
        have = ", ".join(item.name for item in self.parameters[:20])
        raise InputError(f"there is no parameter '{name[:60]}' in this result; it has {have}")

    def row_case(self, row: int) -> Given:
        """Return the fitted case in the condition of a row (from 1), its own values included."""
        rows = gather(self.problem)
        if not 1 <= row <= len(rows):
            raise InputError(f"there is no row {row}; rows run from 1 to {len(rows)}")
        base = rows[row - 1].condition(self.case)
        return self.unknowns.apply_row(base, self.estimates.vector, row - 1)

    def __str__(self) -> str:
        lines = [
            f"{len(self.comparisons)} frequencies in {len(self.problem.observations)} rows: "
            f"rms difference {self.rms_relative:.2e}, worst {self.worst_relative:.2e}"
        ]
        lines += [f"  {p.name}: {p.value:.6g} {p.unit} +- {p.sd:.2g}" for p in self.parameters]
        return "\n".join([*lines, *(f"  warning: {w}" for w in self.warnings)])

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers for JSON."""
        e = self.estimates
        return {
            "schema_version": 1,
            "name": self.name,
            "interrupted": self.interrupted,
            "cost": self.cost,
            "worst_relative": self.worst_relative,
            "rms_relative": self.rms_relative,
            "noise_factor": e.noise,
            "noise_known": e.known_noise,
            "degrees_of_freedom": e.freedoms,
            "parameters": [p.to_dict() for p in self.parameters],
            "rows": [c.to_dict() for c in self.comparisons],
            "correlation": e.correlation.tolist(),
            "singular_values": e.singular_values.tolist(),
            "undetermined": [
                {
                    "singular_value": d.singular_value,
                    "parameters": [e.unknowns.items[k].label for k in d.entries],
                    "parts": list(d.parts),
                }
                for d in e.undetermined
            ],
            "words": [*directions_text(e), *correlations_text(e)],
            "starts": [start._asdict() for start in self.starts],
            "evaluations": self.evaluations,
            "seconds": self.seconds,
            "not_modelled": list(self.not_modelled),
            "warnings": list(self.warnings),
        }


def _null(value: float) -> float | None:
    return value if math.isfinite(value) else None
