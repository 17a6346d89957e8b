"""NASTRAN decks: cards -> model -> line -> properties, attached, preload -> beam; and back."""
