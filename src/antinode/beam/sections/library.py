"""Sections of any outline, from `sectionproperties` (an extra).

from sectionproperties.pre.library import i_section
profile = i_section(d=0.2, b=0.1, t_f=0.0085, t_w=0.0056, r=0.012, n_r=8)
beam = drawn_beam([0, 6], steel, **properties_of(profile.create_mesh(2e-5)))
"""

from __future__ import annotations

from typing import Any

from antinode.errors import InputError
from antinode.extras import import_extra


def properties_of(section: Any) -> dict[str, float]:
    """Return what `drawn_beam` wants of a section, in metres.

    Parameters
    ----------
    section : sectionproperties Section, or a Geometry with its mesh
        Of one material, drawn in metres; its y axis is Y, in which the beam bends.

    Returns
    -------
    dict
        `area` [m^2], `second_moment` about the centroid's axis across Y, `polar_moment`,
        `torsion_constant` [m^4], and `shear_area` along Y [m^2].

    Raises
    ------
    InputError
        If sectionproperties is not installed, or the section has several materials, or no mesh.
    """
    if hasattr(section, "create_mesh"):
        section = _meshed(section)
    try:
        section.calculate_geometric_properties()
        section.calculate_warping_properties()
        I, across, _ = map(float, section.get_ic())  # noqa: E741
        return {
            "area": float(section.get_area()),
            "second_moment": I,
            "shear_area": float(section.get_as()[1]),
            "polar_moment": I + across,
            "torsion_constant": float(section.get_j()),
        }
    except (RuntimeError, AssertionError) as error:
        raise InputError(
            f"sectionproperties: {error}; a section of one material is wanted, whole and meshed"
        ) from error


def _meshed(geometry: Any) -> Any:
    analysis = import_extra("sectionproperties.analysis", "sections")
    if getattr(geometry, "mesh", None) is None:
        raise InputError("the geometry has no mesh: call its create_mesh with a size first")
    return analysis.Section(geometry)
