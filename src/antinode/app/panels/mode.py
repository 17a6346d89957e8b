"""One mode along the body: its internal forces, and where its energy lies.

Energies per length are divided by the whole strain energy along the beam: what bends, shears or
rests on a foundation. Those of attached masses and springs stand at points, and are not drawn.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.app.compute import Answer
from antinode.app.display import Shown, shown_unit
from antinode.app.quick import QUICK_FAMILY
from antinode.app.state import View
from antinode.arrays import Array
from antinode.beam.families import FAMILIES, FamilyName
from antinode.modes.hertz import hertz

from .numbers import pairs, thinned
from .sheet import said

_NO_STRAIN = "kinetic", "axial force"
_REFINEMENT = 2  # of the chain whose columns give the energies
_LEAST = 1e-9  # of the strain energy, below which a kind of energy is not drawn


def mode_data(answer: Answer, view: View) -> dict[str, Any]:
    """Return internal forces and energies of the mode that was chosen."""
    number, family = view.body, view.family
    found = _states(answer, view)
    if found is None:
        return said(f"{family} {number} is not solved yet, or there is none.")
    x, states, omega2 = found
    length = shown_unit("m", view.units)
    quantities = FAMILIES[family].quantities
    half = len(quantities) // 2
    curves = []
    for k in range(half, len(quantities)):
        size = float(np.max(np.abs(states[:, k]))) or 1.0
        name, words = quantities[k].symbol[0], quantities[k].text
        line = {"name": "", "points": pairs(*thinned(x / length.factor, states[:, k] / size))}
        curves.append({"name": name, "title": f"{words}, largest 1", "unit": "", "lines": [line]})
    parts, labels = energies(answer, family, x, states, omega2)
    lines = _lines(x, parts, labels, length)
    unit = f"1/{length.name}"
    curves.append({"name": "energy", "title": lines[0]["label"], "unit": unit, "lines": lines})
    label = f"{hertz(omega2):.5g} Hz" if omega2 >= 0 else "divergent"
    return {
        "x": {"unit": length.name, "origin": "nose" if answer.case else "left end"},
        "curves": curves,
        "heading": f"{family} {number}, {label}",
    }


def _lines(
    x: Array, parts: dict[str, Array], labels: dict[str, str], length: Shown
) -> list[dict[str, Any]]:
    """Return the energies per length on both sides of every place."""
    both = np.stack([x[:-1], x[1:]], axis=1).ravel() / length.factor
    return [
        {
            "name": f"{name} energy",
            "label": labels[name],
            "points": pairs(both, values.ravel() * length.factor),
        }
        for name, values in parts.items()
    ]


def _states(answer: Answer, view: View) -> tuple[Array, Array, float] | None:
    """Return x, states and omega^2 of the chosen mode; None where it is not known."""
    k = view.body - 1
    if view.family == QUICK_FAMILY:
        quick = answer.quick
        known = k < len(quick.omega2)
        return (quick.x, quick.states[:, k], float(quick.omega2[k])) if known else None
    if answer.full is None:
        return None
    found = {mode.number: mode for mode in answer.full.family(view.family)}
    mode = found.get(view.body)
    return None if mode is None else (answer.full.x, mode.states, mode.omega2)


def energies(
    answer: Answer, family: FamilyName, x: Array, states: Array, omega2: float
) -> tuple[dict[str, Array], dict[str, str]]:
    """Return energies per length over the strain energy [1/m], and what to call them: with shares.

    Returns
    -------
    dict of array, shape (places - 1, 2)
        At both ends of the stretches between the places x.
    dict of str
    """
    chain = answer.beam.chain(family, _REFINEMENT)
    middle = (x[1:] + x[:-1]) / 2 - answer.beam.x[0]
    segment = np.clip(np.searchsorted(chain.nodes, middle) - 1, 0, len(chain.length) - 1)
    n = len(chain.length)
    columns = {name: np.broadcast_to(c, n)[segment] for name, c in chain.columns.items()}
    z = np.stack([states[:-1], states[1:]], axis=1)
    parts = chain.law.densities(columns, z, omega2)
    h = np.diff(x)[:, None] / 2
    whole = {name: float(np.sum(h * values)) for name, values in parts.items()}
    strain = sum(share for name, share in whole.items() if name not in _NO_STRAIN) or 1.0
    kept = {k: v / strain for k, v in parts.items() if np.max(np.abs(h * v)) > _LEAST * strain}
    labels = {k: f"{k} {100 * whole[k] / strain:.3g} %" for k in kept}
    return kept, labels | ({"kinetic": "kinetic"} if "kinetic" in kept else {})
