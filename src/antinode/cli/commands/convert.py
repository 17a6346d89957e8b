"""`antinode convert`: from one file format to another."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.options import BeamSet, Exchange, FromFormat, ToFormat
from antinode.show.outcome import say_notes, say_written

_EXCHANGE = Exchange()


def convert(
    source: Path,
    target: Path,
    /,
    *,
    from_: FromFormat = "",
    to: ToFormat = "",
    set_: BeamSet = (),
    exchange: Exchange = _EXCHANGE,
) -> None:
    """Convert a beam, or measurements, from one file format to another.

    The endings say which. Read are .toml, .csv, .xlsx, NASTRAN's .bdf, .nas and .fem, tables of
    sections of BModes and ElastoDyn in .dat, main files of BModes in .bmi, and measurements in .uff
    and .unv. Written are the
    beam as .toml, .csv or .xlsx, its modes as .json, .nc, .mat, .uff or .vtu, decks for solvers as
    .bdf (NASTRAN) and .inp (CalculiX), and measurements as observations for **antinode identify**
    in .toml, .csv or .json.

    - Example: **antinode convert beam.toml beam.bdf --units mm-t-s**
    - Example: **antinode convert tower.dat tower.toml --length 87.6m --set beam.ends.left=clamped**
    - Example: **antinode convert measured.uff observations.csv**

    Parameters
    ----------
    source
        The file to read.
    target
        The file to write; one of that name is replaced.
    """
    from antinode.exchange.convert import Request
    from antinode.exchange.convert import convert as run

    choices, modes = exchange.choices(set_), exchange.modes
    say_notes(run(Request(source, target, from_, to, choices, modes, exchange.analysis)))
    say_written(target)
