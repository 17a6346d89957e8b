"""What a list of modes warns of."""

from __future__ import annotations

import math

import numpy as np

from antinode.beam.beam import Beam

from .result import Mode

_MODEL_LIMIT = 0.02


def _rotation_warning(beam: Beam) -> str:
    """Say why the rotation of a body that may turn diverges."""
    k = np.arange(len(beam.x) - 1)
    ends = [beam.axial_force_at(k, np.full(len(k), t)) for t in (0.0, 0.5, 1.0)]
    net = float(np.diff(beam.x) @ (ends[0] + 4 * ends[1] + ends[2])) / 6
    if net > 0 or beam.attachments:
        return (
            "rigid rotation is divergent (omega^2 < 0), as for every free body in net compression "
            "by forces of fixed direction; control of the attitude is outside this model"
        )
    return (
        "the lowest mode, counted as rigid rotation, is divergent (omega^2 < 0): the body is in "
        "net tension, but compressed in parts past their buckling; reduce the compression there"
    )


def result_warnings(beam: Beam, modes: list[Mode]) -> list[str]:
    """Return what a user should know of these modes, a sentence each."""
    warnings = []
    divergent = [m.name for m in modes if m.kind == "divergent" and m.number]
    if divergent:
        warnings.append(
            f"{', '.join(divergent)}: omega^2 < 0, the axial compression is past buckling; "
            "the motion grows instead of vibrating: reduce the compression or stiffen the beam"
        )
    if any(m.kind == "divergent" and not m.number for m in modes):
        warnings.append(_rotation_warning(beam))
    shapeless = [m.name for m in modes if math.isnan(m.modal_mass)]
    if shapeless:
        warnings.append(
            f"{', '.join(shapeless)}: modes that coincide, whose shapes could not be told apart; "
            "the frequencies and their counts hold"
        )
    errors = [(m.name, m.model_error) for m in modes if m.model_error is not None]
    large = [name for name, error in errors if abs(error) > _MODEL_LIMIT]
    if large:
        warnings.append(
            f"{large[0]} and above: shear and rotary inertia, which the model leaves out, lower "
            f"the frequency by more than {_MODEL_LIMIT:.0%}; use a Timoshenko model there"
        )
    return warnings
