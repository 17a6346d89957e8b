"""`antinode sweep`: the frequencies of many cases."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.study_options import StudySet, Sweep

_SWEEP = Sweep()


def sweep(
    study: Path,
    /,
    *,
    set_: StudySet = (),
    options: Sweep = _SWEEP,
) -> None:
    """Compute the frequencies of many cases: grids, tables, time histories, samples.

    The study file names a case, the inputs of it that vary, and how. With a store, **-o
    sweep.zarr**, an interrupted sweep goes on where it was, whatever ended it: run the same command
    again. Cases that fail are NaN with a reason. Exit code 1 if all cases fail.

    - Example: **antinode sweep study.toml --plot sweep.png**
    - Example: **antinode sweep study.toml -o sweep.zarr --workers 2**
    - Example: **antinode sweep study.toml -o sweep.zarr --scheduler tcp://cluster:8786**

    Parameters
    ----------
    study
        A study file in TOML. 'antinode init --example sweep' writes one with its case.
    """
    from antinode.study.sweep.command import run_sweep

    run_sweep(study, set_, **vars(options))
