"""Lists of eigenvalues proven in ball arithmetic: complex numbers that carry their own error."""
