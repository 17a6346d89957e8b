"""From a beam to certified frequencies, modes, batches of them, and buckling."""
