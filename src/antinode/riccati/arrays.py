"""Names for the arrays that everything passes on: declared here, once."""

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Complex = npt.NDArray[np.complex128]
Numbers = npt.NDArray[Any]
"""Of floats, or complex where a beam is damped."""
