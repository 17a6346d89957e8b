"""Examples that ship with antinode, as `antinode init` writes them."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from antinode.errors import InputError

EXAMPLES = {
    "starter": "antinode modes {folder}case.toml",
    "beam": "antinode beam {folder}beam.toml",
    "tower": "antinode beam {folder}beam.toml",
    "rocket": "antinode beam {folder}beam.toml",
    "drill_string": "antinode beam {folder}beam.toml",
    "shaft": "antinode beam {folder}beam.toml",
}
"""Name of each example and the command to run next."""


def write_example(name: str, folder: Path) -> tuple[list[Path], str]:
    """Write an example into a folder; touch nothing if one of its files exists already.

    Parameters
    ----------
    name : str
        A key of `EXAMPLES`.
    folder : Path
        Made if it does not exist.

    Returns
    -------
    list of Path
        The files written.
    str
        The command to run next.

    Raises
    ------
    InputError
        If there is no such example, a file exists already, or the folder cannot be written.
    """
    if name not in EXAMPLES:
        raise InputError(f"there is no example '{name}'; allowed are {', '.join(EXAMPLES)}")
    sources = sorted(files(__package__).joinpath(name).iterdir(), key=lambda f: f.name)
    texts = {folder / source.name: source.read_text(encoding="utf-8") for source in sources}
    for path in texts:
        if path.exists():
            raise InputError(f"{path} exists already and is kept; name another folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for path, text in texts.items():
            with path.open("x", encoding="utf-8") as file:
                file.write(text)
    except OSError as error:
        raise InputError(f"{folder}: cannot be written ({error.strerror or error})") from error
    prefix = "" if folder == Path() else f"{folder.as_posix()}/"
    return list(texts), EXAMPLES[name].format(folder=prefix)
