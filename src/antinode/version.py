"""The version of antinode: in files and reports, and what `antinode --version` prints."""

__version__ = "0.1.0"
