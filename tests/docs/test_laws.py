"""A law is named in few places: its file in either form, and the table of families."""

import ast
from pathlib import Path

import antinode
from antinode.beam.families import FAMILIES
from antinode.riccati import laws

SOURCE = Path(antinode.__file__).parent
NAMES = set(FAMILIES)
OBJECTS = {"BENDING", "LONGITUDINAL", "TORSION", "BAR", "SHAFT"}
TABLES = {"riccati/law", "riccati/laws", "beam/families"}
COMPILED = {"riccati/lanes/laws"}
TO_GO = {"study/identify/report"}


def modules():
    for path in sorted(SOURCE.rglob("*.py")):
        yield path.relative_to(SOURCE).with_suffix("").as_posix(), ast.parse(path.read_text())


def named(node):
    """Whether an expression is a law, or a family, by its name."""
    if isinstance(node, ast.Tuple | ast.List | ast.Set):
        return any(map(named, node.elts))
    if isinstance(node, ast.Constant):
        return node.value in NAMES
    name = getattr(node, "id", getattr(node, "attr", ""))
    return name in OBJECTS


def comparisons(tree):
    """Lines that ask which law it is."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare) and any(map(named, [node.left, *node.comparators])):
            yield node.lineno
        if isinstance(node, ast.MatchValue) and named(node.value):
            yield node.lineno


def strings(tree):
    """Lines that write a law's name instead of taking it from the table."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and node.value in NAMES:
            yield node.lineno


def test_the_table_has_every_law():
    objects = [value for value in vars(laws).values() if isinstance(value, laws.Law)]
    assert {law.name for law in objects} == NAMES
    assert {family.law for family in FAMILIES.values()} == set(objects)
    assert all(name == family.name for name, family in FAMILIES.items())


def test_a_law_is_written_by_name_in_its_file_and_in_the_table_only():
    found = {name for name, tree in modules() if any(strings(tree))}
    assert found == TABLES


def test_nothing_asks_which_law_it_is():
    found = {name for name, tree in modules() if any(comparisons(tree))}
    assert found <= COMPILED | TO_GO
