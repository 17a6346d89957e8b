"""Studies from TOML, without files."""

import tomllib

from antinode.study.design.file import Study


def study(case, text):
    """The study that a text says, of a case."""
    return Study.model_validate({**tomllib.loads(text), "case": case})
