"""What a beam carries, kind by kind."""
