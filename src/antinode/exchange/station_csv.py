"""Stations of a beam as CSV; `beam/station_csv.py` says how, and reads them."""

from __future__ import annotations

from collections.abc import Mapping

from antinode.arrays import Array
from antinode.beam.beam import Beam
from antinode.inputs.reading import COLUMN_UNITS

from .beam_toml import shear_keys
from .tabulated import Hull, Stations, tabulate


def station_csv(beam: Beam, hull: Hull) -> tuple[str, tuple[str, ...]]:
    """Return the stations of a beam as CSV, and notes on what it leaves out."""
    stations = tabulate(beam).with_hull(hull)
    return csv_text(stations, shear_keys(beam)), (*stations.notes, *left_out(beam))


def csv_text(stations: Stations, shear: Mapping[str, str]) -> str:
    """Return stations, with keys for shear, as the text of a CSV file; all digits are kept."""
    header = ",".join(f"{name} [{COLUMN_UNITS[name]}]" for name in stations.columns)
    columns: list[Array] = list(stations.columns.values())
    rows = [",".join(repr(float(c[k])) for c in columns) for k in range(len(columns[0]))]
    said: dict[str, object] = {"interpolation": stations.interpolation, **shear}
    if stations.material is not None:
        said |= stations.material.model_dump(exclude_none=True)
    lines = [f'# {key} = "{value}"' for key, value in said.items()]
    return "\n".join([*lines, header, *rows]) + "\n"


def left_out(beam: Beam) -> tuple[str, ...]:
    """Say what a table of stations leaves out of a beam."""
    notes = []
    if beam.attachments:
        n = len(beam.attachments)
        text = f"{n} attachment is" if n == 1 else f"{n} attachments are"
        notes.append(f"{text} left out; write a .toml or .xlsx to keep them")
    if (beam.ends.left, beam.ends.right) != ("free", "free"):
        ends = f"{beam.ends.left} - {beam.ends.right}"
        notes.append(f"the ends, {ends}, are left out; write a .toml or .xlsx to keep them")
    if any(beam.following()):
        ends = f"{beam.ends.left_follower:g}, right_follower = {beam.ends.right_follower:g}"
        notes.append(f"left_follower = {ends} are left out; write a .toml or .xlsx to keep them")
    return tuple(notes)
