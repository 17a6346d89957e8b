"""The folder of a store: made whole or not at all, told from others, removed, opened to read."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.errors import InputError
from antinode.extras import import_extra
from antinode.study.design.points import Points, resized

from . import documents as known
from .contents import TIMESTAMPS, attributes, coordinates_of, labelled, outputs_of
from .disk import append_lasting, keep_folder, keep_names, write_lasting
from .documents import METADATA, Documents
from .ledger import first_line, is_ledger, ledger_of
from .lock import cannot_write
from .store import Store

if TYPE_CHECKING:
    import xarray

_KEYS = {
    "store_format": "of another version of antinode",
    "antinode_version": "of another version of antinode",
    "sources_hash": "of another build of antinode",
    "case_hash": "of another case",
    "study_hash": "of another study",
}
_LATER = ("failed", "warnings", "coordinates", "title", "settings", *TIMESTAMPS)
"""Attributes that do not follow from the study."""
_NEEDED = ("store_format", "cases", "mode_names", "input_names")
_FEW, _MOST = 64, 64  # blocks of a study, and chunks of a block, if there are so many


def import_store() -> Any:
    """Return zarr; raise InputError if a library of the `sweep` extra is not installed."""
    import_extra("xarray", "sweep")
    return import_extra("zarr", "sweep")


def rows_of_blocks(points: Points) -> int:
    """Return how many cases a block of a new store has."""
    chunk = points.study.run_table.chunk
    rows = chunk * min(max(points.chunks // _FEW, 1), _MOST)
    return rows if points.grows else min(rows, points.cases)


def create(path: Path, points: Points) -> Store:
    """Make an empty store: all or nothing appears at `path`.

    Raises
    ------
    InputError
        If the folder cannot be written.
    """
    rows = rows_of_blocks(points)
    partial = path.with_name(f".{path.name}.partial")
    try:
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir()
        made = _documents(points, attributes(points), rows)
        _write(partial, made)
        append_lasting(ledger_of(partial), first_line())
        keep_names(partial, [ledger_of(partial)])
        partial.rename(path)
        keep_folder(path.parent)
    except OSError as error:
        shutil.rmtree(partial, ignore_errors=True)
        raise InputError(cannot_write(path, error)) from error
    return Store(path, points, rows)


def _documents(points: Points, attrs: Mapping[str, Any], rows: int) -> Documents:
    return known.documents(outputs_of(points), coordinates_of(points), attrs, rows)


def _write(path: Path, documents: Documents) -> None:
    """Write documents, the group's last: with it the others count."""
    ordered = sorted(documents, key=lambda name: name == METADATA)
    for name in ordered:
        write_lasting(path, path / name, documents[name])
    keep_names(path, [path / name for name in ordered])


def resume(path: Path, points: Points) -> Store:
    """Return a store that is there, grown if the design has.

    Raises
    ------
    InputError
        If it is no store, that of another case, study or version, or damaged.
    """
    found = _attributes(path)
    attrs = attributes(points)
    _check_same(path, found, attrs)
    former = _former(path, points, found)
    _check_attributes(path, found, known.plain(attributes(former)))
    rows = _rows(path, points)
    wanted = _documents(points, {**attrs, **_kept(found, points)}, rows)
    _write(path, {name: wanted[name] for name in _changed(path, wanted)})
    if not ledger_of(path).exists():
        append_lasting(ledger_of(path), first_line())
    return Store(path, points, rows)


def _attributes(path: Path) -> dict[str, Any]:
    """Return the attributes of what is there."""
    try:
        found = known.attributes_of((path / METADATA).read_bytes())
    except (OSError, ValueError) as error:
        if is_ledger(path):
            raise _damaged(path, METADATA) from error
        raise InputError(
            f"{path} exists already and is no store of a sweep; name another"
        ) from error
    if "store_format" not in found:
        if is_ledger(path):
            raise _damaged(path, METADATA)
        raise InputError(f"{path} exists already and is no store of a sweep; name another")
    return found


def _damaged(path: Path, what: str) -> InputError:
    return InputError(f"{path}: {what} is damaged beyond repair; add --overwrite to begin anew")


def _check_same(path: Path, found: Mapping[str, Any], attrs: Mapping[str, Any]) -> None:
    """Refuse the store of another case, study or version."""
    for key, words in _KEYS.items():
        if found.get(key) != attrs[key]:
            detail = ""
            if key == "antinode_version":
                detail = f" ({found.get(key)}, this is {attrs[key]})"
            raise InputError(
                f"{path} is the store {words}{detail}; name another store, or add --overwrite to "
                "replace it"
            )


def _former(path: Path, points: Points, found: Mapping[str, Any]) -> Points:
    """Return the points that a store was made for: fewer, if the design has grown."""
    cases = found.get("cases")
    if cases == points.cases:
        return points
    if not points.grows or not isinstance(cases, int):
        raise _damaged(path, "the number of cases")
    say = f"{path} holds {cases} cases, design.number asks for {points.cases}"
    if cases > points.cases:
        raise InputError(f"{say}; a design grows and never shrinks: ask for more, or another store")
    if not points.extends(cases):
        raise InputError(
            f"{say}; a latin_hypercube grows by doubling: take {2 * cases}, {4 * cases}, ..."
        )
    return resized(points, cases)


def _check_attributes(path: Path, found: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
    """Refuse attributes that are not those of this study."""
    for key in sorted({*found, *wanted} - set(_LATER)):
        if found.get(key) != wanted.get(key):
            raise _damaged(path, f"{METADATA} ({key})")


def _kept(found: Mapping[str, Any], points: Points) -> dict[str, Any]:
    """Return the attributes that stay: all that is known later, but where the design has grown."""
    later = ("failed", "warnings", *TIMESTAMPS)
    names = ("created",) if found["cases"] != points.cases else later
    return {name: found[name] for name in names if name in found}


def _rows(path: Path, points: Points) -> int:
    """Return how many cases the blocks of a store have."""
    name, chunk = "reason", points.study.run_table.chunk
    try:
        rows = known.rows_of((path / name / METADATA).read_bytes())
    except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
        raise _damaged(path, name) from error
    if rows < 1 or (rows % chunk and rows != points.cases):
        raise _damaged(path, name)
    return rows


def _changed(path: Path, wanted: Documents) -> list[str]:
    """Return the documents that must be written anew; refuse those that can be no older ones."""
    changed = []
    for name, document in wanted.items():
        try:
            found = (path / name).read_bytes()
        except OSError as error:
            if known.is_array(name):
                raise _damaged(path, name.removesuffix(f"/{METADATA}")) from error
            found = b""
        if found == document or (name == METADATA and known.same(found, document)):
            continue
        if known.is_array(name) and not _is_older(found, document):
            raise _damaged(path, name.removesuffix(f"/{METADATA}"))
        changed.append(name)
    return changed


def _is_older(found: bytes, document: bytes) -> bool:
    try:
        return known.same_but_cases(found, document)
    except (ValueError, KeyError, TypeError, IndexError):
        return False


def remove(path: Path) -> None:
    """Remove a store; refuse to remove anything else."""
    try:
        ours = "store_format" in known.attributes_of((path / METADATA).read_bytes())
    except (OSError, ValueError):
        ours = False
    if not ours and not is_ledger(path):
        raise InputError(f"{path} is no store of a sweep and is kept; name another")
    try:
        shutil.rmtree(path)
    except OSError as error:
        raise InputError(cannot_write(path, error)) from error


def open_store(path: str | Path) -> xarray.Dataset:
    """Open a store as a Dataset; values are read when they are used.

    Raises
    ------
    InputError
        If it is no store of a sweep.
    """
    import_store()
    import xarray

    try:
        dataset = xarray.open_zarr(path, consolidated=True, chunks=None)
    except Exception as error:
        raise InputError(f"{path}: this is no store of a sweep; check the path") from error
    if "store_format" not in dataset.attrs:
        raise InputError(f"{path}: this is no store of a sweep; check the path")
    for name in _NEEDED:
        if name not in dataset.attrs:
            raise _damaged(Path(path), f"{METADATA} ({name})")
    return labelled(dataset)
