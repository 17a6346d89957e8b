"""The files of a store that are known before any case is solved: metadata and coordinates.

They follow from the study, so that a store which is there can be compared with what it must be.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from .blocks import LEVEL, fill_value
from .contents import Coordinate, Output

METADATA = "zarr.json"
Documents = dict[str, bytes]
"""Bytes by paths inside the store, with slashes."""


def documents(
    outputs: Mapping[str, Output],
    fixed: Mapping[str, Coordinate],
    attrs: Mapping[str, Any],
    rows: int,
) -> Documents:
    """Return the files of an empty store.

    Parameters
    ----------
    outputs : mapping
        What is written block by block.
    fixed : mapping
        Coordinates that are known.
    attrs : mapping
        Of the group.
    rows : int
        Cases of a block.
    """
    import zarr
    from zarr.storage import MemoryStore

    kept: dict[str, Any] = {}
    group = zarr.open_group(MemoryStore(kept), mode="w", zarr_format=3)
    for name, output in outputs.items():
        _add_output(group, name, output, rows)
    for name, coordinate in fixed.items():
        _add_coordinate(group, name, coordinate)
    found = {path: bytes(data.to_bytes()) for path, data in kept.items()}
    arrays = {
        path.removesuffix(f"/{METADATA}"): json.loads(data)
        for path, data in found.items()
        if path.endswith(f"/{METADATA}")
    }
    return {**found, METADATA: group_document(attrs, arrays)}


def group_document(attrs: Mapping[str, Any], arrays: Mapping[str, Any]) -> bytes:
    """Return the metadata of the group, with those of its arrays in one place.

    What xarray takes for coordinates stands in an attribute of its own; a name with a space in it
    cannot stand there.
    """
    inputs = [name for name in attrs["input_names"] if " " not in name]
    whole = {
        "attributes": {**attrs, "coordinates": " ".join(inputs)},
        "zarr_format": 3,
        "consolidated_metadata": {
            "kind": "inline",
            "must_understand": False,
            "metadata": {name: arrays[name] for name in sorted(arrays)},
        },
        "node_type": "group",
    }
    return json.dumps(whole, indent=1).encode()


def _add_output(group: Any, name: str, output: Output, rows: int) -> None:
    from zarr.codecs import ZstdCodec

    group.create_array(
        name,
        shape=output.shape,
        chunks=(rows, *output.shape[1:]),
        dtype=output.dtype,
        compressors=[ZstdCodec(level=LEVEL, checksum=True)],
        fill_value=fill_value(output),
        dimension_names=output.dims,
        attributes=output.attrs,
    )


def _add_coordinate(group: Any, name: str, coordinate: Coordinate) -> None:
    texts = coordinate.values.dtype.kind in "OU"
    array = group.create_array(
        name,
        shape=coordinate.values.shape,
        dtype=str if texts else coordinate.values.dtype,
        chunks=coordinate.values.shape,
        dimension_names=(coordinate.dim,),
        attributes=coordinate.attrs,
    )
    array[:] = coordinate.values.astype(object) if texts else coordinate.values


def cases_of(document: bytes) -> int:
    """Return along how many cases an array runs."""
    return int(json.loads(document)["shape"][0])


def rows_of(document: bytes) -> int:
    """Return how many cases a block of an array has."""
    return int(json.loads(document)["chunk_grid"]["configuration"]["chunk_shape"][0])


def same_but_cases(one: bytes, other: bytes) -> bool:
    """Tell whether two documents of arrays differ in nothing but the number of cases."""
    found = []
    for document in (one, other):
        whole = json.loads(document)
        whole["shape"][0] = 0
        found.append(whole)
    return bool(found[0] == found[1])


def same(one: bytes, other: bytes) -> bool:
    """Tell whether two documents say the same."""
    try:
        return bool(json.loads(one) == json.loads(other))
    except ValueError:
        return False


def attributes_of(document: bytes) -> dict[str, Any]:
    """Return the attributes of a group.

    Raises
    ------
    ValueError
        If the document is none.
    """
    whole = json.loads(document)
    attrs = whole.get("attributes") if isinstance(whole, dict) else None
    if not isinstance(attrs, dict):
        raise ValueError("no metadata of a group")
    return attrs


def is_array(path: str) -> bool:
    """Tell whether a document is that of an array."""
    return path.endswith(f"/{METADATA}")


def plain(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return attributes as JSON gives them back."""
    found: dict[str, Any] = json.loads(json.dumps(values, default=_number))
    return found


def _number(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else list(value)
