"""Universal files: measured modes and frequency responses in, modes out."""
