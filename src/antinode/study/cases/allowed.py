"""Which values a case allows at a place; what is allowed is taken for an interval."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
from pydantic import ValidationError

from antinode.arrays import Array
from antinode.vehicle.case import Case
from antinode.vehicle.numbers import Keys


def outside_range(case: Case, keys: Keys, values: Array) -> npt.NDArray[np.bool_]:
    """Tell which values the case does not allow at a place."""

    def allowed(value: float) -> bool:
        return _is_allowed(case, keys, value)

    finite = np.isfinite(values)
    known = np.unique(values[finite])
    if not len(known):
        return ~finite
    if allowed(float(known[0])) and allowed(float(known[-1])):
        return ~finite
    inside = [k for k in _probes(len(known)) if allowed(float(known[k]))][:1]
    if not inside:
        return np.ones(len(values), dtype=bool)
    low = _last(lambda k: allowed(float(known[k])), inside[0], 0)
    high = _last(lambda k: allowed(float(known[k])), inside[0], len(known) - 1)
    return np.asarray(~finite | (values < known[low]) | (values > known[high]))


def _probes(n: int) -> list[int]:
    """Return indices, coarse ones first, then all."""
    return list(dict.fromkeys([*range(0, n, max(1, n // 16)), *range(n)]))


def _last(test: Callable[[int], bool], good: int, end: int) -> int:
    """Return the last index from `good` towards `end` that passes a test that fails but once."""
    if test(end):
        return end
    bad = end
    while abs(bad - good) > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if test(middle) else (good, middle)
    return good


def _is_allowed(case: Case, keys: Keys, value: float) -> bool:
    if keys[:2] == ("vehicle", "stations"):
        return value > 0
    model: Any = case
    for key in keys[:-1]:
        model = model[int(key)] if isinstance(model, tuple) else getattr(model, str(key))
    if isinstance(model, tuple):
        return _is_allowed_in_list(case, keys, value)
    fields = {name: getattr(model, name) for name in type(model).model_fields}
    try:
        type(model).model_validate({**fields, str(keys[-1]): value})
    except ValidationError:
        return False
    return True


def _is_allowed_in_list(case: Case, keys: Keys, value: float) -> bool:
    """Tell the same of a number in a list, such as a roll angle."""
    owner: Any = case
    for key in keys[:-2]:
        owner = owner[int(key)] if isinstance(owner, tuple) else getattr(owner, str(key))
    changed = list(getattr(owner, str(keys[-2])))
    changed[int(keys[-1])] = value
    fields = {name: getattr(owner, name) for name in type(owner).model_fields}
    try:
        type(owner).model_validate({**fields, str(keys[-2]): changed})
    except ValidationError:
        return False
    return True
