"""The response of each case of a study, without files beside it: it travels, and is hashed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from antinode.errors import InputError
from antinode.response.equipment import items_of
from antinode.response.file import Problem, ResponseFile, load_response
from antinode.response.histories import history_from
from antinode.response.spectra import Spectrum, spectrum_from
from antinode.response.units import spectral


def read_response(path: Path, case: Path) -> ResponseFile:
    """Read a response file that is of the case, or beam, of a study.

    Raises
    ------
    InputError
        If it is of another one, or anything in it is wrong.
    """
    problem = load_response(path)
    of = problem.folder / problem.file.response.of
    if of.resolve() != case.resolve():
        raise InputError(
            f"{path}: response.of is {of}, but the study's case is {case}: name the same file in "
            "both"
        )
    return inlined(problem)


def inlined(problem: Problem) -> ResponseFile:
    """Return the file of a problem, its spectra and histories as tables in SI.

    Raises
    ------
    InputError
        If one of the files that it names is not as it must be.
    """
    file = problem.file
    forces = tuple(
        table.model_copy(update=_driven(problem, f"forces.{k}", table, drive.unit))
        for k, (table, drive) in enumerate(zip(file.forces, file.drives, strict=False))
    )
    base = file.base
    if base is not None:
        base = base.model_copy(update=_driven(problem, "base", base, file.drives[-1].unit))
    items = items_of(problem, "psd" if file.response.kind == "random" else "amplitude")
    equipment = tuple(
        table.model_copy(update={"allowed": _points(item.allowed)})
        for table, item in zip(file.equipment, items, strict=True)
    )
    return file.model_copy(update={"forces": forces, "base": base, "equipment": equipment})


def _driven(problem: Problem, name: str, table: Any, unit: str) -> dict[str, Any]:
    """Return what replaces the files of a force, or of the base: those that its kind asks for."""
    where = f"{problem.where}: {name}"
    kind = problem.file.response.kind
    if kind == "random":
        spectrum = spectrum_from(table.psd, spectral(unit), problem.folder, f"{where}.psd")
        return {"psd": _points(spectrum), "history": None}
    if kind in ("transient", "shock") and isinstance(table.history, str):
        own = history_from(table.history, unit, problem.folder, f"{where}.history")
        return {"history": {"time": own.time_s.tolist(), "value": own.value.tolist()}, "psd": None}
    return {} if kind != "harmonic" else {"psd": None, "history": None}


def _points(spectrum: Spectrum) -> dict[str, list[float]]:
    return {"frequency": spectrum.frequency_hz.tolist(), "level": spectrum.level.tolist()}
