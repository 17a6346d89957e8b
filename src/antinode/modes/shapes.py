"""Shapes of modes on the output grid: named, normalised, with what follows from them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from antinode.arrays import Array, Integers, Numbers
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.beam.sections.shapes import THIN_TUBE
from antinode.riccati.chain import Chain
from antinode.riccati.normalised import Forms, Normalised, Wanted
from antinode.riccati.roots import Eigenvalue
from antinode.riccati.shapes import Energies

from .backends import Backend
from .clusters import are_apart, part
from .following import left_states
from .rigid import rigid_motion, rigid_state

_SLACK = 1e-9  # of a piece: rounding makes no further one


def output_grid(beam: Beam, modes: int) -> Array:
    """Return breakpoints and points between, dense enough for smooth shapes [m]."""
    spacing = beam.length / max(200, 20 * (modes + 2))
    h = beam.x[1:] - beam.x[:-1]
    pieces = np.ceil(h / spacing - _SLACK).astype(int)
    last = pieces.cumsum()
    which = np.arange(len(h)).repeat(pieces)
    number = np.arange(last[-1]) - (last - pieces)[which]
    grid = np.empty(last[-1] + 1)
    grid[:-1], grid[-1] = beam.x[which] + number * (h / pieces)[which], beam.x[-1]
    inner = [item.x for item in beam.attachments if beam.x[0] < item.x < beam.x[-1]]
    doubled = sorted({int(np.argmin(np.abs(beam.x - x))) for x in inner})
    return np.sort(np.append(grid, beam.x[doubled])) if doubled else grid


def normalised_modes(
    solver: Backend,
    beam: Beam,
    chain: Chain,
    eigenvalues: list[Eigenvalue],
    keep: list[int],
    names: list[tuple[str, int]],
    wanted: Wanted,
) -> tuple[Array, Normalised]:
    """Return omega^2 and the kept modes, scaled as asked; rigid ones at omega^2 = 0 are known."""
    omega2 = np.array([eigenvalues[k].value for k in keep])
    still = [c for c, k in enumerate(keep) if eigenvalues[k].omega2 == 0.0 and names[k][1] == 0]
    solved = [eigenvalues[k].omega2 for c, k in enumerate(keep) if c not in still]
    if not chain.follows and are_apart(solved):
        motions = np.full((len(keep), 2), np.nan)
        for c in still:
            motions[c] = rigid_motion(beam, chain, names[keep[c]][0])
        return omega2, solver.normal_modes(chain, omega2, motions, wanted)
    states = shapes(solver, beam, chain, eigenvalues, keep, names)
    left = left_states(solver, chain, states, omega2) if chain.follows else None
    return omega2, solver.normalise(chain, states, omega2, wanted, left)


def shapes(
    solver: Backend,
    beam: Beam,
    chain: Chain,
    eigenvalues: list[Eigenvalue],
    keep: list[int],
    names: list[tuple[str, int]],
) -> Array:
    """Return the states of the kept modes at all nodes; rigid modes at omega^2 = 0 are known.

    Where end forces follow, pairs may be complex, and so are all states then; modes that coincide
    have one shape there.
    """
    values = np.array([eigenvalues[k].value for k in keep])
    free = [c for c, k in enumerate(keep) if eigenvalues[k].omega2 != 0.0 or names[k][1] > 0]
    omega2 = values[free]
    if free and chain.follows:
        found = solver.mode_states(chain, omega2, np.ones(len(free), np.int64))
    elif free:
        brackets = [eigenvalues[keep[c]].bracket for c in free]
        clusters = np.array([brackets.count(bracket) for bracket in brackets])
        found = part(solver, chain, omega2, solver.mode_states(chain, omega2, clusters))
    if len(free) == len(keep):
        return found
    states = np.empty((len(chain.length) + 1, len(keep), chain.law.size), values.dtype)
    for c in set(range(len(keep))) - set(free):
        states[:, c] = rigid_state(beam, chain, names[keep[c]][0])
    if free:
        states[:, free] = found
    return states


class ModelErrorParts(NamedTuple):
    """What shear and rotary inertia would do to a beam that is solved without them.

    With the shapes of that beam, all three over its modal mass,

        K = int EI Y''^2 + springs,   S = int (EI Y''')^2 / kGA,   R = int rho I Y'^2,

    what bends and what shears give way in series, K becomes K/(1 + S/K), sections turn by
    1/(1 + S/K) of the slope, and what the axial force does, W = K - omega^2, stays:

        omega^2 -> (K - W (1 + S/K)) / (1 + S/K + R).

    Without axial force that is ``f -> f / sqrt(1 + R + S/omega^2)``, and to first order
    ``-(R + S/omega^2)/2`` of f with it too. A pinned uniform beam buckles by it at
    ``P_E/(1 + P_E/kGA)`` (Engesser), whatever R is; its frequencies are exact but for a term in
    S R.

    kGA is the beam's own column, or EA/(4 + 3 nu) with nu = 0.3, that of a thin-walled tube
    (Cowper, J. Appl. Mech. 33 (1966) 335): kappa = 0.53. Solid sections have 0.85 to 0.89. rho I
    is the beam's column, or m r^2 with the radius of gyration, or with sqrt(EI/EA).
    """

    rotary: Array
    """R [-]"""
    shear: Array
    """S [rad^2/s^2]"""
    strain: Array
    """K [rad^2/s^2]"""

    def ratio(self, omega2: Numbers) -> Numbers:
        """Return omega^2 with shear and rotary inertia over omega^2; below 0 past buckling."""
        with np.errstate(all="ignore"):
            bent = np.real(self.strain) > 0
            series = 1 + np.where(bent, self.shear / np.where(bent, self.strain, 1.0), 0.0)
            return np.asarray((series - self.shear / omega2) / (series + self.rotary))

    def effect(self, omega2: Array) -> Array:
        """Return the relative effect on the frequencies; NaN where a mode does not vibrate.

        -1 where no frequency is left: the mode is past buckling with shear.
        """
        with np.errstate(all="ignore"):
            effect = np.sqrt(np.maximum(self.ratio(omega2), 0.0)) - 1
        return np.asarray(np.where(omega2 > 0, effect, np.nan))


def can_estimate(beam: Beam, family: FamilyName) -> bool:
    """Tell whether there is something to estimate in a family, and the columns to do it with."""
    known = beam.axial_stiffness is not None or beam.shear_stiffness is not None
    return FAMILIES[family].rotary and known and not beam.has_shear


def model_error_parts(beam: Beam, chain: Chain, energies: Energies) -> ModelErrorParts:
    """Return the share of every segment in R, S and K, shape (n, modes)."""
    EI, kGA, rotary = _columns(beam, chain)
    squares = energies.squares
    parts = (
        rotary[:, None] * squares.turn,
        squares.shear / kGA[:, None],
        squares.moment / EI[:, None],
    )
    return ModelErrorParts(*(part / energies.mass for part in parts))


def _columns(beam: Beam, chain: Chain) -> tuple[Array, Array, Array]:
    """Return EI, kGA and what of rho I is left out, of every segment."""
    middle = (chain.nodes[1:] + chain.nodes[:-1]) / 2 + beam.x[0]
    k: Integers = np.clip(np.searchsorted(beam.x, middle) - 1, 0, len(beam.x) - 2)
    t = (middle - beam.x[k]) / np.diff(beam.x)[k]
    EI, mass = chain.stiffness, beam.column_at("mass_per_length", k, t)
    EA = None if beam.axial_stiffness is None else beam.column_at("axial_stiffness", k, t)
    if beam.shear_stiffness is not None and not beam.is_timoshenko:
        kGA = beam.column_at("shear_stiffness", k, t)
    else:
        kGA = np.full(len(k), np.inf) if EA is None else EA / THIN_TUBE
    if beam.is_timoshenko:
        rotary = np.zeros(len(k))
    elif beam.rotary_inertia_per_length is not None:
        rotary = beam.column_at("rotary_inertia_per_length", k, t)
    elif beam.radius_of_gyration is not None:
        rotary = mass * beam.column_at("radius_of_gyration", k, t) ** 2
    else:
        rotary = np.zeros(len(k)) if EA is None else mass * EI / EA
    return EI, kGA, rotary


def model_error_sums(beam: Beam, chain: Chain, energies: Energies) -> ModelErrorParts:
    """Return R, S and K of whole modes, shape (modes,), springs and joints among K."""
    by_segment = model_error_parts(beam, chain, energies)
    rotary, shear, strain = (part.sum(axis=0) for part in by_segment)
    if chain.points and not chain.follows:
        work = chain.columns["axial_force"] @ energies.squares.turn
        strain = (energies.stiffness + work) / energies.mass
    return ModelErrorParts(rotary, shear, strain)


def estimate_model_errors(
    beam: Beam, chain: Chain, omega2: Array, energies: Energies
) -> list[float | None]:
    """Return the estimated effect of rotary inertia and shear on each frequency, relative."""
    if not can_estimate(beam, chain.family):
        return [None] * len(omega2)
    return _effects(model_error_sums(beam, chain, energies), omega2)


def left_out(beam: Beam, chain: Chain) -> Array:
    """Return rho I [kg m] and 1/kGA [1/N] that a chain leaves out, if known, shape (2, n)."""
    if not can_estimate(beam, chain.family):
        return np.zeros((2, len(chain.length)))
    _, kGA, rotary = _columns(beam, chain)
    return np.array([rotary, 1 / kGA])


def model_errors_of(beam: Beam, chain: Chain, omega2: Array, forms: Forms) -> list[float | None]:
    """Return the same as `estimate_model_errors` from the forms of what is left out."""
    if not can_estimate(beam, chain.family):
        return [None] * len(omega2)
    parts = forms.rotary, forms.shear, forms.strain
    return _effects(ModelErrorParts(*(part / forms.mass for part in parts)), omega2)


def _effects(sums: ModelErrorParts, omega2: Array) -> list[float | None]:
    vibrates = np.imag(omega2) == 0  # one that flutters is no estimate of one frequency
    real = ModelErrorParts(*(np.real(part) for part in sums))
    effect = np.where(vibrates, real.effect(np.real(omega2)), np.nan)
    return [None if np.isnan(e) else e for e in effect.tolist()]
