"""`python -m antinode` is the command `antinode`."""

from .cli import main

main()
