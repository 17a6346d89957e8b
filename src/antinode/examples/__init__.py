"""Examples that ship with antinode, as `antinode init` writes them."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from shlex import quote

from antinode.errors import InputError

EXAMPLES = {
    "starter": "antinode modes {folder}case.toml",
    "paper": "antinode modes {folder}case.toml",
    "sweep": "antinode sweep {folder}study.toml --plot {folder}sweep.png",
    "mast": "antinode sweep {folder}study.toml",
    "beam": "antinode beam {folder}beam.toml",
    "drawing": "antinode beam {folder}beam.toml",
    "tower": "antinode beam {folder}beam.toml",
    "rocket": "antinode beam {folder}beam.toml",
    "drill_string": "antinode beam {folder}beam.toml",
    "shaft": "antinode beam {folder}beam.toml",
    "response": "antinode response {folder}response.toml",
}
"""Name of each example and the command to run next."""


def write_example(name: str, folder: Path) -> tuple[list[Path], str]:
    """Write an example into a folder, all its files or none; never over a file that exists.

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
        raise InputError(f"there is no example '{name[:40]}'; allowed are {', '.join(EXAMPLES)}")
    texts = {folder / file: text for file, text in _texts(name).items()}
    try:
        for path in texts:
            if path.exists():
                raise InputError(f"{path} exists already and is kept; name another folder")
        folder.mkdir(parents=True, exist_ok=True)
        _write(texts)
    except InputError:
        raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"the folder '{str(folder)[:200]}' cannot be written ({reason}); name another folder"
        ) from error
    prefix = "" if folder == Path() else f"{folder.as_posix()}/"
    return list(texts), EXAMPLES[name].format(folder=quote(prefix) if prefix else "")


def _texts(name: str) -> dict[str, str]:
    """Return the files of an example: names and contents."""
    from importlib.resources import files

    sources = sorted(files(__package__).joinpath(name).iterdir(), key=lambda file: file.name)
    return {source.name: source.read_text(encoding="utf-8") for source in sources}


def _write(texts: dict[Path, str]) -> None:
    """Write new files; remove them again if one cannot be written."""
    written: list[Path] = []
    try:
        for path, text in texts.items():
            with path.open("x", encoding="utf-8") as file:
                written.append(path)
                file.write(text)
    except OSError:
        for path in written:
            with suppress(OSError):
                path.unlink()
        raise
