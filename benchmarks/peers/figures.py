"""What good peers take, and whether those measured do.

The figures came from a machine like the one of REFERENCE when quiet, without a calibration of their
own; REFERENCE stands in for it.
"""

from math import prod

FIGURES = {
    "subspace": 0.25e-3,  # 4,000 a second, warm-started; 0.47 ms cold
    "dense": 2.0e-3,
    "reduced basis": 0.007e-3,
    "hp": 0.82e-3,
    "scikit-fem": 3.2e-3,
    "OpenSeesPy": 7.8e-3,
}
"""One solve each [s]: first six frequencies of a free-free beam of 100 elements (hp: nine)."""

REFERENCE = {"dense eigh, 200 x 200": 4.04e-3, "C loop, 2,000,000 turns": 5.28e-3}
"""Calibration of the machine [s], median of thirty quiet runs."""

SLACK = 1.3


def scale(*calibrations):
    """How many times slower than the reference the machine is: geometric mean over all jobs."""
    ratios = [taken / REFERENCE[name] for one in calibrations for name, taken in one.items()]
    return prod(ratios) ** (1 / len(ratios))


def judge(row, *calibrations):
    """Replace a row's name of a figure by the figure, its scaled limit and whether it is kept."""
    name = row.pop("figure", None)
    if name is not None:
        slower = scale(*calibrations)
        limit = SLACK * FIGURES[name] * slower
        row["peer_figure_s"] = FIGURES[name]
        row["machine_scale"] = float(f"{slower:.3g}")
        row["peer_scaled_limit_s"] = float(f"{limit:.3g}")
        row["peer_within"] = row["peer_s"] <= limit
    return row
