"""All figures of the reproduction in their order."""

from __future__ import annotations

from . import difference_figure, mode_figures, vehicle_figures
from .plates import Plate

PLATES = (
    Plate("differences", "Differences", difference_figure.differences),
    Plate("figure_03_vehicle", "Figure 3", vehicle_figures.vehicle),
    Plate("figure_04_mass", "Figure 4", vehicle_figures.mass),
    Plate("figure_05_axial_stiffness", "Figure 5", vehicle_figures.axial_stiffness),
    Plate("figure_06_bending_stiffness", "Figure 6", vehicle_figures.bending_stiffness),
    Plate("figure_07_cavity", "Figure 7", vehicle_figures.cavities),
    Plate("figure_08_axial_force", "Figure 8", vehicle_figures.axial_forces),
    Plate("figure_09_characteristic", "Figure 9", mode_figures.characteristic),
    Plate("figure_10_modes_x", "Figure 10", mode_figures.shapes_x),
    Plate("figure_11_modes_y", "Figure 11", mode_figures.shapes_y),
    Plate("figure_12_modes_theta", "Figure 12", mode_figures.shapes_theta),
    Plate("figure_13_force_x", "Figure 13", mode_figures.forces_x),
    Plate("figure_14_force_y", "Figure 14", mode_figures.forces_y),
    Plate("figure_15_moment", "Figure 15", mode_figures.moments),
    Plate("figure_16_mass_states", "Figure 16", vehicle_figures.mass_states),
    Plate("figure_17_axial_force_states", "Figure 17", vehicle_figures.axial_forces_in_time),
)
"""The differences, then Figures 3 to 17, numbered as in the paper; Figure 3 takes in Figure 1."""
