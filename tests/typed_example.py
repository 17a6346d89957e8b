"""What a user's script looks like to a type checker; `test_typing.py` has it checked."""

from typing import assert_type

import numpy as np
import numpy.typing as npt

import antinode as an

steel = an.Material(youngs_modulus="210 GPa", density="7850 kg/m^3")
pipe = an.Section(steel, outer_diameter="168.3 mm", wall=0.0071)
beam = an.Beam(
    x=[0, 4, 10],
    mass_per_length=["10 kg/m", "9 kg/m", "8 kg/m"],
    bending_stiffness=np.array([3e6, 2.5e6, 2e6]),
    axial_force=1e3,
    interpolation="linear",
    ends=an.Ends("clamped"),
).with_attachments(an.PointMass(10.0, 20.0), an.Spring(4.0, translational=5e4))
assert_type(beam, an.Beam)
assert_type(beam.x, npt.NDArray[np.float64])
assert_type(an.drawn_beam([0, 6], steel, outer_diameter=0.2), an.Beam)
assert_type(pipe.columns, dict[str, float])

modes = beam.modes(3, unloaded=True)
assert_type(modes, an.ModalResult)
assert_type(modes.mode("bending", 1).frequency_hz, float)
assert_type(an.solve_modes(beam), an.ModalResult)
assert_type(beam.buckling(), an.Buckling | None)
assert_type(beam.stability(), an.Stability)
assert_type(beam.frequencies(2), an.Frequencies)
critical = beam.buckling()
factor: float = critical.load_factor if critical else 0.0
modes.save("modes.csv")
for axes in modes.plot():
    axes.set_xlabel("x [m]")

case = an.load_case("case.toml")
assert_type(case.modes(), an.ModalResult)
assert_type(case.loads(), an.Loads)
assert_type(case.loads.drag, float)
study = an.load_study("study.toml")
frequencies = study.run(workers=2)["frequency_hz"]
