"""What a list of modes warns of."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from antinode.beam.attachments import PointFeedback
from antinode.beam.beam import Beam
from antinode.beam.limits import out_of_range_is_an_error
from antinode.beam.plausible import doubts, pushed_at
from antinode.beam.sections.shapes import THIN_TUBE

from .result import ModalResult, Mode

MODEL_LIMIT = 0.02
"""Share of a frequency beyond which shear and rotary inertia are warned of."""
PAST_BUCKLING = (
    "the axial compression is past buckling; the motion grows instead of vibrating: reduce the "
    "compression or stiffen the beam"
)
SPRINGS_PUSH = (
    "nothing compresses the beam, but its springs push it away; the motion grows instead of "
    "vibrating: check their coupling"
)
ROTATION_SOFTENS = (
    "nothing compresses the beam, but in the plane of its rotation the centrifugal force takes it "
    "off the axis; the motion grows instead of vibrating: stiffen the beam or its supports"
)
ROTATION_DIVERGES = (
    "rigid rotation is divergent (omega^2 < 0), as for every free body in net compression by "
    "forces of fixed direction; control of the attitude is outside this model"
)
FLUTTERS = (
    "flutter, by end forces that follow: the motion grows while it oscillates, and a twin of the "
    "same frequency decays; damping, which the model leaves out, may lower the load at which that "
    "starts: reduce the force or stiffen the beam"
)
FLUTTERS_DAMPED = (
    "flutter: the motion grows while it oscillates, by forces that answer it, such as end forces "
    "that follow or feedback; reduce them or stiffen the beam"
)
GIVES_ENERGY = (
    "its damping gives energy in some motion (the symmetric part of its matrix has a negative "
    "eigenvalue): that is allowed, and may make modes grow"
)
PUSHED_ON = (
    "the motion grows without oscillating: forces that answer it push it on by more than the "
    "stiffness, or whatever holds the body, turns it back"
)
ROTATION_NOT_TURNED_BACK = (
    "rigid rotation is divergent (omega^2 < 0): the forces that keep their direction turn the body "
    "on by more than those that follow it turn it back; control of the attitude is outside this "
    "model"
)
SHEAR_BUCKLES = (
    "shear, which the model leaves out, brings omega^2 below zero by its estimate: with it the "
    "mode is past buckling, or close to it; use a Timoshenko model there"
)
SHEAR_LOWERS = (
    "shear and rotary inertia, which the model leaves out, lower the frequency by more than "
    f"{MODEL_LIMIT:.0%} (estimated, where kGA is not given, with that of a thin-walled tube, "
    f"kGA = EA/{THIN_TUBE:.1f}, kappa = 0.53, nu = 0.3; in solid sections, kappa = 0.85 to 0.89, "
    "it is some two thirds of that); use a Timoshenko model there"
)


LOWEST_DIVERGES = (
    "the lowest mode, counted as rigid rotation, is divergent (omega^2 < 0): the body is in net "
    "tension, but compressed in parts past their buckling; reduce the compression there"
)


NEUTRAL = (
    "omega^2 is zero within its error: these numbers do not tell whether the motion comes back or "
    "grows; lower the tolerance, or change the load a little"
)


def rotation_warning(beam: Beam) -> str:
    """Say why the rotation of a body that may turn diverges."""
    if any(beam.following()):
        return ROTATION_NOT_TURNED_BACK
    net, h = beam.axial_force.sum(axis=1), beam.x[1:] - beam.x[:-1]
    if beam.axial_acceleration:
        k = np.arange(len(h))
        ends = [beam.axial_force_at(k, np.full(len(k), t)) for t in (0.0, 0.5, 1.0)]
        net = (ends[0] + 4 * ends[1] + ends[2]) / 6
    if h @ net > 0 or beam.attachments:
        return ROTATION_DIVERGES
    return LOWEST_DIVERGES


def _cause(beam: Beam) -> str:
    """Say why an elastic mode diverges."""
    compressed = np.any(beam.axial_force > 0) or beam.axial_acceleration
    if not compressed and pushed_at(beam):
        return SPRINGS_PUSH
    if not compressed and beam.rotation is not None:
        return ROTATION_SOFTENS
    return PAST_BUCKLING


def result_warnings(beam: Beam, modes: Sequence[Mode]) -> list[str]:
    """Return what a user should know of these modes, a sentence each."""
    warnings = doubts(beam)
    divergent = [m for m in modes if m.kind == "divergent" and m.number]
    answered = any(isinstance(item, PointFeedback) for item in beam.attachments)
    if divergent and answered:
        warnings.append(f"{_growing(divergent)}: {PUSHED_ON}")
    elif divergent:
        warnings.append(f"{', '.join(m.name for m in divergent)}: omega^2 < 0, {_cause(beam)}")
    flutter = [m for m in modes if m.kind == "flutter"]
    if flutter:
        complex_ = any(m.eigenvalue is not None for m in flutter)
        warnings.append(f"{_growing(flutter)}: {FLUTTERS_DAMPED if complex_ else FLUTTERS}")
    warnings += [
        f"the point feedback at x = {item.x:g} m: {GIVES_ENERGY}"
        for item in beam.attachments
        if isinstance(item, PointFeedback) and item.gives_energy
    ]
    if any(m.kind == "divergent" and not m.number for m in modes):
        warnings.append(rotation_warning(beam))
    near = [m for m in modes if 0 <= m.omega2 < m.error_omega2]
    neutral = [m.name for m in near if m.kind != "overdamped"]
    if neutral:
        warnings.append(f"{', '.join(neutral)}: {NEUTRAL}")
    shapeless = [m.name for m in modes if math.isnan(m.modal_mass)]
    if shapeless:
        warnings.append(
            f"{', '.join(shapeless)}: modes that coincide, whose shapes could not be told apart; "
            "the frequencies and their counts hold"
        )
    return warnings + _shear_warnings(modes) + left_out(beam)


@out_of_range_is_an_error()
def warnings_of(result: ModalResult) -> list[str]:
    """Return what a user should know of a result, a sentence each."""
    return result_warnings(result.beam, result.modes)


def _growing(modes: list[Mode]) -> str:
    """Name modes that grow, and how fast."""
    return ", ".join(f"{m.name} (by {m.eigenvalue_per_s.real:.4g} /s)" for m in modes)


def left_out(beam: Beam) -> list[str]:
    """Say which columns the theory that was asked for does not use."""
    tables = ("shear_stiffness", "rotary_inertia_per_length")
    given = [name for name in tables if getattr(beam, name) is not None]
    if beam.is_timoshenko or not given:
        return []
    return [
        f"{' and '.join(given)}: left out, because theory = 'euler_bernoulli'; leave the theory "
        "out, or set it to 'timoshenko', to solve them"
    ]


def _shear_warnings(modes: Sequence[Mode]) -> list[str]:
    """Return what the estimate of shear and rotary inertia means where it is large."""
    errors = [(m.name, m.model_error) for m in modes if m.model_error is not None]
    large = [name for name, error in errors if abs(error) > MODEL_LIMIT]
    buckled = [name for name, error in errors if shear_buckles(error)]
    warnings = [f"{large[0]} and above: {SHEAR_LOWERS}"] if large else []
    if buckled:
        warnings.append(f"{', '.join(buckled)}: {SHEAR_BUCKLES}")
    return warnings


def shear_buckles(effect: Any) -> Any:
    """Tell where the estimated effect of shear on a frequency, or on many, leaves none of it."""
    return effect <= -1.0
