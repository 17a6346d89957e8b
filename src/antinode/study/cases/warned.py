"""What each case warns of: a bit for each sentence, and how many cases it concerns."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array, Integers
from antinode.beam.file import BeamFile
from antinode.beam.plausible import OF_MANY
from antinode.modes.warnings import (
    FLUTTERS,
    LOWEST_DIVERGES,
    MODEL_LIMIT,
    PAST_BUCKLING,
    ROTATION_DIVERGES,
    ROTATION_NOT_TURNED_BACK,
    SHEAR_BUCKLES,
    SHEAR_LOWERS,
    shear_buckles,
)
from antinode.study.design.file import Study

from . import reasons
from .beam_warnings import beam_messages
from .beams import load_messages
from .bending import Eigenvalues
from .water_warnings import WATER_MESSAGES

_OF_MODES = (
    f"elastic modes with omega^2 < 0: {PAST_BUCKLING}",
    ROTATION_DIVERGES,
    LOWEST_DIVERGES,
    f"some modes: {SHEAR_LOWERS}",
    f"some modes: {SHEAR_BUCKLES}",
    f"some modes: {FLUTTERS}",
)


LAST_BIT = 62
"""The highest bit; sentences beyond it share it (of a vehicle with some fifty sets of fins)."""


RESPONSE_MESSAGES = (
    ("the body is not stable", "the body is not stable under its axial force, dampers and "
     "feedback: a response over frequency is the forced part alone, which never comes by itself"),
    ("the force of an end turns", "the force of an end turns with it: the response is exact, but "
     "its resonances are not known well enough for every peak; a narrow one may be missed"),
    ("no damping", "no damping: at a resonance the response grows without bound, and only how near "
     "a frequency comes to it limits it"),
    ("a feedback acts", "a feedback acts, as the water's stiffness does: the response is exact, "
     "but its resonances are not known well enough for every peak; a narrow one may be missed"),
    ("modes left out", "modes left out still change some histories by more than 0.5 %: see the "
     "errors of the response"),
    ("nothing limits", "nothing limits what some equipment feels: without damping it has no "
     "margin"),
    ("nothing is felt", "nothing is felt by some equipment beyond the error of the computation: "
     "its margin has no end"),
    ("not decided", "the margin of some equipment is within its error: not decided"),
    ("not all is judged", "some equipment is not judged over the whole band: what it may feel, or "
     "the response, ends before"),
    ("", "the response warns of something: 'antinode response' of that case alone tells it"),
    (None, "the response could not be computed, or has no verdict since the body is not stable"),
)  # fmt: skip
"""How warnings of responses begin, and what is said of all cases that have one."""


def messages(study: Study) -> tuple[str, ...]:
    """Return what a case of a study can warn of, in the order of the bits."""
    texts = case_messages(study)
    if study.response is not None:
        texts = (*texts, *(text for _, text in RESPONSE_MESSAGES))
    return (*texts[:LAST_BIT], "; or ".join(texts[LAST_BIT:])) if len(texts) > LAST_BIT else texts


def response_bits(study: Study, warnings: Iterable[str | None]) -> int:
    """Return the bits of what the response of a case warns of; None where it was not computed."""
    bits, first = 0, len(case_messages(study))
    for told in warnings:
        row = next(
            k
            for k, (start, _) in enumerate(RESPONSE_MESSAGES)
            if told is start or (told is not None and start is not None and told.startswith(start))
        )
        bits |= 1 << min(first + row, LAST_BIT)
    return bits


def case_messages(study: Study) -> tuple[str, ...]:
    """Return what a case can warn of without its response."""
    if isinstance(study.case, BeamFile):
        return beam_messages(study.case)
    if study.vehicle_case.model.water_answers:
        return (*WATER_MESSAGES, *OF_MANY, *load_messages(study.vehicle_case))
    of_modes = list(_OF_MODES)
    if any(study.vehicle_case.model.follow):
        of_modes[of_modes.index(ROTATION_DIVERGES)] = ROTATION_NOT_TURNED_BACK
    return (*of_modes, *OF_MANY, *load_messages(study.vehicle_case))


def type_of_bits(study: Study) -> str:
    """Return the smallest type that has a bit for each message."""
    return "int32" if len(messages(study)) < 32 else "int64"


def warned(found: Eigenvalues, model_error: Array, doubts: npt.NDArray[np.bool_]) -> Integers:
    """Return the bits of every case.

    Parameters
    ----------
    found : Eigenvalues
        Cases that failed warn of nothing.
    model_error : array, shape (cases, modes)
    doubts : array of bool, shape (warnings, cases)
        About the bodies and the loads.
    """
    with np.errstate(invalid="ignore"):
        told = (
            np.any(found.omega2 < 0, axis=1),
            found.net_force > 0,
            found.lowest_diverges & ~(found.net_force > 0),
            np.any(np.abs(model_error) > MODEL_LIMIT, axis=1),
            np.any(shear_buckles(model_error), axis=1),
            found.reason == reasons.FLUTTERS,
        )
    bits = np.zeros(len(found.reason), dtype=np.int64)
    for k, each in enumerate((*told, *doubts)):
        bits |= each * np.int64(1 << min(k, LAST_BIT))
    return np.where(reasons.failed(found.reason), 0, bits)


def counted_warnings(
    texts: Iterable[str], blocks: Iterable[npt.NDArray[Any]], cases: int
) -> list[dict[str, Any]]:
    """Count the cases that each sentence concerns; sentences that concern none are left out.

    Parameters
    ----------
    texts : iterable of str
        In the order of the bits.
    blocks : iterable of array of int
        The bits of all cases, one block after the other.
    cases : int
        Number of all cases, those that failed included.
    """
    texts = tuple(texts)
    count, first, start = [0] * len(texts), [-1] * len(texts), 0
    for bits in blocks:
        for k in range(len(texts)):
            concerned = np.flatnonzero(bits & (1 << k))
            if len(concerned) and first[k] < 0:
                first[k] = start + int(concerned[0])
            count[k] += len(concerned)
        start += len(bits)
    return [
        {"message": text, "count": n, "share": n / cases, "first_case": at}
        for text, n, at in zip(texts, count, first, strict=True)
        if n
    ]
