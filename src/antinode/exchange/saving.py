"""Beams, modes and responses written by those who work in Python: the ending says as what."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from antinode.arguments import choice
from antinode.errors import InputError
from antinode.modes.solve import beam_of

from .formats import MODAL_ENDINGS, OUTPUTS
from .outputs import Modes, Notes, check_modal_output, write_beam, write_modes
from .responses import write_response
from .units import SYSTEMS, SystemName

if TYPE_CHECKING:
    from antinode.beam.beam import Beam
    from antinode.modes.result import ModalResult
    from antinode.modes.solve import HasBeam

_BEAMS = (".toml", ".csv", ".xlsx")


def save_beam(problem: Beam | HasBeam, path: str | Path) -> Notes:
    """Write a beam as a beam file (.toml), or a table of stations (.csv, .xlsx).

    Parameters
    ----------
    problem : Beam or BeamFile
    path : str or Path
        One of that name is replaced.

    Returns
    -------
    tuple of str
        What the file does not hold.

    Raises
    ------
    InputError
        If the ending is another, or the file cannot be written.
    """
    path = Path(path)
    ending = path.suffix.lower()
    if ending not in _BEAMS:
        more = f"; {ending} holds its modes: beam.modes().save(...)" * (ending in MODAL_ENDINGS)
        raise InputError(f"{path}: a beam is written as {', '.join(_BEAMS)}{more}")
    return write_beam(path, beam_of(problem), OUTPUTS[ending])


def save_modes(result: ModalResult, path: str | Path, *, units: SystemName = "SI") -> Notes:
    """Write modes, or a deck of their beam for another solver, by the ending.

    Parameters
    ----------
    result : ModalResult
    path : str or Path
        .csv, .json, .nc, .xlsx, .mat, .uff, .vtu, or a deck: .bdf (NASTRAN), .inp (CalculiX).
    units : {"SI", "mm-t-s", "mm-kg-ms", "in-lbf-s", "ft-lbf-s"}
        Of a deck, which does not say them itself.

    Returns
    -------
    tuple of str
        What the file does not hold, or not exactly.

    Raises
    ------
    InputError
        If the ending is another, or the file cannot be written.
    """
    path = Path(path)
    check_modal_output(path)
    choice("units", units, SystemName)
    return write_modes(path, Modes(result, result.to_dict()), system=SYSTEMS[units])


def save_response(result: Any, path: str | Path) -> None:
    """Write a response as .json, .csv (a table) or .uff (dataset 58).

    Raises
    ------
    InputError
        If the ending is another, or the file cannot be written.
    """
    write_response(Path(path), result)
