"""Tables of stations as people write them: read where they mean one thing, else a sentence."""

import pytest

from antinode import InputError, load_beam
from antinode.exchange.inputs import Choices, read_beam

HEAD = "x [m],mass_per_length [kg/m],bending_stiffness [N m^2]\n"
ROWS = "0,100,1e6\n5,100,1e6\n"
KILO = "0,100,1000\n5,100,1000\n"
SEMI = HEAD.replace(",", ";")


def units(x="m", m="kg/m", EI="N m^2", rows=ROWS):
    return f"x [{x}],mass_per_length [{m}],bending_stiffness [{EI}]\n{rows}"


READ = {
    "plain": HEAD + ROWS,
    "decimal commas": SEMI + "0,0;100,0;1000000,0\n5,0;100,0;1000000,0\n",
    "points between thousands": SEMI + "0;100;1.000.000\n5;100;1.000.000,0\n",
    "blanks between thousands": SEMI + "0;100;1 000 000\n5;100;1 000 000,0\n",
    "apostrophes between thousands": SEMI + "0;100;1'000'000\n5;100;1\u2019000\u2019000\n",
    "tabs": (HEAD + ROWS).replace(",", "\t"),
    "tabs and commas": HEAD.replace(",", "\t") + "0,0\t100,0\t1,0E+6\n5,0\t100,0\t1,0E+6\n",
    "bars": (HEAD + ROWS).replace(",", "|"),
    "blanks": "x  m  EI\n0  100  1e6\n5  100  1e6\n",
    "sep=": "sep=;\n" + (HEAD + ROWS).replace(",", ";"),
    "UTF-16": (HEAD + ROWS).encode("utf-16"),
    "UTF-16 without its mark": (HEAD + ROWS).encode("utf-16-le"),
    "UTF-16, the other way round": (HEAD + ROWS).encode("utf-16-be"),
    "UTF-8 with its mark": (HEAD + ROWS).encode("utf-8-sig"),
    "the code of Western Europe": units(EI="kN\u00b7m\u00b2", rows=KILO).encode("cp1252"),
    "line ends of Windows": (HEAD + ROWS).replace("\n", "\r\n"),
    "line ends of old": (HEAD + ROWS).replace("\n", "\r"),
    "quotes": '"x [m]","mass_per_length [kg/m]","bending_stiffness [N m^2]"\n' + ROWS,
    "typographic quotes": "\u201cx [m]\u201d,\u201cm [kg/m]\u201d,\u201eEI [N m^2]\u201c\n" + ROWS,
    "parentheses": "x (mm),mass_per_length (kg/m),EI (kNm\u00b2)\n0,100,1000\n5000,100,1000\n",
    "symbols": "x [m],m [kg/m],EI [Nm^2]\n" + ROWS,
    "Greek": "x [m],\u03bc [kg/m],EI [Nm^2]\n" + ROWS,
    "rho A": "x [m],rho A [kg/m],EI [Nm^2]\n" + ROWS,
    "words": "Position [m],Mass per unit length [kg/m],Flexural rigidity [Nm^2]\n" + ROWS,
    "capitals": "X [m],MASS_PER_LENGTH [kg/m],BENDING_STIFFNESS [N m^2]\n" + ROWS,
    "blanks about": " x [ m ] , mass per length [ kg / m ] , bending stiffness [ N m^2 ] \n" + ROWS,
    "hyphens": "x [m],mass-per-length [kg/m],Bending-stiffness [N m^2]\n" + ROWS,
    "a row of units": "x,mass_per_length,bending_stiffness\nm,kg/m,kN m^2\n" + KILO,
    "in brackets": "x,mass_per_length,bending_stiffness\n[m],[kg/m],[kN m^2]\n" + KILO,
    "in parentheses": "x,mass_per_length,bending_stiffness\n(m),(kg/m),(kNm2)\n" + KILO,
    "a bar before the unit": "x / m,mass_per_length / (kg/m),bending_stiffness / (N m^2)\n" + ROWS,
    "in": "x in m;mass_per_length in kg/m;EI in N m^2\n0;100;1e6\n5;100;1e6\n",
    "no units": "x,mass_per_length,bending_stiffness\n" + ROWS,
    "commas at the ends": (HEAD + ROWS).replace("\n", ",\n"),
    "semicolons at the ends": (HEAD + ROWS).replace(",", ";").replace("\n", ";;\n"),
    "empty lines": "\n\n" + HEAD + "\n" + ROWS + "\n\n",
    "comments": "% my beam\n# of\n! steel\n" + HEAD + "// first\n" + ROWS,
    "a title": "My beam\n" + HEAD + ROWS,
    "a title over empty cells": "My beam,,\n,,\n" + HEAD + ROWS,
    "Fortran": HEAD + "0,100,1.0D+6\n5,100,1.d6\n",
    "t/m, MNm\u00b2": units(m="t/m", EI="MNm\u00b2", rows="0,0.1,1\n5,.1,1\n"),
    "kNm2": units(EI="kNm2", rows=KILO),
    "KNm^2": units(EI="KNm^2", rows=KILO),
    "kN*m**2": units(EI="kN*m**2", rows=KILO),
    "kN-m^2": units(EI="kN-m^2", rows=KILO),
    "N.m2": units(EI="N.m2"),
    "N mm\u00b2": units("mm", "kg/mm", "N\u00b7mm\u00b2", "0,.1,1e12\n5000,.1,1e12\n"),
    "kg m^-1": units(m="kg m^-1"),
    "kg.m-1": units(m="kg.m-1"),
    "kg\u00b7m\u207b\u00b9": units(m="kg\u00b7m\u207b\u00b9"),
    "GPa m^4": units(EI="GPa m^4", rows="0,100,.001\n5,100,.001\n"),
    "daN m^2": units(EI="daN m^2", rows="0,100,1e5\n5,100,1e5\n"),
    "words for units": units("meter", "kg/meter", "newton meter^2"),
    "pounds and feet": units(
        "ft", "lb/ft", "lbf-ft^2", "0,67.1969,2419805\n16.4042,67.1969,2419805\n"
    ),
    "pounds and inches": units(
        "in", "lb/in", "lbf in^2", "0,5.599741,3.4845e8\n196.8504,5.599741,3.4845e8\n"
    ),
}  # fmt: skip


def read(tmp_path, text):
    path = tmp_path / "t.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_beam(path, "csv", Choices()).beam


@pytest.mark.parametrize("text", READ.values(), ids=READ)
def test_what_means_one_thing_is_read(text, tmp_path):
    beam = read(tmp_path, text)
    assert beam.length == pytest.approx(5.0, rel=1e-6)
    assert beam.mass_per_length[0, 0] == pytest.approx(100.0, rel=1e-5)
    assert beam.bending_stiffness[0, 0] == pytest.approx(1e6, rel=1e-4)


REFUSED = {
    "1,000": (SEMI + "0;100;1,000\n5;100;1,000\n", "1,000 may be 1000 or 1.000"),
    "a ton": (units(m="ton/m"), "1000 kg or 907 kg"),
    "a pound as a force": (units(EI="lb in^2"), "lb is a mass, the force is lbf"),
    "a kip as a mass": (units(m="kip/ft"), "'kip/ft' is no unit of kg/m"),
    "an index": (",x,m,EI\n0,0,100,1e6\n1,5,100,1e6\n", "a column has no name"),
    "a column of words": (HEAD.strip() + ",comment\n0,100,1e6,a\n5,100,1e6,b\n", "'comment'"),
    "an empty cell": (
        HEAD + "0,100,\n5,100,1e6\n",
        "line 2, column bending_stiffness: received ''",
    ),
    "#N/A": (HEAD + "0,100,#N/A\n5,100,1e6\n", "received '#N/A'"),
    "an open bracket": ("x [m,m [kg/m],EI [N m^2]\n" + ROWS, "bracket around its unit"),
    "the sign of N": ("x,m,EI,N\n0,1,1,5\n1,1,1,5\n", "unknown column 'N'"),
    "twice": ("x,m,mu,EI\n0,1,1,5\n1,1,1,5\n", "mass_per_length stands there twice"),
    "another code with zeros": (b"x,m\xff,EI\x00\n", "UTF-8"),
    "a wrong unit below": ("x,m,EI\nm,kg,N m^2\n" + ROWS, "mass_per_length: 'kg' is no unit"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_may_mean_two_things_is_refused(what, tmp_path):
    text, words = REFUSED[what]
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    assert words in str(error.value)


TOML = """\
[beam]
name = "b"
[beam.stations]
x = [0, 5]
mass_per_length = [100, 100]
bending_stiffness = [1e6, 1e6]
"""
SAME = {
    "symbols": (("mass_per_length", "m"), ("bending_stiffness", "EI")),
    "a unit in the key": (("x = [0, 5]", '"x (mm)" = [0, 5000]'),),
    "a unit in the key and the value": (("x = [0, 5]", '"x [mm]" = ["0 m", 5000]'),),
    "decimal commas": (("[0, 5]", '["0,0 m", "5,0 m"]'),),
    "kNm\u00b2": (("[1e6, 1e6]", '["1000 kNm\u00b2", "1 MN\u00b7m^2"]'),),
}


@pytest.mark.parametrize("what", SAME)
def test_columns_in_a_beam_file(what, tmp_path):
    text = TOML
    for old, new in SAME[what]:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "b.toml"
    path.write_text(text, encoding="utf-8")
    beam = load_beam(path).beam()
    assert (beam.length, beam.bending_stiffness[0, 1], beam.mass_per_length[0, 0]) == (5, 1e6, 100)


HINTS = {
    "a blank for a comma": ("[0, 5]", "[0 5]", "commas separate"),
    "a semicolon": ("[0, 5]", "[0; 5]", "commas separate"),
    "MATLAB's comment": ("[beam]\n", "% mine\n[beam]\n", "begins with #"),
    "no digit before the point": ("[0, 5]", "[.0, 5]", "both sides"),
    "no digit after it": ("[0, 5]", "[0., 5]", "both sides"),
    "Fortran": ("1e6, ", "1D6, ", "1.0e6"),
    "a power of ten": ("1e6, ", "1*10^6, ", "1e6"),
    "a minus of print": ("[0, 5]", "[\u22125, 0]", "plain -"),
    "what is not seen": ("x = ", "\u200bx = ", "not seen"),
    "True": ("[beam.st", "[beam.loads]\noffset_weight = True\n[beam.st", "true or false"),
    "a key with a unit": ("x = [0, 5]", "x [mm] = [0, 5]", '"x [mm]"'),
    "twice": ("x = [0, 5]", 'x = [0, 5]\n"x [m]" = [0, 5]', "stands there twice"),
    "a folder of Windows": ('"b"', '"C:\\Users\\b"', "single quotes"),
}


@pytest.mark.parametrize("what", HINTS)
def test_what_is_no_toml_is_said_helpfully(what, tmp_path):
    old, new, words = HINTS[what]
    assert old in TOML
    path = tmp_path / "b.toml"
    path.write_text(TOML.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError) as error:
        load_beam(path)
    assert words in str(error.value)
