"""What Python calls of the compiled functions, with the types of their arguments.

An argument is told by a value of its type.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import kernel, shapes

_f1, _f2, _f3, _f4 = (np.zeros((1,) * dimensions) for dimensions in range(1, 5))
_i1, _i2, _i3 = (np.zeros((1,) * dimensions, np.int64) for dimensions in range(1, 4))
_b1 = np.zeros(1, np.bool_)
_i, _f, _b = 1, 1.0, True

_chain = (_f1, _f1, _f1, _f1)
_work = (
    *(_f2, _f1, _i1, _i1, _i1, _f2, _f1, _f1, _f1, _f1, _i1, _i2, _i2, _i1, _f1, _f1, _f2, _i1),
    _b1,
)
_lists = (_f2, _f2, _f2, _i3, _f2)

ENTRIES: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "make_dimensionless": (kernel.make_dimensionless, (_f2,)),
    "prepare": (kernel.prepare, (*_chain, _i1, _f, _i1, _i1, _f2)),
    "evaluate_lanes": (
        kernel.evaluate_lanes,
        (_f2, _i1, _i1, _f2, _i1, _f1, _f1, _f1, _f1, _i1, _f1),
    ),
    "find_roots": (
        kernel.find_roots,
        (*_chain, _i1, _i, _b, _f1, _f1, _f, _b, _f1, _f1, _i2, _f1, _f2, _work, _f),
    ),
    "solve_rows": (
        kernel.solve_rows,
        (
            _f2,
            _f2,
            _f2,
            _f2,
            _i1,
            _i,
            _f,
            _f3,
            _i,
            _i1,
            _f1,
            _f1,
            _f2,
            _f2,
            _f2,
            _work,
            *_lists,
            _i1,
            _i1,
        ),
    ),
    "certify_rows": (
        kernel.certify_rows,
        (_f2, _f2, _i1, _i, _f, _f2, *_lists, _i1, _i1, _f2, _work, _f1, _f1),
    ),
    "solve_levels": (
        kernel.solve_levels,
        (
            _f1,
            _f2,
            _f2,
            _f2,
            _f,
            _f1,
            _b,
            (_f, _f, _i),
            _i1,
            _i,
            _i,
            _f,
            _f,
            _i1,
            _f2,
            _f1,
            _f1,
            _f2,
            _i2,
            _i1,
            _i1,
            _i1,
            _i1,
            _f2,
            _f2,
            _i1,
            _i1,
            _f2,
            (_f1,) * 7,
            _f2,
            _f2,
            _work,
        ),
    ),
    "scaled_chain": (shapes.scaled_chain, (_f1, _f1, _f1, _f1, _f1, _f, _f1, _f2, _f2)),
    "transfers": (shapes.transfers, (_f1, _f1, _f2, _f2, _f1, _f2, _f3)),
    "sweeps": (shapes.sweeps, (_f3, _i1, _f3, _i2, _f2, _f3, _f3, _f3, _f3)),
    "meet": (shapes.meet, (_f3, _f3, _f2, _i1, _f2)),
    "carry": (shapes.carry, (_f3, _f3, _f3, _f3, _i1, _f2, _f2, _f3)),
    "squares": (
        shapes.squares,
        (_f1, _f1, _f2, _f2, _f1, _f2, _f3, _f1, _f1, _f2, _f3),
    ),
    "repeat": (kernel.repeat, (_f2, _f1, _i, _i)),
}
