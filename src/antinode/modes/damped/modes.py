"""Complex modes of a family with names, kinds, shapes and left eigenvectors."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.arrays import Array, Complex, Numbers
from antinode.beam.beam import Beam
from antinode.beam.families import FAMILIES, FamilyName
from antinode.modes.backends import Backend
from antinode.modes.result import Kind, Mode, Normalisation, Solution
from antinode.modes.rigid import centre_of_mass, rigid_rotation, rotary_inertia
from antinode.modes.shapes import (
    can_estimate,
    model_error_sums,
)
from antinode.riccati.chain import Chain
from antinode.riccati.damped.chain import Damped, adjoint_chain
from antinode.riccati.damped.energies import Products, products
from antinode.riccati.damped.shapes import complex_states
from antinode.riccati.normalised import normalising_factors, states_at
from antinode.riccati.shapes import Energies, split_for

from .family import DampedFamily, solve_damped
from .rest import AtRest, of_motions, rate_matrix


@dataclass(frozen=True)
class DampedModes:
    """Modes of one family, and what stands beside them."""

    modes: list[Mode]
    solution: Solution
    segments: int
    warnings: list[str]
    certificate: Mapping[str, Any]


def damped_modes(
    beam: Beam,
    family: FamilyName,
    modes: int,
    tolerance: float,
    backend: Backend,
    grid: Array,
    normalisation: Normalisation,
    *,
    lossy: bool,
) -> DampedModes:
    """Solve a family: rigid modes at rest, then all others by abs(Im s), then Re s."""
    solved = solve_damped(beam, family, modes, tolerance, backend, lossy=lossy)
    names = names_in(beam, solved)
    keep = shown(solved, modes)
    shapes = _Shapes(beam, solved, keep, grid, normalisation)
    found = [
        _mode(solved, family, k, names[k], shapes, row)
        for row, k in enumerate(keep, len(shapes.rigid))
    ]
    rigid = [_at_rest(family, name, shapes, row) for row, name in enumerate(shapes.rigid)]
    solution = Solution(shapes.chain, shapes.omega2, shapes.states)
    return DampedModes(
        [*rigid, *found],
        solution,
        len(solved.damped.chain.length),
        solved.warnings,
        solved.certificate,
    )


def shown(solved: DampedFamily, modes: int) -> list[int]:
    """Return which eigenvalues are shown: real ones, and so many that oscillate."""
    kept, oscillating = [], 0
    for k, value in enumerate(solved.eigenvalues):
        oscillating += value.s.imag > 0
        if value.s.imag == 0 or oscillating <= modes:
            kept.append(k)
    return kept


def names_in(beam: Beam, solved: DampedFamily) -> list[tuple[str, int]]:
    """Return name and number of each eigenvalue; a rotation that N moved off zero has number 0."""
    family = solved.damped.chain.law.name
    s = [value.s for value in solved.eigenvalues]
    names: dict[int, str] = {}
    for expected in _rotation(solved):
        rest = [k for k in range(len(s)) if k not in names]
        if not rest:
            break
        k = min(rest, key=lambda k: abs(s[k] - expected))
        names[k] = f"rigid {FAMILIES[family].rigid[-1]}"
    real = [k for k in names if s[k].imag == 0]
    if len(real) > 1:  # one of both grows, or less fast
        names[min(real, key=lambda k: s[k].real)] += " (decay)"
    elif len(names) > 1:
        names = {real[0]: names[real[0]]} if real else dict([*names.items()][:1])
    numbered, named = 0, []
    for k in range(len(s)):
        numbered += k not in names
        named.append((names[k], 0) if k in names else (f"{family} {numbered}", numbered))
    return named


def _rotation(solved: DampedFamily) -> list[complex]:
    """Return s of a rotation that the axial force moves off zero, as of a rigid body.

    The roots of ``J s^2 + c s + J omega^2``, the one with Im s > 0 of a pair.
    """
    rest, chain = solved.rest, solved.damped.chain
    if len(rest.free) == len(rest.motions) or not chain.law.has_axial_force:
        return []
    held = len(rest.free) == 1 and rest.free[0, 1] != 0
    about = float(-rest.free[0, 0] / rest.free[0, 1]) if held else centre_of_mass(chain)
    turning = np.array([[-about, 1.0]])
    c = sum(
        (
            float((of_motions(turning, x) @ rate_matrix(p) @ of_motions(turning, x).T)[0, 0])
            for p, x in zip(chain.points, (chain.nodes[p.node] for p in chain.points), strict=True)
        ),
        0.0,
    )
    half = c / rotary_inertia(chain, about) / 2
    root = cmath.sqrt(half * half - rigid_rotation(chain, about))
    return [-half + root] if root.imag else [-half + root, -half - root]


class _Shapes:
    """States of the modes that are shown, those at rest first."""

    def __init__(
        self,
        beam: Beam,
        solved: DampedFamily,
        keep: list[int],
        grid: Array,
        normalisation: Normalisation,
    ) -> None:
        places = grid - grid[0]
        chain = solved.damped.chain.cut_at(places[np.append(True, places[1:] > places[:-1])])
        self.s: Complex = np.array([solved.eigenvalues[k].s for k in keep], dtype=complex)
        chain = split_for(chain, np.append(np.abs(self.s) ** 2, 0.0))
        damped, self.chain = _on(solved.damped, chain)
        self.rigid = _rigid_names(solved.rest, chain)
        states, left, self.residual, forms = _right_and_left(damped, self.chain, self.s)
        mass = np.zeros(0) if forms is None else forms.size
        self.effect = _effect_of_shear(beam, self.chain, self.s, forms)
        rigid = _rigid_states(solved.rest, chain)
        self.omega2: Numbers = np.concatenate([np.zeros(rigid.shape[1]), -self.s * self.s])
        resting: Numbers = rigid.astype(complex)
        if number := rigid.shape[1]:
            zero = np.zeros(number, complex)
            of_rigid = products(damped, self.chain, zero, resting, resting)
            mass = np.concatenate([of_rigid.size, mass])
            self.residual = np.concatenate([zero.real, self.residual])
        self.states: Numbers = np.concatenate([resting, states], axis=1)
        self.left: Numbers = np.concatenate([resting, left], axis=1)
        scale: Numbers = normalising_factors(
            self.chain, self.states, self.omega2, mass, normalisation == "mass"
        )
        self.states *= scale[:, None]
        self.left[:, number:] /= scale[number:, None]
        self.mass = mass * np.abs(scale) ** 2
        self.at_grid: Numbers = states_at(self.chain, self.states, self.omega2, places)
        self.left_at_grid: Numbers = self._left_at_grid(damped, places)

    def _left_at_grid(self, damped: Damped, places: Array) -> Numbers:
        """Return left states at places: multiples of the right ones where the problem allows it."""
        if damped.is_symmetric:
            largest = np.argmax(np.abs(self.states[..., 0]), axis=0)
            lane = np.arange(len(largest))
            share = self.left[largest, lane, 0] / self.states[largest, lane, 0]
            return np.asarray(self.at_grid * share[:, None])
        adjoint = adjoint_chain(self.chain)
        return states_at(adjoint, self.left, self.omega2, places)


def _on(damped: Damped, chain: Chain) -> tuple[Damped, Chain]:
    """Return what acts on a finer chain, and that chain with its columns as they lose energy."""
    if chain is damped.chain and damped.columns is None:
        return damped, chain
    if damped.columns is None:
        return replace(damped, chain=chain), chain
    middle = (chain.nodes[1:] + chain.nodes[:-1]) / 2
    owner = np.searchsorted(damped.chain.nodes, middle) - 1
    columns = {name: values[owner] for name, values in damped.columns.items()}
    return replace(damped, chain=chain, columns=columns), replace(chain, columns=columns)


def _right_and_left(
    damped: Damped, chain: Chain, s: Complex
) -> tuple[Complex, Complex, Array, Products | None]:
    """Return right and left states, with ``w^T (2 s M + C) v = 1``, residuals and forms."""
    shape = (len(chain.length) + 1, len(s), chain.law.size)
    if not len(s):
        return np.zeros(shape, complex), np.zeros(shape, complex), np.zeros(0), None
    right = complex_states(damped, s)
    left = right if damped.is_symmetric else complex_states(damped.transposed, s)
    forms: Products = products(damped, chain, s, right, left)
    along = 2 * s * forms.mass + forms.damping
    with np.errstate(all="ignore"):
        off = s * s * forms.mass + s * forms.damping + forms.stiffness
        residual = np.abs(off / along / s)
        left = left / along[:, None]
    return right, left, residual, forms


def _effect_of_shear(beam: Beam, chain: Chain, s: Complex, forms: Products | None) -> Array:
    """Return the estimated effect of shear and rotary inertia on each frequency; NaN if unknown.

    With the products of left and right eigenvectors, over ``w^T (M + C/(2 s)) v``, the estimate
    takes ``-s^2`` for omega^2; of the s that follows the imaginary part counts.
    """
    if forms is None or not can_estimate(beam, chain.family):
        return np.full(len(s), np.nan)
    with np.errstate(all="ignore"):
        mass: Numbers = forms.mass + forms.damping / (2 * s)
        energies = Energies(forms.squares, mass, forms.stiffness, np.abs(mass))
        parts = model_error_sums(beam, chain, energies)
        moved = s * np.sqrt(parts.ratio(-s * s).astype(complex))
        return np.where(s.imag > 0, moved.imag / s.imag - 1, np.nan)


def _rigid_names(rest: AtRest, chain: Chain) -> list[str]:
    words = FAMILIES[chain.law.name].rigid
    if len(rest.motions) == 2:
        return [f"rigid {word}" for word in words]
    return [f"rigid {words[0 if not row[1] else -1]}" for row in rest.motions]


def _rigid_states(rest: AtRest, chain: Chain) -> Array:
    """Return the states of motions at rest, shape (n + 1, number, c)."""
    motions = rest.motions
    if len(motions) == 2:
        motions = np.array([[1.0, 0.0], [-centre_of_mass(chain), 1.0]])
    states = np.zeros((len(chain.nodes), len(motions), chain.law.size))
    for k, (a, b) in enumerate(motions):
        states[:, k, 0] = a + b * chain.nodes
        if b:
            states[:, k, 1] = b
    return states


def _at_rest(family: FamilyName, name: str, shapes: _Shapes, row: int) -> Mode:
    """Return a rigid mode at s = 0."""
    return Mode(
        family=family,
        number=0,
        name=name,
        kind="rigid",
        omega2=0.0,
        bracket_omega2=(0.0, 0.0),
        counts=(-1, -1),
        error_omega2=0.0,
        modal_mass=float(shapes.mass[row]),
        residual=0.0,
        model_error=None,
        states=shapes.at_grid[:, row].real,
        eigenvalue=0j,
        error_per_s=0.0,
        phasors=shapes.at_grid[:, row],
        left=shapes.left_at_grid[:, row],
    )


def _mode(
    solved: DampedFamily,
    family: FamilyName,
    k: int,
    named: tuple[str, int],
    shapes: _Shapes,
    row: int,
) -> Mode:
    s, error = solved.eigenvalues[k].s, float(solved.error[k])
    omega2 = -(s.real**2) if s.imag == 0 and s.real > 0 else s.imag**2
    low, high = _bracket(s, error)
    effect = float(shapes.effect[row - len(shapes.rigid)])
    return Mode(
        family=family,
        number=named[1],
        name=named[0],
        kind=kind_of(s, error),
        omega2=omega2,
        bracket_omega2=(low, high),
        counts=(-1, -1),
        error_omega2=max(high - omega2, omega2 - low),
        modal_mass=float(shapes.mass[row]),
        residual=float(shapes.residual[row]),
        model_error=None if math.isnan(effect) else effect,
        states=shapes.at_grid[:, row].real,
        growth=0.0 if omega2 < 0 else s.real,
        eigenvalue=s,
        error_per_s=error,
        phasors=shapes.at_grid[:, row],
        left=shapes.left_at_grid[:, row],
    )


def kind_of(s: complex, error: float) -> Kind:
    """Return what a motion with a damped or growing exponential is."""
    if s.imag == 0:
        return "divergent" if s.real > 0 else "overdamped"
    return "flutter" if s.real > error else "elastic"


def _bracket(s: complex, error: float) -> tuple[float, float]:
    """Return what encloses (Im s)^2, or -s^2 of a motion that grows alone."""
    if math.isinf(error):
        return -math.inf, math.inf
    if s.imag == 0 and s.real > 0:
        return -((s.real + error) ** 2), -(max(s.real - error, 0.0) ** 2)
    return max(s.imag - error, 0.0) ** 2, (s.imag + error) ** 2
