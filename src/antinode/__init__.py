"""antinode: natural vibration of slender vehicles in motion, and of any beam."""

__version__ = "0.1.0"
