"""Answers of a sweep that is done: shares of cases, worst ones, quantiles, as tables of rows.

    answers = an.Answers(an.open_store("sweep.zarr"), where="speed < 100")
    answers.share("f1 > 5")

A store is read block by block: memory does not grow with it, but for quantiles, which need one
number a case.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from antinode.arrays import Array
from antinode.errors import InputError
from antinode.text import short

from .formula import FUNCTIONS, Formula, plain_name, read_formula

if TYPE_CHECKING:
    import xarray

_BLOCK = 100_000
_MOST_VALUES = 50_000_000
QUANTILES = (0.0, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 1.0)
"""What a table of quantiles has."""


class Share(NamedTuple):
    """In how many cases a condition holds.

    Attributes
    ----------
    condition : str
    holds, counted : int
        Cases in which it does, of those in which all that it names is known.
    unknown : int
        Cases that were asked for, in which something is not: they failed, a mode diverges, or the
        arithmetic has no result, as x / 0.
    """

    condition: str
    holds: int
    counted: int
    unknown: int

    @property
    def share(self) -> float:
        """Share of the cases that are counted; NaN where there are none."""
        return self.holds / self.counted if self.counted else float("nan")


class Quantiles(NamedTuple):
    """How a number is spread over the cases.

    Attributes
    ----------
    of, unit : str
    shares, values : tuple of float
        Below `values[k]` lies the share `shares[k]`.
    counted, unknown : int
        Cases in which it is known, and in which it is not.
    """

    of: str
    unit: str
    shares: tuple[float, ...]
    values: tuple[float, ...]
    counted: int
    unknown: int


class Worst(NamedTuple):
    """The cases in which a number is smallest, or largest.

    Attributes
    ----------
    of, unit : str
    largest : bool
    cases : tuple of int
    values : tuple of float
    inputs : tuple of dict
        Values of the inputs in SI, by name.
    unknown : int
        Cases in which the number is not known.
    units : dict
        Units of the inputs, by name; "1" where there is none.
    """

    of: str
    unit: str
    largest: bool
    cases: tuple[int, ...]
    values: tuple[float, ...]
    inputs: tuple[dict[str, float], ...]
    unknown: int
    units: dict[str, str]


class Answers:
    """What the cases of a sweep say.

    Parameters
    ----------
    dataset : xarray.Dataset
        Of `sweep` or `open_store`.
    where : str, optional
        A condition: only the cases in which it holds are asked.
    define : mapping, optional
        Formulas by the names that others may use: ``{"gap": "f2 - f1"}``.

    Raises
    ------
    InputError
        If a formula cannot be read, or names what the sweep does not have.
    """

    def __init__(
        self,
        dataset: xarray.Dataset,
        where: str | None = None,
        define: Mapping[str, str] | None = None,
    ) -> None:
        self.dataset = dataset
        over_cases = [v for v in dataset.variables if dataset[v].dims[:1] == ("case",)]
        self._units = {
            str(v): str(dataset[v].attrs.get("units", "1"))
            for v in over_cases
            if dataset[v].dims in (("case",), ("case", "mode"))
        }
        self._of_modes = [n for n in self._units if dataset[n].ndim == 2]
        self._modes = [str(name) for name in dataset["mode"].values]
        self._defined: dict[str, Any] = {}
        for name, text in (define or {}).items():
            self._check_name(name)
            self._defined[name] = self.formula(text).tree
        self._where = None if where is None else self.condition(where)

    def _check_name(self, name: str) -> None:
        taken = {*map(plain_name, self._units), *self._defined, *FUNCTIONS}
        if not name.isidentifier() or name in taken or re.fullmatch(r"f\d+", name):
            raise InputError(f"define: {short(name)} is no name, or there already; take another")

    def formula(self, text: str) -> Formula:
        """Read a formula over the names of this sweep."""
        return read_formula(text, self._units, self._of_modes, self._modes, self._defined)

    def condition(self, text: str) -> Formula:
        """Read a formula that is true or false."""
        found = self.formula(text)
        if not found.is_condition:
            raise InputError(f"formula {short(text)}: it is no condition; compare it, as in f1 > 5")
        return found

    def number(self, text: str) -> Formula:
        """Read a formula that is a number."""
        found = self.formula(text)
        if found.is_condition:
            raise InputError(f"formula {short(text)}: it is a condition, and no number")
        return found

    def share(self, text: str) -> Share:
        """Return in how many cases a condition holds.

        Parameters
        ----------
        text : str
            Such as ``"f1 > 5 and f2 - f1 > 2"``; Hz, and SI for all others.
        """
        formula, holds, counted, unknown = self.condition(text), 0, 0, 0
        for _, found, known in self._each(formula):
            holds += int(np.count_nonzero(found & known))
            counted += int(np.count_nonzero(known))
            unknown += int(np.count_nonzero(~known))
        return Share(text, holds, counted, unknown)

    def values(self, text: str) -> tuple[npt.NDArray[np.int64], Array]:
        """Return the cases in which a number is known, and the number in each."""
        formula, cases, values, held = self.number(text), [], [], 0
        for at, found, known in self._each(formula):
            cases.append(at[known])
            values.append(np.asarray(found[known], dtype=float))
            held += len(values[-1])
            if held > _MOST_VALUES:
                raise InputError(
                    f"{short(text)} has more than {_MOST_VALUES} values; ask fewer cases, with "
                    "a condition (where)"
                )
        return np.concatenate(cases), np.concatenate(values)

    def quantiles(self, text: str, shares: Sequence[float] = QUANTILES) -> Quantiles:
        """Return how a number is spread."""
        values = np.sort(self.values(text)[1])
        found = np.quantile(values, shares) if len(values) else np.full(len(shares), np.nan)
        unit, counted = self.number(text).unit, len(values)
        every = tuple(found.tolist())
        return Quantiles(text, unit, tuple(shares), every, counted, self._asked() - counted)

    def worst(self, text: str, number: int = 5, *, largest: bool = False) -> Worst:
        """Return the cases in which a number is smallest, or largest, with their inputs."""
        formula, sign = self.number(text), -1.0 if largest else 1.0
        at, best, unknown = np.zeros(0, np.int64), np.zeros(0), 0
        for cases, found, known in self._each(formula):
            unknown += int(np.count_nonzero(~known))
            at = np.concatenate([at, cases[known]])
            best = np.concatenate([best, np.asarray(found[known], dtype=float)])
            order = np.argsort(sign * best, kind="stable")[:number]
            at, best = at[order], best[order]
        inputs = tuple(self.inputs(case) for case in at.tolist())
        which, values = tuple(at.tolist()), tuple(best.tolist())
        return Worst(text, formula.unit, largest, which, values, inputs, unknown, self.units())

    def inputs(self, case: int) -> dict[str, float]:
        """Return the values of the inputs in a case [SI]."""
        names = self.dataset.attrs["input_names"]
        return {name: float(self.dataset[name][case]) for name in names}

    def units(self) -> dict[str, str]:
        """Return the units of the inputs, by name."""
        names = self.dataset.attrs["input_names"]
        return {name: str(self.dataset[name].attrs.get("units", "1")) for name in names}

    def _asked(self) -> int:
        """Return the number of cases that are asked."""
        if self._where is None:
            return int(self.dataset.sizes["case"])
        return sum(len(at) for at, _, _ in self._each(self._where))

    def _each(
        self, formula: Formula
    ) -> Iterator[tuple[npt.NDArray[np.int64], npt.NDArray[Any], npt.NDArray[np.bool_]]]:
        """Yield cases, the value of a formula in each, and whether it is known."""
        names = dict.fromkeys((*formula.names, *(self._where.names if self._where else ())))
        for start in range(0, self.dataset.sizes["case"], _BLOCK):
            part = slice(start, start + _BLOCK)
            columns = {n: np.asarray(self.dataset[n][part]) for n in names}
            found, known = formula(columns), formula.known(columns)
            at = np.arange(start, start + len(found))
            if self._where is not None:
                wanted = np.asarray(self._where(columns)) & self._where.known(columns)
                at, found, known = at[wanted], found[wanted], known[wanted]
            if not formula.is_condition:
                known = known & np.isfinite(found)
            yield at, found, known


def case_table(dataset: xarray.Dataset) -> dict[str, npt.NDArray[Any]]:
    """Return a sweep as columns, a row for each case: for pandas, polars, Parquet.

        pandas.DataFrame(an.case_table(an.open_store("sweep.zarr"))).to_parquet("sweep.parquet")

    What has one number a mode is a column for each, ``frequency_hz: bending 1``.
    """
    found: dict[str, npt.NDArray[Any]] = {"case": np.arange(dataset.sizes["case"])}
    inputs = list(dataset.attrs["input_names"])
    for name in (*inputs, *(str(v) for v in dataset.data_vars if v not in inputs)):
        values = dataset[name]
        if values.dims == ("case",):
            found[name] = np.asarray(values)
        elif values.ndim == 2:
            labels = [str(label) for label in dataset[str(values.dims[1])].values]
            table = np.asarray(values)
            found |= {f"{name}: {label}": table[:, k] for k, label in enumerate(labels)}
    return found
