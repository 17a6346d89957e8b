"""Modes as labelled arrays with units (xarray): a row for each mode, shapes along x."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.arrays import Array
from antinode.beam.families import FAMILIES, FamilyName
from antinode.extras import import_extra

if TYPE_CHECKING:
    import xarray

SCALARS: tuple[tuple[str, str, str], ...] = (
    ("frequency_hz", "Hz", "natural frequency; NaN where divergent"),
    ("error_hz", "Hz", "the frequency of the beam lies within this of frequency_hz"),
    ("omega2", "rad^2/s^2", "eigenvalue"),
    ("error_omega2", "rad^2/s^2", "bound on the error of omega2"),
    ("growth_rate_per_s", "1/s", "growth rate of a divergent mode; NaN where omega2 >= 0"),
    ("modal_mass", "kg", "integral of m Y^2 of the shape as normalised"),
    ("shift", "1", "relative change of the frequency by the axial force"),
    ("model_error", "1", "estimated relative effect of shear and rotary inertia"),
    ("effect_of_shear", "1", "relative effect of shear and rotary inertia, solved"),
)
"""Numbers of a mode by their attributes, with unit and meaning."""


def modal_dataset(
    modes: Sequence[Any], x: Array, families: Iterable[FamilyName], attributes: Mapping[str, Any]
) -> xarray.Dataset:
    """Return modes as a Dataset over modes and position.

    Parameters
    ----------
    modes : sequence
        Of `Mode`, for all that it has beside the `SCALARS`.
    x : array, shape (points,)
        Where the states are given [m].
    families : iterable
        Whose quantities it has.
    attributes : mapping
        Of the Dataset.

    Raises
    ------
    InputError
        If xarray is not installed.
    """
    xr = import_extra("xarray", "dataset")
    data = {**_numbers(modes), **_certificates(modes), **_shapes(modes, len(x), families)}
    coordinates = {
        "mode": [m.name for m in modes],
        "x": ("x", x, {"units": "m", "long_name": "position from the left end (nose)"}),
        "bound": ["low", "high"],
    }
    dataset: xarray.Dataset = xr.Dataset(data, coordinates, attrs=dict(attributes))
    return dataset


def _numbers(modes: Sequence[Any]) -> dict[str, Any]:
    return {
        name: (
            "mode",
            [_number(getattr(mode, name)) for mode in modes],
            {"units": unit, "long_name": text},
        )
        for name, unit, text in SCALARS
    }


def _certificates(modes: Sequence[Any]) -> dict[str, Any]:
    """Return what each mode is, and what encloses it."""
    return {
        "family": ("mode", [m.family for m in modes]),
        "number": ("mode", [m.number for m in modes], {"long_name": "0 for rigid modes"}),
        "kind": ("mode", [m.kind for m in modes]),
        "bracket_omega2": (
            ("mode", "bound"),
            [m.bracket_omega2 for m in modes],
            {"units": "rad^2/s^2", "long_name": "encloses the eigenvalue of the segment chain"},
        ),
        "counts": (
            ("mode", "bound"),
            [m.counts for m in modes],
            {"units": "1", "long_name": "eigenvalues below either end of the bracket"},
        ),
    }


def _shapes(modes: Sequence[Any], points: int, families: Iterable[FamilyName]) -> dict[str, Any]:
    """Return every component of the states along x; NaN in modes of another family."""
    none = np.full(points, np.nan)
    return {
        symbol: (
            ("mode", "x"),
            np.array([m.states[:, i] if m.family == family else none for m in modes]),
            {"units": unit, "long_name": text},
        )
        for family in families
        for i, (symbol, unit, text) in enumerate(FAMILIES[family].quantities)
    }


def _number(value: float | None) -> float:
    return math.nan if value is None else value
