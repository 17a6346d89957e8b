"""The command `antinode`: its commands, each imported when it runs or when its help is shown."""

from __future__ import annotations

from cyclopts import App

from antinode.version import __version__

app = App(
    name="antinode",
    version=__version__,
    help_format="markdown",
    suppress_keyboard_interrupt=False,
    help="""Natural frequencies and modes of slender vehicles in motion, and of any beam.

Start with **antinode init** and **antinode modes case.toml**, or with **antinode init --beam** and
**antinode beam beam.toml**.

Input files are TOML. Numbers are SI, angles in radians; a text carries its own unit: "80 mm",
"10 deg", "50 kN". Tables along the axis may be CSV files. **antinode schema** lists every key.
""",
)

COMMANDS = {
    "init": ("init:init", 1),
    "modes": ("modes:modes", 2),
    "loads": ("loads:loads", 3),
    "beam": ("beam:beam", 4),
    "schema": ("schema:schema", 5),
    "verify": ("verify:verify", 6),
    "reproduce": ("reproduce:reproduce", 7),
    "sweep": ("sweep:sweep", 8),
    "ask": ("ask:ask", 8),
    "sensitivity": ("sensitivity:sensitivity", 9),
    "identify": ("identify:identify", 10),
    "convert": ("convert:convert", 11),
    "app": ("page:page", 12),
    "report": ("report:report", 13),
    "response": ("response:response", 14),
    "stability": ("stability:stability", 15),
}
"""Where each command stands under `cli/commands`, and its place in the help."""

for _name, (_place, _key) in COMMANDS.items():
    app.command(f"antinode.cli.commands.{_place}", name=_name, sort_key=_key)
app.command("antinode.cli.commands.completion:install_completion", name="--install-completion")


def import_all() -> None:
    """Import all commands, so that the list of them says what each does."""
    for name in (*COMMANDS, "--install-completion"):
        _ = app[name]
