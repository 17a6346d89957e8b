"""Shapes of chosen modes: displacement, slope, moment or force, each with its largest value 1."""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.compute import Answer
from antinode.app.display import shown_unit
from antinode.app.quick import QUICK_FAMILY, Quick
from antinode.app.state import View
from antinode.beam.families import FAMILIES, FamilyName
from antinode.modes.hertz import hertz

from .numbers import pairs, short_list, thinned


def modes_data(answer: Answer, view: View, beside: Answer | None = None) -> dict[str, Any]:
    """Return the curves of the modes that the view asks for, beside those of a snapshot."""
    family = view.family if answer.full else QUICK_FAMILY
    x, shapes, labels = _shapes(answer, view, family)
    factor = shown_unit("m", view.units).factor
    names = FAMILIES[family].quantities
    component = min(view.component, len(names) - 1)
    return {
        "unit": shown_unit("m", view.units).name,
        "origin": "nose" if answer.case else "left end",
        "component": names[component][0],
        "meaning": names[component][2],
        "curves": _curves(view, x / factor, component, shapes, labels),
        "kept": [] if beside is None else _kept(beside, view, family, factor, component),
    }


def _curves(
    view: View, x: np.ndarray, component: int, shapes: list[np.ndarray | None], labels: list[str]
) -> list[dict[str, Any]]:
    return [
        {
            "number": number,
            "label": label,
            "points": _points(x, shape, component),
        }
        for number, label, shape in zip(view.modes, labels, shapes, strict=False)
        if shape is not None
    ]


def _points(x: np.ndarray, shape: np.ndarray, component: int) -> list[list[float | None]]:
    """Return x and the quantity, its largest value 1; of complex modes a quarter turn later."""
    places, values = thinned(x, _largest_one(shape[:, component]))
    points = pairs(places, values.real)
    if np.iscomplexobj(values):
        later = short_list(values.imag)
        points = [[*point, value] for point, value in zip(points, later, strict=True)]
    return points


def _kept(
    beside: Answer, view: View, family: FamilyName, factor: float, component: int
) -> list[dict[str, Any]]:
    """Return the shapes of a snapshot, if they are known."""
    if family != QUICK_FAMILY and beside.full is None:
        return []
    x, shapes, labels = _shapes(beside, view, family)
    return _curves(view, x / factor, component, shapes, labels)


def _shapes(
    answer: Answer, view: View, family: FamilyName
) -> tuple[np.ndarray, list[np.ndarray | None], list[str]]:
    """Return x, and of every mode asked for its states and a label; None where there is none."""
    if family == QUICK_FAMILY:
        quick = answer.quick
        count = len(quick.omega2)
        shapes = [_moving(quick, n - 1) if n <= count else None for n in view.modes]
        labels = [_label(float(quick.omega2[n - 1])) if n <= count else "" for n in view.modes]
        return quick.x, shapes, labels
    assert answer.full is not None
    found = {mode.number: mode for mode in answer.full.family(family)}
    modes = [found.get(n) for n in view.modes]
    shapes = [None if mode is None else mode.states for mode in modes]
    return answer.full.x, shapes, ["" if m is None else _label(m.omega2) for m in modes]


def _moving(quick: Quick, k: int) -> np.ndarray:
    """Return a mode's states; of a complex one its phasors, turned to where it moves farthest."""
    states = quick.states[:, k]
    if quick.phasors is None:
        return np.asarray(states)
    phasors = quick.phasors[:, k]
    farthest = phasors[np.argmax(np.abs(phasors[:, 0])), 0]
    turned = phasors * (abs(farthest) / farthest)
    along = float(turned[:, 0].real @ states[:, 0])
    return np.asarray(turned if along >= 0 else -turned)


def _label(omega2: float) -> str:
    return f"{hertz(omega2):.4g} Hz" if omega2 >= 0 else "divergent"


def _largest_one(values: np.ndarray) -> np.ndarray:
    return np.asarray(values / (np.max(np.abs(values)) or 1.0))
