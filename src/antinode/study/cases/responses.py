"""What the response of each case comes to, with errors and warnings, solved a case at a time."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from antinode.arrays import Array, Integers
from antinode.errors import AntinodeError
from antinode.response.file import Problem, ResponseFile
from antinode.response.solve import response_numbers

from .reasons import failed
from .values import Cases
from .warned import response_bits


def responses(cases: Cases, reason: Integers) -> tuple[dict[str, Array], Integers]:
    """Return the numbers of `Study.asked` and their errors by name, and bits of warnings.

    NaN where the case failed, and where its response could not be computed.
    """
    study, number = cases.study, len(reason)
    assert study.response is not None
    file = _without_envelope(study.response)
    found = {
        name: np.full(number, np.nan)
        for one in study.asked
        for name in (one.name, f"{one.name}_error")
    }
    bits = np.zeros(number, dtype=np.int64)
    for i in np.flatnonzero(~failed(reason)).tolist():
        try:
            beam = cases.problem(i).beam()
            own = response_numbers(Problem(file, beam, Path(), "the response", "numba"), beam)
        except (AntinodeError, ArithmeticError):
            bits[i] = response_bits(study, [None])
            continue
        bits[i] = response_bits(study, own.warnings)
        for one, headline in zip(study.asked, own.headlines, strict=True):
            found[one.name][i] = headline.value
            found[f"{one.name}_error"][i] = headline.error
    return found, bits


def _without_envelope(file: ResponseFile) -> ResponseFile:
    """Return the file without what no study keeps."""
    random = file.random.model_copy(update={"envelope": False})
    return file.model_copy(update={"random": random})
