"""Factors of the units that most files are written in, as pint gives them.

Importing pint and its definitions takes as long as everything else that a command needs. A unit
that does not stand here is asked of pint, and a test asks it for those that do.
"""

FACTORS: dict[str, dict[str, float]] = {
    "m": {"mm": 0.001, "cm": 0.01, "km": 1000.0, "inch": 0.0254, "in": 0.0254},
    "kg": {"g": 0.001, "t": 1000.0},
    "s": {"ms": 0.001, "min": 60.0, "h": 3600.0},
    "rad": {"deg": 0.017453292519943295, "mrad": 0.001},
    "Hz": {"kHz": 1000.0},
    "": {"%": 0.01},
    "m/s": {"km/h": 0.2777777777777778, "km/s": 1000.0, "mm/s": 0.001},
    "m/s^2": {"mm/s^2": 0.001},
    "N": {"mN": 0.001, "kN": 1000.0, "MN": 1000000.0, "GN": 1000000000.0},
    "Pa": {
        "hPa": 100.0,
        "kPa": 1000.0,
        "MPa": 1000000.0,
        "GPa": 1000000000.0,
        "bar": 100000.0,
        "mbar": 100.0,
    },
    "Pa s": {"mPa s": 0.001},
    "kg/m": {"g/m": 0.001, "t/m": 1000.0, "kg/mm": 1000.0},
    "kg/m^3": {"t/m^3": 1000.0},
    "m^2": {"mm^2": 1e-06, "cm^2": 0.0001},
    "m^4": {"mm^4": 1e-12, "cm^4": 1e-08},
    "kg m^2": {"g m^2": 0.001, "t m^2": 1000.0},
    "N m^2": {"kN m^2": 1000.0, "MN m^2": 1000000.0, "GN m^2": 1000000000.0, "N mm^2": 1e-06},
    "N/m": {"kN/m": 1000.0, "MN/m": 1000000.0, "GN/m": 1000000000.0, "N/mm": 1000.0},
    "N m/rad": {"kN m/rad": 1000.0, "MN m/rad": 1000000.0, "GN m/rad": 1000000000.0},
    "rad/(N m)": {"rad/(kN m)": 0.001, "rad/(MN m)": 1e-06},
    "m/N": {"mm/N": 0.001, "m/kN": 0.001, "mm/kN": 1e-06},
}
"""To an SI unit, from units as they are written."""
