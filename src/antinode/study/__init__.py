"""Studies of a case: identification of its parameters from observed frequencies."""
