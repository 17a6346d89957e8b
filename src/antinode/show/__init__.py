"""Results for people and other programs: printing, figures, tables, schemas."""
