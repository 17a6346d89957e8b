"""What a type checker must refuse; `test_typing.py` counts the lines that end in "# wrong"."""

import antinode as an

an.Beam([0, 1], 1.0, 1.0, interpolation="cubic")  # wrong
an.Ends("glued")  # wrong
an.Section(0.2)  # wrong
an.Beam([0, 1], 1.0, 1.0).modes(families="bendin")  # wrong
print(an.Beam([0, 1], 1.0, 1.0).modes(2).frequency)  # wrong
an.solve_modes("beam.toml")  # wrong
