"""Sensitivity: how uncertain the frequencies are, and which inputs make them so.

    result = sensitivity(study, 1024)

Global: mean, deviation, 95 % band and Sobol indices of every frequency over the distributions of
the inputs. Local: derivatives at the case itself, of vehicles from the mode shapes, of beams by
differences, in % per %.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.arguments import wanted
from antinode.arrays import Array
from antinode.errors import ComputationError, InputError
from antinode.methods import SensitivityMethods
from antinode.modes.result import null
from antinode.study.cases.chunks import mode_names
from antinode.study.design.file import MARGIN_OUTPUTS, Study, shear_output
from antinode.study.design.points import Points, points_of
from antinode.study.sweep.sweep import sweep
from antinode.vehicle.case import Case

from .beam_slopes import response_slopes
from .indices import Indices, sobol_indices
from .local import beside_inputs, local_slopes, starts_of
from .margins import LABELS, margin_slopes

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class ModeSensitivity:
    """What one frequency depends on.

    Attributes
    ----------
    name : str
    nominal, mean, sd : float
        Of the case itself; over the distributions [Hz].
    band : tuple of float
        2.5 and 97.5 % quantiles [Hz].
    indices : Indices
        By input.
    slope : array
        Derivative at the case by each input [Hz for each SI unit]; NaN where there is none.
    elasticity : array
        The same in % per %.
    model_error, effect_of_shear : float
        The largest effect of shear and rotary inertia among the cases, relative: estimated where
        the theory leaves them out, or solved; the other one is NaN.
    used : int
        Samples that the indices are made of: those whose cases all have this frequency.
    without : int
        Cases without this frequency: the mode diverges, or the case failed.
    """

    name: str
    nominal: float
    mean: float
    sd: float
    band: tuple[float, float]
    indices: Indices
    slope: Array
    elasticity: Array
    model_error: float
    effect_of_shear: float
    used: int
    without: int


@dataclass(frozen=True)
class NumberSensitivity:
    """What a number of the response depends on.

    Attributes
    ----------
    name, label, unit : str
    nominal, mean, sd : float
        At the case itself; over the distributions.
    band : tuple of float
        2.5 and 97.5 % quantiles.
    error : float
        The largest error among the cases; NaN where none is known.
    indices : Indices
        By input.
    slope, elasticity : array
        Derivative at the case by each input, per SI unit; the same in % per % (of a margin in dB:
        dB per %).
    used, without : int
        Samples that the indices are made of; cases without this number.
    """

    name: str
    label: str
    unit: str
    nominal: float
    mean: float
    sd: float
    band: tuple[float, float]
    error: float
    indices: Indices
    slope: Array
    elasticity: Array
    used: int
    without: int


@dataclass(frozen=True, repr=False)
class SensitivityResult(SensitivityMethods):
    """Sensitivities of all frequencies.

    Attributes
    ----------
    name : str
    inputs, units : tuple of str
    modes : tuple of ModeSensitivity
    responses : tuple of NumberSensitivity
        Of what the response comes to, if the study has one, and of the margins that it keeps.
    samples, cases, failed : int
        Samples of each arrangement; all cases; those of them that failed.
    left_out, warnings : tuple of dict
        Which samples have no frequency, and what the indices then mean; all that is warned of,
        these included: `message`, `count`, `share` of all cases, `first_case`.
    not_modelled : tuple of str
        What the model leaves out.
    """

    name: str
    inputs: tuple[str, ...]
    units: tuple[str, ...]
    modes: tuple[ModeSensitivity, ...]
    samples: int
    cases: int
    failed: int
    left_out: tuple[dict[str, Any], ...]
    warnings: tuple[dict[str, Any], ...]
    responses: tuple[NumberSensitivity, ...] = ()
    not_modelled: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain values for JSON."""
        return {
            "schema_version": 1,
            "name": self.name,
            "samples": self.samples,
            "cases": self.cases,
            "failed": self.failed,
            "inputs": [
                {"name": n, "unit": u} for n, u in zip(self.inputs, self.units, strict=True)
            ],
            "modes": [self._mode(m) for m in self.modes],
            "responses": [self._response(r) for r in self.responses],
            "not_modelled": list(self.not_modelled),
            "warnings": list(self.warnings),
        }

    def _mode(self, m: ModeSensitivity) -> dict[str, Any]:
        return {
            "name": m.name,
            "frequency_hz": m.nominal,
            "mean_hz": m.mean,
            "sd_hz": m.sd,
            "band_hz": list(m.band),
            "model_error": null(m.model_error),
            "effect_of_shear": null(m.effect_of_shear),
            "samples_used": m.used,
            "cases_without_frequency": m.without,
            "inputs": [
                {
                    **self._shares(m.indices, k),
                    "slope_hz_per_unit": m.slope[k],
                    "percent_per_percent": m.elasticity[k],
                }
                for k in range(len(self.inputs))
            ],
        }

    def _shares(self, indices: Indices, k: int) -> dict[str, Any]:
        return {
            "name": self.inputs[k],
            "first": indices.first[k],
            "first_band": indices.first_band[k],
            "total": indices.total[k],
            "total_band": indices.total_band[k],
        }

    def _response(self, r: NumberSensitivity) -> dict[str, Any]:
        per = "unit_per_percent" if r.unit == "dB" else "percent_per_percent"
        return {
            **{name: getattr(r, name) for name in ("name", "label", "unit")},
            **{name: null(getattr(r, name)) for name in ("nominal", "mean", "sd", "error")},
            "band": list(r.band),
            "samples_used": r.used,
            "cases_without": r.without,
            "inputs": [
                {**self._shares(r.indices, k), "slope": r.slope[k], per: r.elasticity[k]}
                for k in range(len(self.inputs))
            ],
        }


def sensitivity(
    study: Study,
    samples: int | None = None,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    store: str | Path | None = None,
    overwrite: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> SensitivityResult:
    """Compute the sensitivities of all frequencies of a study to its inputs.

    Parameters
    ----------
    study : Study
        Its inputs have distributions; its design is replaced.
    samples : int, optional
        Of each arrangement; inputs + 2 times as many cases are solved. By default design.number,
        or 1024.
    workers : int
    scheduler : str, optional
    store : str or Path, optional
        Where the cases are kept.
    overwrite : bool
        These four are those of `sweep`.
    progress : callable, optional

    Raises
    ------
    InputError
        If an input has no distribution.
    ComputationError
        If less than half of the samples can be solved.
    """
    wanted("the study", study, Study, "load_study('study.toml')")
    number = samples or study.design.number or 1024
    if number < 8:
        raise InputError(f"{number} samples are too few; take 1024")
    design = study.design.model_copy(update={"kind": "saltelli", "number": number, "table": None})
    outputs = tuple(dict.fromkeys(("frequency_hz", shear_output(study.case), *study.outputs)))
    made = study.model_copy(update={"design": design, "outputs": outputs})
    points = points_of(made)
    data = sweep(
        made,
        store,
        workers=workers,
        scheduler=scheduler,
        overwrite=overwrite,
        progress=progress,
    )
    return _result(made, points, data, number)


def _result(study: Study, points: Points, data: xarray.Dataset, number: int) -> SensitivityResult:
    """Evaluate the cases of a study, so many samples of each arrangement."""
    shear = shear_output(study.case)
    hz, effect = np.asarray(data["frequency_hz"]), np.asarray(data[shear])
    hz, names = np.where(hz > 0, hz, np.nan), mode_names(study)
    kept = kept_modes(study, hz[: 2 * number])
    slopes = local_slopes(study, points)
    modes = [
        _mode(points, names[k], hz[:, k], {shear: _farthest(effect[:, k])}, number, slopes)
        for k in kept
    ]
    left_out = (
        *_left_out(modes, hz[:, kept], number),
        *(left_out_mode(names[k], hz[:, k]) for k in range(len(names)) if k not in kept),
    )
    return SensitivityResult(
        name=study.name or study.subject.name,
        inputs=tuple(v.name for v in points.variables),
        units=tuple(v.unit for v in points.variables),
        modes=tuple(modes),
        samples=number,
        cases=points.cases,
        failed=data.attrs["failed"],
        left_out=left_out,
        warnings=(*left_out, *data.attrs["warnings"]),
        responses=(*_responses(points, data, number), *_margins(points, data, number)),
        not_modelled=tuple(data.attrs.get("not_modelled", ())),
    )


def _responses(points: Points, data: xarray.Dataset, number: int) -> tuple[NumberSensitivity, ...]:
    """Evaluate what the responses come to."""
    if not points.study.asked:
        return ()
    slopes, start = response_slopes(points), starts_of(points)
    rows = []
    for one in points.study.asked:
        values, error = (np.asarray(data[name]) for name in (one.name, f"{one.name}_error"))
        known, both = np.isfinite(values), values[: 2 * number]
        if not np.any(known[: 2 * number]):
            continue
        both = both[np.isfinite(both)]
        nominal, slope = slopes[one.name]
        low, high = np.quantile(both, [0.025, 0.975])
        with np.errstate(all="ignore"):
            share = slope * start / (100.0 if one.unit == "dB" else nominal)
        rows.append(
            NumberSensitivity(
                one.name,
                one.label,
                one.unit,
                nominal=nominal,
                mean=float(both.mean()),
                sd=float(both.std(ddof=1)) if len(both) > 1 else math.nan,
                band=(float(low), float(high)),
                error=_farthest(error),
                indices=sobol_indices(values, len(points.variables)),
                slope=slope,
                elasticity=share,
                used=int(np.count_nonzero(known.reshape(-1, number).all(axis=0))),
                without=int(np.count_nonzero(~known)),
            )
        )
    return tuple(rows)


def _margins(points: Points, data: xarray.Dataset, number: int) -> Iterator[NumberSensitivity]:
    """Evaluate the margins of stability that the study keeps."""
    start = starts_of(points)
    wanted = any(name in MARGIN_OUTPUTS for name in points.study.outputs)
    slopes = margin_slopes(points.study, beside_inputs(points) if wanted else [])
    for name, (nominal, error, slope) in slopes.items():
        values = np.asarray(data[name])
        known, both = np.isfinite(values), values[: 2 * number]
        both = both[np.isfinite(both)]
        if len(both) < 2:
            continue
        low, high = np.quantile(both, [0.025, 0.975])
        yield NumberSensitivity(
            name,
            LABELS[name],
            MARGIN_OUTPUTS[name][0],
            nominal=nominal,
            mean=float(both.mean()),
            sd=float(both.std(ddof=1)),
            band=(float(low), float(high)),
            error=error,
            indices=sobol_indices(values, len(points.variables)),
            slope=slope,
            elasticity=slope * start / nominal,
            used=int(np.count_nonzero(known.reshape(-1, number).all(axis=0))),
            without=int(np.count_nonzero(~known)),
        )


def kept_modes(study: Study, hz: Array) -> list[int]:
    """Return the modes that are told of, and refuse to speak of what most samples do not have.

    On the water's stiffness modes stand in the list that do not oscillate, and are left out.
    """
    known = np.isfinite(hz)
    case = study.case
    answered = isinstance(case, Case) and case.model.water_answers
    kept = [k for k in range(hz.shape[1]) if not answered or known[:, k].mean() >= _HALF]
    share = known[:, kept].all(axis=1).mean() if kept else 0.0
    if share < _HALF:
        raise ComputationError(
            f"only {share:.0%} of the samples have all frequencies; narrow the distributions"
        )
    return kept


_HALF = 0.5


def left_out_mode(name: str, hz: Array) -> dict[str, Any]:
    """Say that a mode is left out."""
    missing = ~np.isfinite(hz)
    return {
        "message": f"{name} does not oscillate in most cases (it is overdamped, or grows alone), "
        "and is left out here",
        "count": int(np.count_nonzero(missing)),
        "share": float(missing.mean()),
        "first_case": int(np.argmax(missing)),
    }


def _left_out(modes: list[ModeSensitivity], hz: Array, number: int) -> Iterator[dict[str, Any]]:
    """Say which samples have no frequency, and what the indices then mean."""
    for k, mode in enumerate(modes):
        if not mode.without:
            continue
        yield {
            "message": (
                f"{mode.name} has no frequency in some cases (it diverges, or the case failed): "
                "its mean, deviation and band are those of the samples that vibrate, its indices "
                f"those of the {mode.used} of {number} samples all of whose cases do. On this "
                "condition the inputs are not independent, and the indices are no shares of one "
                "variance any more: narrow the distributions, or read them as a ranking"
            ),
            "count": mode.without,
            "share": mode.without / len(hz),
            "first_case": int(np.flatnonzero(~np.isfinite(hz[:, k]))[0]),
        }


def _mode(
    points: Points,
    name: str,
    hz: Array,
    shear: Mapping[str, float],
    number: int,
    slopes: dict[str, tuple[float, Array]],
) -> ModeSensitivity:
    """Evaluate one mode, from its frequencies and the largest effect of shear on them."""
    known = np.isfinite(hz)
    both = hz[: 2 * number]
    both = both[np.isfinite(both)]
    nominal, slope = slopes[name]
    start = starts_of(points)
    low, high = np.quantile(both, [0.025, 0.975])
    return ModeSensitivity(
        name=name,
        nominal=nominal,
        mean=float(both.mean()),
        sd=float(both.std(ddof=1)),
        band=(float(low), float(high)),
        indices=sobol_indices(hz, len(points.variables)),
        slope=slope,
        elasticity=slope * start / nominal,
        model_error=shear.get("model_error", math.nan),
        effect_of_shear=shear.get("effect_of_shear", math.nan),
        used=int(np.count_nonzero(known.reshape(-1, number).all(axis=0))),
        without=int(np.count_nonzero(~known)),
    )


def _farthest(effect: Array) -> float:
    return max(effect[np.isfinite(effect)].tolist(), key=abs, default=math.nan)
