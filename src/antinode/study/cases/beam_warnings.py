"""What each case of a study of a beam warns of: a bit for each sentence."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.beam.beam import Beam
from antinode.beam.file import BeamFile
from antinode.beam.plausible import doubts
from antinode.modes.warnings import (
    FLUTTERS,
    FLUTTERS_DAMPED,
    GIVES_ENERGY,
    LOWEST_DIVERGES,
    MODEL_LIMIT,
    NEUTRAL,
    PAST_BUCKLING,
    PUSHED_ON,
    ROTATION_DIVERGES,
    ROTATION_NOT_TURNED_BACK,
    SHEAR_BUCKLES,
    SHEAR_LOWERS,
    left_out,
    rotation_warning,
    shear_buckles,
)

from .single import Solved, rotation_diverges

_UNLIKELY = (
    "the beam has numbers that hardly any beam has, a unit was likely missed: 'antinode beam' says "
    "which of one case"
)
_OTHER = "a warning of its own, with numbers of the case: 'antinode beam' says it of one case"
RECOGNISED = (
    (f"omega^2 < 0, {PAST_BUCKLING}", f"elastic modes with omega^2 < 0: {PAST_BUCKLING}"),
    (FLUTTERS, f"some modes: {FLUTTERS}"),
    (FLUTTERS_DAMPED, f"some modes: {FLUTTERS_DAMPED}"),
    (PUSHED_ON, f"some modes: {PUSHED_ON}"),
    (GIVES_ENERGY, f"a point feedback: {GIVES_ENERGY}"),
    (ROTATION_DIVERGES, ROTATION_DIVERGES),
    (ROTATION_NOT_TURNED_BACK, ROTATION_NOT_TURNED_BACK),
    (LOWEST_DIVERGES, LOWEST_DIVERGES),
    (NEUTRAL, f"some modes: {NEUTRAL}"),
    (SHEAR_LOWERS, f"some modes: {SHEAR_LOWERS}"),
    (SHEAR_BUCKLES, f"some modes: {SHEAR_BUCKLES}"),
)
"""Sentences of `solve_modes`, and what is said of many cases."""


def beam_messages(file: BeamFile) -> tuple[str, ...]:
    """Return what a case of a study of a beam can warn of, in the order of the bits."""
    texts = [text for _, text in RECOGNISED]
    return (*texts, *left_out(file.beam()), *file.notes, _UNLIKELY, _OTHER)


def beam_warned(
    file: BeamFile, texts: tuple[str, ...], beam: Beam, families: Sequence[Solved]
) -> int:
    """Return the bits of one case.

    Parameters
    ----------
    file : BeamFile
        Of the study.
    texts : tuple of str
        `beam_messages` of it.
    beam : Beam
    families : sequence of Solved
        In the order of the study.
    """
    unlikely = doubts(beam)
    told = {_UNLIKELY} if unlikely else set[str]()
    told |= {*left_out(beam), *file.notes} & set(texts)
    for solved in families:
        if solved.warnings is None:
            told |= set(_of_quick(beam, solved))
        else:
            told |= {recognised(w, texts) or _OTHER for w in solved.warnings if w not in unlikely}
    return sum(1 << texts.index(text) for text in told)


def recognised(warning: str, texts: Sequence[str]) -> str:
    """Return what is said of many cases for the warning of one; nothing for one of its own."""
    if warning in texts:
        return warning
    return next((text for part, text in RECOGNISED if part in warning), "")


def _of_quick(beam: Beam, solved: Solved) -> list[str]:
    """Return what is said of modes whose frequencies alone are known."""
    effect = np.zeros(0) if solved.model_error is None else solved.model_error
    told = list[str]()
    if rotation_diverges(beam, solved.family, solved.omega2):
        told.append(rotation_warning(beam))
    with np.errstate(invalid="ignore"):
        if np.any(np.abs(effect) > MODEL_LIMIT):
            told.append(SHEAR_LOWERS)
        if np.any(shear_buckles(effect)):
            told.append(SHEAR_BUCKLES)
    return [recognised(each, ()) for each in told]
