"""How modes move: exactly from point to point, and where forces depend on motion."""
