"""The loads of a case as plain numbers with units in the keys: for JSON, CSV and NetCDF."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING, Any

import numpy as np

from antinode.extras import import_extra
from antinode.version import __version__

if TYPE_CHECKING:
    import xarray

    from antinode.modes.result import ModalResult
    from antinode.vehicle.case import Case

_COLUMNS = (
    ("x", "m", "position from the nose"),
    ("N", "N", "axial force, compression positive"),
    ("Q", "N", "static shear force"),
    ("M", "N m", "static bending moment, EI Y''"),
    ("u_Y", "m", "static lateral deflection, up, relative to the mean axis"),
    ("u_X", "m", "static axial displacement, aft, relative to the nose"),
)


def internal_forces(case: Case, points: int = 201) -> dict[str, np.ndarray]:
    """Return N, Q, M and the static displacements along the body, jumps with both sides.

    Parameters
    ----------
    case : Case
    points : int
        Number of evenly spaced positions, beside the breakpoints.

    Returns
    -------
    dict
        Arrays ``x`` [m], ``N`` [N], ``Q`` [N], ``M`` [N m], ``u_Y`` and ``u_X`` [m] of equal
        length; Q and M are those of the straight body.
    """
    from antinode.vehicle.statics import static_shape

    loads = case.loads
    x = np.unique(np.concatenate([np.linspace(0, case.vehicle.length, points), loads.breakpoints]))
    sides = [(loads.axial_force(x, side), loads.shear_force(x, side)) for side in ("left", "right")]
    (N0, Q0), (N1, Q1) = sides
    keep = np.ones(2 * len(x), dtype=bool)
    keep[1::2] = (N0 != N1) | (Q0 != Q1)

    def both(left: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.asarray(np.stack([left, right], axis=1).ravel()[keep])

    M, shape = loads.bending_moment(x), static_shape(case)
    u_Y, u_X = (np.interp(x, shape.x, u) for u in (shape.lateral, shape.axial))
    smooth = {name: both(v, v) for name, v in (("x", x), ("M", M), ("u_Y", u_Y), ("u_X", u_X))}
    return {**smooth, "N": both(N0, N1), "Q": both(Q0, Q1)}


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
        "thrust_N": loads.thrust,
        "weight_N": loads.weight,
        "mass_kg": loads.mass,
        "centre_of_mass_m": loads.x_M,
        "moment_of_inertia_kg_m2": loads.inertia,
        "acceleration_forward_m_per_s2": loads.a_X,
        "acceleration_up_m_per_s2": loads.a_Y,
        "angular_acceleration_nose_up_rad_per_s2": loads.beta,
        "axial_force_nose_N": float(N[0]),
        "axial_force_tail_N": float(N[1]),
        "checks": loads.checks._asdict(),
    }


def modes_dict(case: Case, result: ModalResult) -> dict[str, Any]:
    """Return modes of a vehicle as plain numbers for JSON, with its condition, loads, warnings."""
    data = result.to_dict()
    data["condition"], data["loads"] = condition_dict(case), loads_summary(case)
    data["warnings"] = [*case.loads.warnings, *data["warnings"]]
    return data


def loads_dict(case: Case) -> dict[str, Any]:
    """Return all that is known of the loads as plain numbers for JSON, units in the keys."""
    loads, planing = case.loads, case.loads.planing
    table = internal_forces(case)
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
        "validity": [row._asdict() for row in loads.validity],
        "warnings": list(loads.warnings),
    }


def loads_csv(case: Case) -> str:
    """Return N, Q, M along the body as CSV with units in the header."""
    table, out = internal_forces(case), io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([f"{name} [{unit}]" for name, unit, _ in _COLUMNS])
    writer.writerows(
        [repr(float(v)) for v in row]
        for row in zip(*(table[name] for name, *_ in _COLUMNS), strict=True)
    )
    return out.getvalue()


def loads_dataset(case: Case) -> xarray.Dataset:
    """Return N, Q, M along the body as a Dataset with units, forces and checks in its attrs."""
    xr = import_extra("xarray", "dataset")
    table = internal_forces(case)
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
        "warnings": "\n".join(loads.warnings),
    }
    dataset: xarray.Dataset = xr.Dataset(data, attrs=attributes)
    return dataset
