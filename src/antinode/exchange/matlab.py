"""Modes as a MATLAB file (.mat, version 5): plain arrays, SI, one column a mode.

NaN stands where a family has no such component, and for the frequency of a divergent mode.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from antinode.beam.families import FAMILIES
from antinode.modes.result import ModalResult

from .tabulated import tabulate

SCALARS = (
    "frequency_hz",
    "error_hz",
    "omega2",
    "error_omega2",
    "growth_rate_per_s",
    "modal_mass",
    "shift",
)
"""One number a mode, each a row vector."""


def write_mat(path: Path, result: ModalResult) -> tuple[str, ...]:
    """Write modes, shapes and stations.

    Parameters
    ----------
    path : Path
    result : ModalResult

    Returns
    -------
    tuple of str
        What the file does not hold exactly.
    """
    from scipy.io import savemat

    stations = tabulate(result.beam)
    savemat(
        path,
        mat_variables(result) | {"stations": dict(stations.columns)},
        appendmat=False,
        long_field_names=True,
    )
    return stations.notes


def mat_variables(result: ModalResult) -> dict[str, Any]:
    """Return the variables of the file by name, without the stations."""
    modes = result.modes
    variables: dict[str, Any] = {"beam_name": result.beam.name, "x": result.x[:, None]}
    variables["theory"] = "timoshenko" if result.beam.is_timoshenko else "euler_bernoulli"
    variables["shear_form"] = result.beam.shear_form
    for key in ("name", "family", "kind"):
        variables[f"mode_{key}"] = np.array([getattr(m, key) for m in modes], dtype=object)
    variables["mode_number"] = np.array([float(m.number) for m in modes])
    for key in SCALARS:
        variables[key] = np.array([float(getattr(m, key)) for m in modes])
    variables["bracket_omega2"] = np.array([m.bracket_omega2 for m in modes]).T
    for family in result.families:
        for index, (symbol, _, _) in enumerate(FAMILIES[family].quantities):
            columns = [
                m.states[:, index] if m.family == family else np.full(len(result.x), np.nan)
                for m in modes
            ]
            variables[symbol] = np.stack(columns, axis=1)
    return variables
