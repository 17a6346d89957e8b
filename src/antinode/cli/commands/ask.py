"""`antinode ask`: answers of a sweep that is done."""

from __future__ import annotations

from pathlib import Path

from antinode.cli.study_options import Ask, StudySet

_ASK = Ask()


def ask(
    file: Path,
    /,
    *,
    set_: StudySet = (),
    options: Ask = _ASK,
) -> None:
    """Ask the cases of a sweep: shares, worst cases, quantiles, a map, a search for the worst.

    Formulas name inputs and outputs; f1, f2, ... are the frequencies [Hz], omega2[1] any output of
    a mode. Numbers are SI, a text carries its unit: 'thrust < "80 kN" and f1 > 5'.

    - Example: **antinode ask sweep.zarr --share 'f1 > 5' --smallest f1**
    - Example: **antinode ask sweep.zarr --define 'gap = f2 - f1' --quantiles gap**
    - Example: **antinode ask study.toml --smallest f1 --search**
    - Example: **antinode ask sweep.zarr --map 'speed, thrust, f1' --plot map.png**

    Parameters
    ----------
    file
        The store of a sweep; or a study file, which is solved first.
    """
    from antinode.study.answers.command import run_ask

    run_ask(file, set_, **vars(options))
