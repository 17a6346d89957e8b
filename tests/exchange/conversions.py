"""Beams to convert, and how far two beams are apart."""

from dataclasses import replace
from functools import cache
from importlib.resources import files
from pathlib import Path

import numpy as np

from antinode import load_beam, load_case, solve_modes
from antinode.beam.attachments import Joint, PointMass, Spring
from antinode.beam.beam import Beam
from antinode.beam.ends import Ends

EXAMPLES = ("starter", "beam", "tower", "rocket", "drill_string", "shaft")


def example(name):
    """The beam of an example."""
    folder = Path(str(files("antinode.examples") / name))
    case = folder / "case.toml"
    return load_case(case).beam() if case.exists() else load_beam(folder / "beam.toml").beam()


def everything():
    """A beam that has one of everything, in compression."""
    x = [0.0, 1.0, 2.5, 4.0]
    beam = Beam.from_stations(
        x, [8.0, 6, 9, 9], [4e4, 5e4, 3e4, 3e4], [2e7, 2e7, 1e7, 1e7], [900.0, 400, 700, 0],
        ends=Ends("pinned", "sliding", "fixed", "free"), name="one of everything",
    )  # fmt: skip
    return beam.with_attachments(
        PointMass(0.7, 3.0, 0.02, 0.1),
        PointMass(4.0, 5.0),
        Spring(1.9, 2e4, 3e3, 1e5),
        Spring(3.1, translational=np.inf),
        Joint(2.2, 2e-5, 3e-8),
    )


@cache
def solved(name, modes=3):
    """Modes of an example."""
    beam = everything() if name == "everything" else example(name)
    return solve_modes(beam, modes, tolerance=1e-7, unloaded=True)


def without_shear(name, modes=3):
    """Modes of an example by Euler and Bernoulli, as elements without shear find them."""
    beam = replace(example(name), theory=None, shear_stiffness=None, rotary_inertia_per_length=None)
    return solve_modes(beam, modes, tolerance=1e-7, unloaded=True)


def eigenvalues(beam, modes=3):
    """All omega^2 of a beam [rad^2/s^2], bending first."""
    return np.array([mode.omega2 for mode in solve_modes(beam, modes, tolerance=1e-7).modes])


def difference(beam, name, modes=3):
    """Largest difference of the eigenvalues from those of an example, in its third one."""
    wanted = np.array([mode.omega2 for mode in solved(name, modes).modes])
    got = eigenvalues(beam, modes)
    assert got.shape == wanted.shape
    scale = np.maximum(np.abs(wanted), solved(name, modes).mode("bending", 1).omega2)
    return float(np.max(np.abs(got - wanted) / np.abs(scale)))
