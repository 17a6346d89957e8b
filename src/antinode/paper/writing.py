"""Writing the reproduction into a folder: every figure in three formats, and the page."""

from __future__ import annotations

from pathlib import Path

from antinode.errors import InputError
from antinode.show.figures import pyplot

from .comparison import Comparison
from .gallery import PLATES
from .page import page
from .plates import publish
from .scene import Scene

PAGE = "index.html"


def check_folder(folder: Path) -> None:
    """Make the folder; raise InputError if nothing can be drawn or written there."""
    pyplot()
    probe = folder / f".{PAGE}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe.touch()
        probe.unlink()
    except (OSError, ValueError) as error:
        raise _cannot_write(folder, error) from error


def write_all(comparison: Comparison, folder: Path) -> Path:
    """Write all figures and the page; files of the same names are written over.

    Returns
    -------
    Path
        The page.
    """
    scene, target = Scene(comparison), folder / PAGE
    try:
        drawings = [(plate, *publish(plate, scene, folder)) for plate in PLATES]
        target.write_text(page(comparison, drawings), encoding="utf-8")
    except OSError as error:
        raise _cannot_write(folder, error) from error
    return target


def _cannot_write(folder: Path, error: Exception) -> InputError:
    reason = getattr(error, "strerror", None) or str(error)
    return InputError(
        f"--out: the folder '{str(folder)[:200]}' cannot be written ({reason}); name another folder"
    )
