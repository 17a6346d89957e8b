"""`antinode --install-completion`."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from antinode.cli.app import app, import_all
from antinode.errors import InputError
from antinode.show.outcome import say_written

Shell = Literal["bash", "zsh", "fish", "powershell"]


def install_completion(shell: Shell | None = None, /, *, output: Path | None = None) -> None:
    """Let the shell complete commands and options.

    Writes the completions where the shell looks for them, and a line into its start-up file that
    loads them; the next shell has them.

    - Example: **antinode --install-completion**
    - Example: **antinode --install-completion zsh**

    Parameters
    ----------
    shell
        bash, zsh, fish or powershell; by default the one that runs.
    output
        Write the completions into this file alone, and touch no start-up file.
    """
    from cyclopts.completion.detect import ShellDetectionError

    import_all()
    try:
        written = app.install_completion(shell=shell, output=output, add_to_startup=output is None)
    except ShellDetectionError as error:
        raise InputError(
            "which shell this is cannot be told; name it: antinode --install-completion bash"
        ) from error
    except OSError as error:
        place = error.filename or output
        raise InputError(
            f"{place} cannot be written ({error.strerror or error}); name a file with --output"
        ) from error
    say_written(written)
