"""The commands that run studies: their arguments, their help and what each of them does."""

from __future__ import annotations

from pathlib import Path

from .options import Json
from .study_options import Folder, IdentifySet, Overwrite, Sensitivity, StudySet, Sweep

_SWEEP, _SENSITIVITY = Sweep(), Sensitivity()


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


def sensitivity(
    file: Path,
    /,
    *,
    set_: StudySet = (),
    options: Sensitivity = _SENSITIVITY,
) -> None:
    """Compute which inputs the frequencies depend on, and how uncertain they make them.

    For every mode: mean, deviation and 95 % band over the distributions of the inputs, Sobol
    indices (first order and total, with 95 % intervals), and the derivative at the case in % per %.

    - Example: **antinode sensitivity case.toml --uncertain speed=2% --uncertain thrust=5%**
    - Example: **antinode sensitivity samples.toml --samples 2048 --plot tornado.png**

    Parameters
    ----------
    file
        A study file whose inputs have distributions; or a case file, with --uncertain.
    """
    from antinode.study.sensitivity.command import run_sensitivity

    run_sensitivity(file, set_, **vars(options))


def identify(
    file: Path,
    /,
    *,
    set_: IdentifySet = (),
    folder: Folder = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> None:
    """Find the parameters of a vehicle that explain observed frequencies.

    The file names a case, observations of it, and what of it may change: numbers, numbers of every
    row, and distributions along the body. Printed are observed against fitted frequencies, values
    with standard deviations, and what the data leave open. Ctrl-C ends it with the best values so
    far (exit code 130).

    - Example: **antinode identify identify.toml -o fitted**
    - Example: **antinode identify identify.toml --set fit.starts=8 --json**

    Parameters
    ----------
    file
        An identification file in TOML. 'antinode schema identify' lists its keys.
    """
    from antinode.study.identify.command import run_identification

    run_identification(file, set_, folder, overwrite=overwrite, json=json)
