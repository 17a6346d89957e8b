"""The mesh of a deck: a beam cut into uniform elements, and what finite elements find on it."""
