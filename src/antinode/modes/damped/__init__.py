"""Complex modes of a beam: eigenvalues s, refined, named, with shapes."""
