"""Objects as those who work in Python see them: in a line, as a card, a table, axes."""
