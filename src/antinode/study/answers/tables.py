"""A sweep as a Parquet file, by the library that is there."""

from __future__ import annotations

import importlib
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.errors import InputError
from antinode.whole import write_file

from .answers import case_table

if TYPE_CHECKING:
    import xarray


def write_parquet(dataset: xarray.Dataset, path: Path) -> None:
    """Write all cases of a sweep, a row for each.

    Raises
    ------
    InputError
        If neither polars nor pyarrow is installed.
    """
    columns = case_table(dataset)
    for write in (_by_polars, _by_pyarrow):
        try:
            write_file(path, partial(write, columns))
        except ImportError:
            continue
        return
    raise InputError(
        "Parquet needs polars or pyarrow: pip install 'antinode[parquet]'; or name a .csv file"
    )


def _by_polars(columns: dict[str, Any], path: Path) -> None:
    library: Any = importlib.import_module("polars")
    library.DataFrame(columns).write_parquet(path)


def _by_pyarrow(columns: dict[str, Any], path: Path) -> None:
    table: Any = importlib.import_module("pyarrow")
    parquet: Any = importlib.import_module("pyarrow.parquet")
    parquet.write_table(table.table(columns), path)
