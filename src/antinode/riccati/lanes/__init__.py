"""The compiled form: eight omega^2, or eight modes, side by side."""
