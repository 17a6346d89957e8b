"""What Python calls of the compiled functions, with the types of their arguments.

An argument is told by a value of its type.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from antinode.riccati.chains import ChainRoots

from . import following, laws, levels, lowest, rows, search
from .forced import free, products, ratio, sweep
from .forced.layout import SEARCH, Acting, Driven, Ends, Free, RatioWork, Rule, Sampled, Zeros
from .forced.layout import new_room as new_forced_room
from .modal import integrals, segments, shapes
from .structures import Kept
from .workspace import (
    NO_POINTS,
    Asked,
    Interior,
    Nodes,
    Rules,
    Task,
    Warmth,
    new_chain,
    new_lanes,
    new_levels,
    new_room,
    new_roots,
    new_search,
)

_f1, _f2, _f3, _f4, _f5 = (np.zeros((1,) * dimensions) for dimensions in range(1, 6))
_i1, _i2 = np.zeros(1, np.int64), np.zeros((1, 1), np.int64)
_i, _f, _b = 1, 1.0, True

_chain, _lanes, _search = new_chain(1, 1, 1, 1), Kept(new_lanes()), Kept(new_search(1))
_kept_chain = Kept(_chain)
_task, _warmth = Task(1, 1.0, True), Warmth(_i1, _f1, _f1, _f3, _f2)
_interior = Interior(1, 1, 1.0, 1.0, 1.0, True, 1.0, 1.0, 1)
_asked = Asked(_f2, _f1, True)
_room, _rules = Kept(new_room(1)), Rules(_f1, _i1, _f2, _f2)
_found = ChainRoots.empty(1, 1)
_driven = Driven(_i2, _f2, _i1, _f2, _f2, _f2, _f3, _f1, 1.0)

_ends = Ends(_f2, _f2, True, True)
_free, _zeros = Kept(Free(_driven, _ends, 1.0, 1.0, 1.0, 1.0)), Zeros(1, 1.0, 1.0, 1.0, True)
_acting = Kept(Acting(Free(_driven, _ends, 1.0, 1.0, 1.0, 1.0), _i1, _i1, _f2, _f2))
_sampled, _ratio_work = (
    Sampled(_f2, _f1, *(5 * (_f3,)), _f4, _f2),
    RatioWork(_f2, _i1, _f5, _f4, *(4 * (_f3,))),
)
_forced_room, _q = Kept(new_forced_room(1, 1, 1)), np.zeros(SEARCH)

Entries = dict[str, tuple[Any, tuple[Any, ...]]]

ENTRIES: dict[str, Entries] = {
    "roots": {
        "scale": (rows.scale, (_chain, _f1)),
        "prepare": (laws.prepare, (_chain, _f, _f2)),
        "evaluate": (search.evaluate, (_chain, _f1, _f2, _lanes, _i1, _f1)),
        "find_roots": (
            following.find_all,
            (_chain, _task, _b, _f, new_roots(1), _f2, _lanes, _search),
        ),
        "find_lowest": (
            lowest.find_lowest,
            (_chain, _i, _i, _f, _f, new_roots(1), _f2, _lanes, _search),
        ),
        "solve_rows": (
            rows.solve_rows,
            (10 * (_f2,), _i, _kept_chain, _task, _warmth, _f2, _lanes, _search, _found),
        ),
        "certify_rows": (
            rows.certify_rows,
            (_f2, _f2, _f2, _kept_chain, _f1, _task, _f1, _f2, _lanes, _search, _found),
        ),
        "solve_levels": (
            levels.solve_levels,
            (
                *(Kept(new_levels(0, 1, 1, _f2, 1)), _interior, Nodes(_i1, NO_POINTS, NO_POINTS)),
                *(_i, _i, _f, _f),
            ),
        ),
        "repeat": (search.repeat, (_chain, _f2, _lanes, _i, _i)),
    },
    "shapes": {
        "cut": (segments.cut, (_chain, _f1, _f, _f1, _f1, _i1, _i1)),
        "states": (shapes.set_states, (_chain, _f1, _b, _f, _room, _f3)),
        "squares": (integrals.integrate, (_chain, _f1, _f3, _rules, _f, _room)),
        "normalise": (
            integrals.normalise,
            (_chain, _f1, _f3, _f4, _asked, _rules, _f, _room, _f2, _f3),
        ),
        "modes": (
            integrals.solve_modes,
            (_chain, _f1, _f2, _f4, _asked, _rules, _f, _room, _f3, _f2, _f3),
        ),
    },
    "forced": {
        "drive": (
            sweep.drive,
            (_driven, _ends, _f2, new_forced_room(1, 1, 1), _f5),
        ),
    },
    "complex": {
        "characteristic": (free.characteristic, (_free, _f2, _forced_room, _q, _f2, _f1)),
        "find_zeros": (free.find, (_free, _zeros, _f2, _f2, _forced_room, _q, _f2, _f1)),
        "free_modes": (free.modes, (_free, _f2, _forced_room, _f5)),
        "ratio": (ratio.samples, (_acting, _f2, _f1, _forced_room, _ratio_work, _sampled)),
        "ratio_values": (ratio.values, (_acting, _f2, _forced_room, _ratio_work, _f2)),
        "receptances": (ratio.receptances, (_acting, _f2, _forced_room, _ratio_work)),
        "spread": (ratio.spread, (_f2, _sampled, _f1, _f3, _f1)),
        "products": (
            products.integrate,
            (_free, Rule(_f1, _f3, _f1, _f1), _f2, _f4, _f4, _forced_room, _f5),
        ),
    },
}
"""By the part of the library that they are compiled into."""
