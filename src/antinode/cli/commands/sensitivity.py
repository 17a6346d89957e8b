"""`antinode sensitivity`: what the frequencies depend on."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.study_options import Sensitivity, StudySet

_SENSITIVITY = Sensitivity()


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
        A study file whose inputs have distributions; or a case or beam file, with --uncertain.
    """
    from antinode.study.sensitivity.command import run_sensitivity

    run_sensitivity(file, set_, **vars(options))
