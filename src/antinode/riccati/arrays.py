"""Names for the arrays that everything passes on, declared once; and values made distinct."""

from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Complex = npt.NDArray[np.complex128]
Numbers = npt.NDArray[Any]
"""Of floats, or complex where a beam is damped."""

_Kind = TypeVar("_Kind", bound=np.generic)


def distinct(values: npt.NDArray[_Kind]) -> npt.NDArray[_Kind]:
    """Return finite values in order, each once.

    `numpy.unique` does so too, and first imports all of `numpy.ma`: a fiftieth of a cold start.
    """
    values = np.sort(values)
    return values[np.append(True, values[1:] != values[:-1])] if len(values) else values
