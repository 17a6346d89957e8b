"""Which build of antinode computed something: its version, its sources, the libraries below it."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Iterator
from functools import cache
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as version_of
from pathlib import Path
from typing import NamedTuple

from antinode.version import __version__

_PACKAGE = Path(__file__).parents[2]
_ROOMS = ("inputs", "riccati", "beam", "modes", "vehicle", "study/cases", "study/design")
"""What the numbers of a case come from, beside the modules of the ground."""
_LIBRARIES = ("numpy", "scipy", "numba")


class Build(NamedTuple):
    """What the numbers of a process come from.

    Attributes
    ----------
    version : str
        Of antinode.
    sources : str
        Hash of its sources from files to cases, those of the compiled kernel among them.
    libraries : str
        Python and the numerical libraries, with their versions.
    """

    version: str
    sources: str
    libraries: str

    def difference(self, other: Build) -> str:
        """Say in what another build differs, or nothing if the two are the same."""
        if other.version != self.version:
            return f"has antinode {other.version}, this is {self.version}"
        if other.sources != self.sources:
            return (
                f"has other sources of antinode {self.version} ({other.sources[:8]}, not "
                f"{self.sources[:8]})"
            )
        if other.libraries != self.libraries:
            return f"has {other.libraries}, this is {self.libraries}"
        return ""


@cache
def this_build() -> Build:
    """Return the build of this process."""
    return Build(__version__, sources_hash(), _libraries())


@cache
def sources_hash() -> str:
    """Return what stands for the sources that the numbers of a case come from."""
    found = hashlib.sha256()
    for path in _sources():
        found.update(path.relative_to(_PACKAGE).as_posix().encode())
        found.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return found.hexdigest()[:32]


def _sources() -> Iterator[Path]:
    yield from sorted(_PACKAGE.glob("*.py"))
    for room in _ROOMS:
        yield from sorted((_PACKAGE / room).rglob("*.py"))


def _libraries() -> str:
    told = [f"Python {platform.python_version()}"]
    for name in _LIBRARIES:
        try:
            told.append(f"{name} {version_of(name)}")
        except PackageNotFoundError:
            told.append(f"no {name}")
    return ", ".join(told)


def kernel_digest() -> str:
    """Return what stands for the machine code that this process computes with.

    One build has different ones on different processors: then numbers are the same within their
    stated errors, not to the last bit.
    """
    from antinode.riccati.lanes.library import LibraryError, library

    try:
        return library().digest[:16]
    except LibraryError:
        return ""
