"""Complex modes of a family of a beam: eigenvalues s, refined until they meet the tolerance.

Dashpots, feedback, end forces that turn and, where it is asked for, loss factors. The list is that
of a circle about s = 0, and proven where the turns of the characteristic function around it, and
around every eigenvalue, say so (`riccati.damped`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from antinode.arrays import Array, Complex
from antinode.beam.attachments import refuse_pedestals
from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FamilyName
from antinode.beam.representation import make_chain
from antinode.errors import ComputationError
from antinode.modes.backends import Backend
from antinode.modes.refinement import layer_length, varying_segments
from antinode.riccati.chain import Chain
from antinode.riccati.convergence import extrapolate
from antinode.riccati.damped.chain import Damped
from antinode.riccati.damped.loss import with_loss
from antinode.riccati.damped.roots import ComplexEigenvalue, ComplexRoots, Finder
from antinode.riccati.damped.turning import TurningFinder
from antinode.riccati.roots import CountingError, Eigenvalue

from .rest import AtRest, at_rest

_MOST_SEGMENTS = 20_000
NOT_PROVEN = (
    "that no mode is missing is not proven here: what damps, feeds back or follows is too large "
    "beside the stiffness; compare with fewer or more modes"
)


@dataclass(frozen=True)
class DampedFamily:
    """Complex eigenvalues of one family on the finest chain."""

    damped: Damped
    eigenvalues: list[ComplexEigenvalue]
    """But those at rest: s = 0."""
    error: Array
    """Of s, all told [1/s]."""
    rest: AtRest
    warnings: list[str]
    certificate: Mapping[str, Any]
    """As JSON has it."""


def solve_damped(
    beam: Beam, family: FamilyName, modes: int, tolerance: float, backend: Backend, *, lossy: bool
) -> DampedFamily:
    """Find the complex eigenvalues of a family: all in a circle that holds `modes` that oscillate.

    Parameters
    ----------
    lossy : bool
        Whether the beam's loss factors count.
    """
    refuse_pedestals(beam.attachments, "complex modes")
    lossy = lossy and beam.loss_factor is not None and bool(np.any(beam.loss_factor))
    scales = beam.is_unloaded or not beam.has_shear or beam.shear_form == "haringx"
    levels: list[tuple[ComplexRoots, Chain]] = []
    refinement = 1
    while True:
        chain = beam.chain(family, refinement)
        columns = make_chain(beam, family, refinement, 0.0).columns if lossy else None
        damped = Damped(chain, columns, form=backend.complex_form)
        rest = at_rest(beam, damped)
        roots = _roots(damped, rest, modes, backend, scales)
        levels.append((roots, chain))
        error, met = _errors(beam, levels, tolerance)
        exhausted = 2 * len(chain.length) > _MOST_SEGMENTS
        if met or exhausted:
            break
        refinement *= 2
    warnings = (
        []
        if met
        else [
            f"{family}: {len(chain.length)} segments do not reach the tolerance {tolerance:g}; see "
            "the errors, or ask for fewer modes or a larger tolerance"
        ]
    )
    if not roots.proven:
        warnings.append(f"{family}: {NOT_PROVEN}")
    own = np.array([value.error for value in roots.eigenvalues])
    return DampedFamily(
        damped, roots.eigenvalues, own + error, rest, warnings, certificate_dict(roots)
    )


def on_chain(beam: Beam, chain: Chain, modes: int, backend: Backend) -> ComplexRoots:
    """Return the complex eigenvalues of one chain of a beam, without dampers and loss."""
    refuse_pedestals(beam.attachments, "complex modes")
    damped = Damped(without_dashpots(chain), form=backend.complex_form)
    return _roots(damped, at_rest(beam, damped), modes, backend, scales=True)


def on_refinement(
    beam: Beam, refinement: int, modes: int, backend: Backend, *, dampers: bool
) -> DampedFamily:
    """Return the complex eigenvalues of a beam in bending on chains of one refinement.

    Their errors are those of the chain alone. `dampers` says whether dashpots and losses count.
    """
    refuse_pedestals(beam.attachments, "complex modes")
    chain = beam.chain(BENDING, refinement)
    lossy = dampers and beam.loss_factor is not None and bool(np.any(beam.loss_factor))
    columns = make_chain(beam, BENDING, refinement, 0.0).columns if lossy else None
    damped = Damped(
        chain if dampers else without_dashpots(chain), columns, form=backend.complex_form
    )
    rest = at_rest(beam, damped)
    scales = beam.is_unloaded or not beam.has_shear or beam.shear_form == "haringx"
    roots = _roots(damped, rest, modes, backend, scales)
    own = np.array([value.error for value in roots.eigenvalues])
    return DampedFamily(damped, roots.eigenvalues, own, rest, [], certificate_dict(roots))


def without_dashpots(chain: Chain) -> Chain:
    """Return a chain without all that acts by velocity."""
    points = tuple(
        replace(p, dashpot=0.0, rotational_dashpot=0.0, feedback_damping=None) for p in chain.points
    )
    return replace(chain, points=points)


def _roots(
    damped: Damped, rest: AtRest, modes: int, backend: Backend, scales: bool
) -> ComplexRoots:
    """Return the eigenvalues of one chain."""
    without = damped if damped.columns is None else replace(damped, columns=None)
    base = without.base

    def of_base(number: int) -> list[Eigenvalue]:
        return backend.find_eigenvalues(base, number, zeros=rest.base_zeros)

    try:
        kind = TurningFinder if without.turns else Finder
        finder = kind(without, of_base, rest.base_zeros, rest.multiplicity)
        found = finder.find(modes)
        return (
            found
            if damped.columns is None
            else with_loss(damped, finder.ratio, found, scales=scales)
        )
    except (CountingError, FloatingPointError) as error:
        raise ComputationError(
            f"the {base.law.name} eigenvalues could not be enclosed: {error}; check stiffness, "
            "mass, axial force, dashpots and feedback for values of a wrong unit"
        ) from error


def _errors(
    beam: Beam, levels: list[tuple[ComplexRoots, Chain]], tolerance: float
) -> tuple[Array, bool]:
    """Return errors of the finest chain's s by representing what varies, and whether they do."""
    roots, chain = levels[-1]
    s = np.array([value.s for value in roots.eigenvalues])
    if not np.any(beam.varies(chain.law.name)):
        return np.zeros(len(s)), True
    rows = [_matched(s, level) for level, _ in levels[-4:]]
    if len(levels) < 3 or any(row is None for row in rows[-3:]):
        return np.full(len(s), np.inf), False
    known = np.array([row for row in rows if row is not None][-4:])
    better, error = np.empty(len(s), complex), np.empty(len(s))
    layer = layer_length(chain, varying_segments(beam, chain))
    extrapolate(known, len(known) - 1, 1e-12, layer, better, error)  # type: ignore[arg-type]
    total = np.abs(better - s) + error
    return total, bool(np.all(total <= tolerance * np.maximum(np.abs(s), 1e-9)))


def _matched(s: Complex, level: ComplexRoots) -> Complex | None:
    """Return the eigenvalues of a coarser chain in the order of the nearest finer ones."""
    other = np.array([value.s for value in level.eigenvalues])
    if len(other) < len(s):
        return None
    taken: list[int] = []
    for value in s:
        gap = np.abs(other - value)
        gap[taken] = np.inf
        taken.append(int(np.argmin(gap)))
    return np.asarray(other[taken])


def certificate_dict(roots: ComplexRoots) -> dict[str, Any]:
    """Return the proof of a list as JSON has it."""
    circle = roots.circle
    record = {
        "base_count": circle.base,
        "winding_number": circle.turns,
        "eigenvalues": circle.number,
        "at_zero": circle.at_zero,
        "found": roots.found,
        "samples": circle.samples,
        "margin": circle.margin,
    }
    if circle.turning:
        record["turning"] = circle.turning
    if circle.loss:
        record["loss"] = circle.loss
    region = {"abs_s_below": circle.radius}
    return {"kind": "winding" if roots.proven else "none", "region": region, "record": record}
