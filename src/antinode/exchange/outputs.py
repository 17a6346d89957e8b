"""Writing a beam or its modes: the ending, or a name, says in which format."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from antinode.beam.beam import Beam
from antinode.beam.families import BENDING, FAMILIES
from antinode.extras import import_extra
from antinode.modes.result import ModalResult
from antinode.show.tables import modal_table
from antinode.show.writing import check_output, write_result, write_whole

from .formats import MODAL_ENDINGS, MODAL_FORMATS, Format, format_of
from .mesh.analyses import Analysis
from .tabulated import Hull
from .units import SI, System

Notes = tuple[str, ...]


@dataclass(frozen=True)
class Modes:
    """A modal result with its dictionary, as the commands print it."""

    result: ModalResult
    data: dict[str, Any]


def check_modal_output(path: Path) -> None:
    """Raise InputError if modes cannot be written to this file, before any work is done."""
    check_output(path, MODAL_ENDINGS)
    check_libraries(MODAL_FORMATS[path.suffix.lower()])


def write_modes(
    path: Path,
    modes: Modes,
    how: Format | None = None,
    system: System = SI,
    analysis: Analysis = "modes",
) -> Notes:
    """Write modes in the format of the ending, or in another one.

    Parameters
    ----------
    path : Path
    modes : Modes
    how : str, optional
        Name of the format.
    system : System
        Units of a file that does not say them itself.
    analysis : {"modes", "unloaded", "statsub", "buckling"}
        What a solver is to do with a deck.

    Returns
    -------
    tuple of str
        What the file does not hold, or not exactly.
    """
    how = how or format_of(path, MODAL_FORMATS)
    result = modes.result
    lost: Notes = ()
    if how in ("nastran", "calculix"):
        result, lost = _slender(result)
    if how in ("csv", "json", "netcdf"):
        table = lambda: modal_table(result)  # noqa: E731
        write_result(path, modes.data, table, result.to_dataset, _KINDS[how])
        return ()
    writers: dict[str, Callable[[Path], Notes]] = {
        "xlsx": lambda p: _xlsx(p, result.beam, result, {}),
        "mat": lambda p: _mat(p, result),
        "vtk": lambda p: _vtk(p, result),
        "uff": lambda p: _uff(p, result),
        "nastran": lambda p: _nastran(p, result, system, analysis),
        "calculix": lambda p: _calculix(p, result, system, analysis),
    }
    return (*lost, *_whole(path, writers[how]))


def _slender(result: ModalResult) -> tuple[ModalResult, Notes]:
    """Return the modes of the beam that a deck can hold, and a note on what it leaves out."""
    used = FAMILIES[BENDING].used(result.beam)
    if not used:
        return result, ()
    from antinode.modes.solve import solve_modes

    plain = replace(
        result.beam,
        theory="euler_bernoulli",
        foundation_stiffness=None,
        added_mass_per_length=None,
        tangential_load=None,
    )
    number = max((mode.number for mode in result.modes), default=1)
    solved = solve_modes(
        plain,
        max(number, 1),
        tolerance=result.tolerance,
        families=result.families,
        normalisation=result.normalisation,
        unloaded=True,
        damping="none",
    )
    return solved, (f"{', '.join(used)}: left out of the deck, and of the frequencies it states",)


_KINDS = {"csv": ".csv", "json": ".json", "netcdf": ".nc"}


def write_beam(path: Path, beam: Beam, how: Format, hull: Hull | None = None) -> Notes:
    """Write a beam alone: as a beam file, a table of stations or a workbook.

    The last two also hold the columns of a hull.
    """
    columns = hull or {}
    writers: dict[str, Callable[[Path], Notes]] = {
        "toml": lambda p: _toml(p, beam),
        "csv": lambda p: _csv(p, beam, columns),
        "xlsx": lambda p: _xlsx(p, beam, None, columns),
    }
    return _whole(path, writers[how])


def _whole(path: Path, write: Callable[[Path], Notes]) -> Notes:
    notes: list[str] = []
    write_whole(path, lambda partial: notes.extend(write(partial)))
    return tuple(notes)


def check_libraries(how: Format) -> None:
    """Raise InputError if a library for a format is missing."""
    if how == "xlsx":
        import_extra("openpyxl", "exchange")


def _toml(path: Path, beam: Beam) -> Notes:
    from .beam_toml import beam_file_text

    text, notes = beam_file_text(beam)
    path.write_text(text, encoding="utf-8")
    return notes


def _csv(path: Path, beam: Beam, hull: Hull) -> Notes:
    from .station_csv import station_csv

    text, notes = station_csv(beam, hull)
    path.write_text(text, encoding="utf-8")
    return notes


def _xlsx(path: Path, beam: Beam, result: ModalResult | None, hull: Hull) -> Notes:
    from .workbook import write_workbook

    return write_workbook(path, beam, result, hull)


def _mat(path: Path, result: ModalResult) -> Notes:
    from .matlab import write_mat

    return write_mat(path, result)


def _vtk(path: Path, result: ModalResult) -> Notes:
    from .vtk import write_vtu

    return write_vtu(path, result)


def _uff(path: Path, result: ModalResult) -> Notes:
    from .uff.writer import write_uff

    return write_uff(path, result)


def _nastran(path: Path, result: ModalResult, system: System, analysis: Analysis) -> Notes:
    from .nastran.writer import write_nastran

    return write_nastran(path, result, system, analysis)


def _calculix(path: Path, result: ModalResult, system: System, analysis: Analysis) -> Notes:
    from .calculix import write_calculix

    return write_calculix(path, result, system, analysis)
