"""The loads of a case as plain numbers with units in the keys: for JSON, CSV and NetCDF."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.beam.plausible import doubts
from antinode.extras import import_extra
from antinode.vehicle.end_forces import compare_end_forces
from antinode.vehicle.statics import deflection_warnings
from antinode.version import __version__

from .water import water_dict

if TYPE_CHECKING:
    import xarray

    from antinode.modes.result import ModalResult
    from antinode.vehicle.case import Case
    from antinode.vehicle.statics import StaticShape

_COLUMNS = (
    ("x", "m", "position from the nose"),
    ("N", "N", "axial force, compression positive"),
    ("Q", "N", "static shear force"),
    ("M", "N m", "static bending moment of the loads on the straight body"),
    ("M_bent", "N m", "static bending moment EI u'', with the axial force on the bent axis"),
    ("u_Y", "m", "static lateral deflection, up, relative to the mean axis"),
    ("u_X", "m", "static axial displacement, aft, relative to the nose"),
)


def internal_forces(case: Case, shape: StaticShape, points: int = 201) -> dict[str, np.ndarray]:
    """Return N, Q, M and the static displacements along the body, jumps with both sides.

    Parameters
    ----------
    case : Case
    shape : StaticShape
        Its static displacements.
    points : int
        Number of evenly spaced positions, beside the breakpoints.

    Returns
    -------
    dict
        Arrays ``x`` [m], ``N`` [N], ``Q`` [N], ``M`` and ``M_bent`` [N m], ``u_Y`` and ``u_X`` [m]
        of equal length; Q and M are those of the straight body, M_bent is EI u''.
    """
    loads = case.loads
    x = np.unique(np.concatenate([np.linspace(0, case.vehicle.length, points), loads.breakpoints]))
    sides = [(loads.axial_force(x, side), loads.shear_force(x, side)) for side in ("left", "right")]
    (N0, Q0), (N1, Q1) = sides
    keep = np.ones(2 * len(x), dtype=bool)
    keep[1::2] = (N0 != N1) | (Q0 != Q1)

    def both(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.asarray(np.stack([left, right], axis=1).ravel()[keep])

    smooth = {"x": x, "M": loads.bending_moment(x), **bent(shape, x)}
    whole = {name: both(v, v) for name, v in smooth.items()}
    return {**whole, "N": both(N0, N1), "Q": both(Q0, Q1)}


def bent(shape: StaticShape, x: np.ndarray) -> dict[str, np.ndarray]:
    """Return ``M_bent`` [N m], ``u_Y`` and ``u_X`` [m] of a static shape at `x` [m]."""
    table = {"M_bent": shape.moment, "u_Y": shape.lateral, "u_X": shape.axial}
    return {name: np.interp(x, shape.x, values) for name, values in table.items()}


HEADINGS = ("x [m]", "N [kN]", "Q [kN]", "M [kN m]", "EI u'' [kN m]", "u_Y [mm]", "u_X [mm]")
"""Of the table of internal forces."""
BRIEF_HEADINGS = ("x [m]", "N [kN]", "Q [kN]", "M [kNm]", "EI u''", "u_Y [mm]", "u_X [mm]")
"""The same for a narrow terminal; EI u'' has the unit of M."""
EXPLANATION = "M: of the loads on the straight body. EI u'': with N on the bent one. "
"""What the two moments are."""


def internal_rows(case: Case, shape: StaticShape, rows: int) -> np.ndarray:
    """Return the table of internal forces at even positions, in the units of the headings."""
    loads, x = case.loads, np.linspace(0, case.vehicle.length, rows)
    forces = (loads.axial_force(x), loads.shear_force(x), loads.bending_moment(x))
    M_bent, u_Y, u_X = bent(shape, x).values()
    thousand = (*(force / 1e3 for force in forces), M_bent / 1e3, u_Y * 1e3, u_X * 1e3)
    return np.stack([x, *thousand], axis=1)


def loads_warnings(case: Case, shape: StaticShape) -> list[str]:
    """Return all that is doubtful about the loads, the static deflection and the beam."""
    return [*doubts(case.beam()), *case.loads.warnings, *deflection_warnings(case, shape)]


def condition_dict(case: Case) -> dict[str, Any]:
    """Return the condition with its units in the keys."""
    units = {
        "speed": "m_per_s",
        "depth": "m",
        "cavity_pressure": "Pa",
        "cavitator_angle": "rad",
        "body_angle": "rad",
        "fin_position": "m",
        "thrust": "N",
        "extra_drag": "N",
        "extra_drag_position": "m",
    }
    values = case.condition.model_dump()
    named = {f"{key}_{units[key]}" if key in units else key: v for key, v in values.items()}
    return {**named, "cavitation_number": case.loads.sigma}


def loads_summary(case: Case) -> dict[str, Any]:
    """Return forces, accelerations, N at both ends and checks as plain numbers for JSON."""
    loads = case.loads
    N = loads.axial_force([0.0, case.vehicle.length])
    return {
        "cavitation_number": loads.sigma,
        "cavity": {"length_m": loads.cavity.L_c, "largest_diameter_m": loads.cavity.D_c},
        "forces": [
            {"name": f.name, "x_m": f.x, "drag_N": f.F_X, "lift_N": f.F_Y} for f in loads.forces
        ],
        "drag_N": loads.drag,
        "thrust_N": loads.thrust,
        "weight_N": loads.weight,
        "mass_kg": loads.mass,
        "centre_of_mass_m": loads.x_M,
        "moment_of_inertia_kg_m2": loads.inertia,
        "acceleration_forward_m_per_s2": loads.a_X,
        "acceleration_up_m_per_s2": loads.a_Y,
        "angular_acceleration_nose_up_rad_per_s2": loads.beta,
        "in_balance": loads.is_balanced,
        "axial_force_nose_N": float(N[0]),
        "axial_force_tail_N": float(N[1]),
        "checks": loads.checks._asdict(),
    }


def modes_dict(case: Case, result: ModalResult) -> dict[str, Any]:
    """Return modes of a vehicle as plain numbers for JSON, with its condition, loads, warnings."""
    data = result.to_dict()
    data["condition"], data["loads"] = condition_dict(case), loads_summary(case)
    data["warnings"] = [*case.loads.warnings, *data["warnings"]]
    data["notes"] = list(case.notes)
    data["end_forces"] = [choice.to_dict() for choice in compare_end_forces(case, result)]
    data["water"] = water_dict(case, result)
    return data


def loads_dict(case: Case, shape: StaticShape) -> dict[str, Any]:
    """Return all that is known of the loads as plain numbers for JSON, units in the keys."""
    loads, planing = case.loads, case.loads.planing
    table = internal_forces(case, shape)
    return {
        "schema_version": 1,
        "name": case.vehicle.name,
        **loads_summary(case),
        "cavity_pressure_Pa": loads.cavity_pressure,
        "depth_m": loads.depth,
        "fins": [{"x_m": f.position, "immersion_m": list(f.immersion)} for f in loads.fins],
        "planing": {
            "drag_N": planing.F_PX,
            "lift_N": planing.F_PY,
            "x_m": planing.x_P,
            "wetted_length_m": planing.length,
            "wetted_area_m2": planing.area,
            "wetted_all_round": planing.all_round,
        },
        "internal": {
            f"{name}_{unit.replace(' ', '_')}": table[name].tolist() for name, unit, _ in _COLUMNS
        },
        "meanings": {name: text for name, _, text in _COLUMNS},
        "validity": [row._asdict() for row in loads.validity],
        "warnings": loads_warnings(case, shape),
    }


def loads_csv(case: Case, shape: StaticShape) -> str:
    """Return N, Q, M along the body as CSV with units in the header."""
    table, out = internal_forces(case, shape), io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([f"{name} [{unit}]" for name, unit, _ in _COLUMNS])
    writer.writerows(
        [repr(float(v)) for v in row]
        for row in zip(*(table[name] for name, *_ in _COLUMNS), strict=True)
    )
    return out.getvalue()


def loads_dataset(case: Case, shape: StaticShape) -> xarray.Dataset:
    """Return N, Q, M along the body as a Dataset with units, forces and checks in its attrs."""
    xr = import_extra("xarray", "dataset")
    table = internal_forces(case, shape)
    data = {
        name: ("point", table[name], {"units": unit, "long_name": text})
        for name, unit, text in _COLUMNS
    }
    loads = case.loads
    attributes = {
        "title": f"Loads of {case.vehicle.name}",
        "source": f"antinode {__version__}",
        "cavitation_number": loads.sigma,
        "mass_kg": loads.mass,
        "acceleration_forward_m_per_s2": loads.a_X,
        "worst_check": loads.checks.worst,
        "warnings": "\n".join(loads_warnings(case, shape)),
    }
    dataset: xarray.Dataset = xr.Dataset(data, attrs=attributes)
    return dataset
