"""The ledger of a store: which blocks are done, one line each, appended when they are on the disk.

A line that was torn, or damaged, counts for nothing: its block is computed again.
"""

from __future__ import annotations

import json
import zlib
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from .disk import append_lasting, own_folder

_TITLE = {"ledger": "of a sweep of antinode"}


@dataclass(frozen=True)
class Record:
    """What the ledger knows of a block.

    Attributes
    ----------
    block : int
    cases : int
        How many it has.
    digest : str
        Of the bytes of its files.
    files : tuple of tuple
        Size and time of change [ns] of each file: where these are the same, so are the bytes.
    kernel : str
        The machine code that computed it.
    """

    block: int
    cases: int
    digest: str
    files: tuple[tuple[int, int], ...]
    kernel: str


class Ledger:
    """The ledger of a store that is there.

    Parameters
    ----------
    store : Path
    """

    def __init__(self, store: Path) -> None:
        self.path = ledger_of(store)
        self.records: dict[int, Record] = {}
        data = self.path.read_bytes() if self.path.exists() else b""
        for line in data.splitlines():
            found = _record(_unpacked(line))
            if found is not None:
                self.records[found.block] = found
        if data and not data.endswith(b"\n"):
            append_lasting(self.path, b"\n")

    def add(self, record: Record) -> None:
        """Enter a block whose files are on the disk."""
        append_lasting(self.path, _packed(asdict(record)))
        self.records[record.block] = record


def ledger_of(store: Path) -> Path:
    """Return the file of the ledger."""
    return own_folder(store) / "ledger"


def first_line() -> bytes:
    """Return what a new ledger begins with."""
    return _packed(_TITLE)


def is_ledger(store: Path) -> bool:
    """Tell whether a folder has a ledger, whatever else of it is lost."""
    try:
        with ledger_of(store).open("rb") as handle:
            return _unpacked(handle.readline(1000).rstrip(b"\n")) == _TITLE
    except OSError:
        return False


def _packed(values: dict[str, Any]) -> bytes:
    text = json.dumps(values, separators=(",", ":")).encode()
    return b"%08x %s\n" % (zlib.crc32(text), text)


def _unpacked(line: bytes) -> dict[str, Any] | None:
    check, _, text = line.partition(b" ")
    if check != b"%08x" % zlib.crc32(text):
        return None
    found = json.loads(text)
    return found if isinstance(found, dict) else None


def _record(values: dict[str, Any] | None) -> Record | None:
    if values is None or "block" not in values:
        return None
    files = tuple((int(size), int(time)) for size, time in values["files"])
    return Record(**{**values, "files": files})
