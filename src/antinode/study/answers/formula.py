"""Formulas over the inputs and outputs of a sweep: ``f2 - f1``, ``thrust < "80 kN" and f1 > 5``.

Names are those of inputs and outputs; ``f1``, ``f2``, ... are the frequencies by their place, and
``omega2[1]``, ``error_hz["bending 2"]`` any output of a mode. Numbers are SI; a text has its own
unit, that of the other side. A formula is read as Python's grammar has it, and nothing of it runs
but arithmetic, comparisons, `and`, `or`, `not`, and the functions below.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from antinode.errors import InputError
from antinode.inputs.units import to_si
from antinode.text import nearest, short

FUNCTIONS: dict[str, Callable[..., Any]] = {
    "abs": np.abs,
    "sqrt": np.sqrt,
    "exp": np.exp,
    "log": np.log,
    "log10": np.log10,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "min": lambda *values: np.minimum.reduce(np.broadcast_arrays(*values)),
    "max": lambda *values: np.maximum.reduce(np.broadcast_arrays(*values)),
}
_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
}
_COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: np.less,
    ast.LtE: np.less_equal,
    ast.Gt: np.greater,
    ast.GtE: np.greater_equal,
    ast.Eq: np.equal,
    ast.NotEq: np.not_equal,
}
_MODE = re.compile(r"f(\d+)")
_LONGEST, _DEEPEST = 1000, 50


class _Known:
    """What a formula may name.

    Parameters
    ----------
    units : mapping
        Of all variables over cases, by name.
    of_modes : collection of str
        Those that have one number a mode.
    modes : sequence of str
    """

    def __init__(
        self, units: Mapping[str, str], of_modes: Iterable[str], modes: Iterable[str]
    ) -> None:
        self.units, self.of_modes, self.modes = units, set(of_modes), list(modes)
        self.plain = {plain_name(name): name for name in units}

    def variable(self, name: str) -> str:
        """Return the variable of a name."""
        if name not in self.plain:
            known = [*(n for n, full in self.plain.items() if full not in self.of_modes), "f1"]
            raise InputError(f"{short(name)} is no input or output; {nearest(name, known)}")
        return self.plain[name]

    def mode(self, place: Any) -> int:
        """Return the index of a mode by its number along all modes, or its name."""
        if isinstance(place, str) and place in self.modes:
            return self.modes.index(place)
        if isinstance(place, int) and 1 <= place <= len(self.modes):
            return place - 1
        raise InputError(
            f"there is no mode {short(place)}; take 1 to {len(self.modes)}, or one of "
            f"{', '.join(self.modes[:6])}"
        )


def plain_name(name: str) -> str:
    """Return a name as it can stand in a formula: bending_stiffness_at_3_m."""
    return re.sub(r"\W+", "_", name).strip("_")


Columns = Mapping[str, npt.NDArray[Any]]
"""Variables over some cases: (cases,), or (cases, modes)."""


class _Value:
    """A value that is worked out, and its unit if it is known."""

    def __init__(self, value: Any, unit: str | None = None) -> None:
        self.value, self.unit = value, unit


@dataclass(frozen=True)
class Formula:
    """A formula that was read and found right.

    Attributes
    ----------
    text : str
    names : tuple of str
        Variables that it takes.
    unit : str
        Of its value; "" where it is not known, or where it is a condition.
    is_condition : bool
        Whether it is true or false.
    tree : ast.expr
        As Python's grammar has it.
    """

    text: str
    names: tuple[str, ...]
    unit: str
    is_condition: bool
    tree: ast.expr
    _known: _Known

    def __call__(self, columns: Columns) -> npt.NDArray[Any]:
        """Return its value in some cases, shape (cases,)."""
        cases = len(columns[self.names[0]])
        with np.errstate(all="ignore"):
            found = _Walk(self._known, columns).value(self.tree).value
        return np.broadcast_to(found, (cases,))

    def known(self, columns: Columns) -> npt.NDArray[np.bool_]:
        """Tell in which cases all that it takes, and all its arithmetic, is a number, (cases,)."""
        walk = _Walk(self._known, columns)
        with np.errstate(all="ignore"):
            walk.value(self.tree)
        known = np.broadcast_arrays(*(np.isfinite(v) for v in walk.used))
        return np.asarray(np.logical_and.reduce(known))


class _Walk:
    """One way through a formula."""

    def __init__(self, known: _Known, columns: Columns) -> None:
        self.known, self.columns = known, columns
        self.used: list[npt.NDArray[Any]] = []

    def value(self, node: ast.AST) -> _Value:
        """Return the value of a part of it."""
        how = getattr(self, f"_{type(node).__name__.lower()}", None)
        if isinstance(node, ast.Tuple):
            raise InputError("these are several; ask for each by an option of its own")
        if how is None:
            raise InputError(f"{type(node).__name__} has no place in a formula")
        found: _Value = how(node)
        return found

    def _constant(self, node: ast.Constant) -> _Value:
        if isinstance(node.value, bool) or not isinstance(node.value, int | float | str):
            raise InputError(f"{short(node.value)} is no number")
        try:
            return _Value(node.value if isinstance(node.value, str) else float(node.value))
        except OverflowError:
            raise InputError(f"{short(node.value)} is too large") from None

    def _name(self, node: ast.Name) -> _Value:
        match = _MODE.fullmatch(node.id)
        if match and node.id not in self.known.plain:
            return self._of_mode("frequency_hz", int(match[1]))
        name = self.known.variable(node.id)
        if name in self.known.of_modes:
            raise InputError(f"{name} has one number a mode; say which, e.g. {name}[1]")
        return self._used(self.columns[name], self.known.units[name])

    def _subscript(self, node: ast.Subscript) -> _Value:
        if not isinstance(node.value, ast.Name) or not isinstance(node.slice, ast.Constant):
            raise InputError("brackets name a mode, e.g. omega2[1]")
        name = self.known.variable(node.value.id)
        if name not in self.known.of_modes:
            raise InputError(f"{name} has one number a case; leave out the brackets")
        return self._of_mode(name, node.slice.value)

    def _of_mode(self, name: str, place: Any) -> _Value:
        if name not in self.known.of_modes:
            raise InputError(f"the sweep has no {name}; add it to its outputs")
        column = self.columns[name][:, self.known.mode(place)]
        return self._used(column, self.known.units[name])

    def _used(self, column: npt.NDArray[Any], unit: str | None) -> _Value:
        """Keep what must be finite where a formula is known, x / 0 and log(-1) among it."""
        self.used.append(column)
        return _Value(column, unit)

    def _number(self, node: ast.AST) -> _Value:
        found = self.value(node)
        if isinstance(found.value, str):
            raise InputError(f"{short(found.value)}: a text stands for a number beside one name")
        if np.asarray(found.value).dtype == bool:
            raise InputError("a condition is no number")
        return found

    def _condition(self, node: ast.AST) -> Any:
        found = self.value(node).value
        if np.asarray(found).dtype != bool:
            raise InputError("and, or, not take conditions, such as f1 > 5")
        return found

    def _binop(self, node: ast.BinOp) -> _Value:
        how = _BINARY.get(type(node.op))
        if how is None:
            raise InputError("the arithmetic of a formula is + - * / **")
        left, right = self._beside(node.left, node.right)
        same = left.unit if left.unit == right.unit else None
        unit = same if isinstance(node.op, ast.Add | ast.Sub) else None
        return self._used(how(np.asarray(left.value, float), right.value), unit)

    def _unaryop(self, node: ast.UnaryOp) -> _Value:
        if isinstance(node.op, ast.Not):
            return _Value(np.logical_not(self._condition(node.operand)))
        found = self._number(node.operand)
        return _Value(-found.value if isinstance(node.op, ast.USub) else found.value, found.unit)

    def _boolop(self, node: ast.BoolOp) -> _Value:
        parts = [self._condition(part) for part in node.values]
        how = np.logical_and if isinstance(node.op, ast.And) else np.logical_or
        return _Value(how.reduce(np.broadcast_arrays(*parts)))

    def _compare(self, node: ast.Compare) -> _Value:
        parts, found = [node.left, *node.comparators], []
        for op, left, right in zip(node.ops, parts[:-1], parts[1:], strict=True):
            how = _COMPARISONS.get(type(op))
            if how is None:
                raise InputError("the comparisons of a formula are < <= > >= == !=")
            one, other = self._beside(left, right)
            found.append(how(one.value, other.value))
        return _Value(np.logical_and.reduce(np.broadcast_arrays(*found)))

    def _beside(self, left: ast.AST, right: ast.AST) -> tuple[_Value, _Value]:
        """Return two sides; one that is a text has the unit of the other."""
        one, other = self.value(left), self.value(right)
        for text, beside in ((one, other), (other, one)):
            if isinstance(text.value, str):
                text.value, text.unit = _with_unit(text.value, beside), beside.unit
        for node, found in ((left, one), (right, other)):
            if np.asarray(found.value).dtype == bool:
                self._number(node)
        return one, other

    def _call(self, node: ast.Call) -> _Value:
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if name not in FUNCTIONS or node.keywords or not node.args:
            raise InputError(f"the functions of a formula are {', '.join(FUNCTIONS)}")
        if name not in ("min", "max") and len(node.args) > 1:
            raise InputError(f"{name} takes one number")
        parts = [self._number(argument) for argument in node.args]
        units = {part.unit for part in parts}
        unit = units.pop() if name in ("min", "max", "abs") and len(units) == 1 else None
        values = (np.asarray(part.value, float) for part in parts)
        return self._used(FUNCTIONS[name](*values), unit)


def _with_unit(text: str, beside: _Value) -> float:
    if beside.unit is None:
        raise InputError(f"{short(text)}: a text stands for a number beside one name")
    try:
        return to_si(text, "" if beside.unit == "1" else beside.unit)
    except ValueError as error:
        raise InputError(f"{short(text)}: {error}") from error


def read_formula(
    text: str,
    units: Mapping[str, str],
    of_modes: Iterable[str],
    modes: Iterable[str],
    defined: Mapping[str, ast.expr] | None = None,
) -> Formula:
    """Read a formula over the variables of a sweep.

    Parameters
    ----------
    text : str
    units : mapping
        Of all variables over cases, by name.
    of_modes : iterable of str
        Those that have one number a mode.
    modes : iterable of str
        Names of the modes.
    defined : mapping, optional
        Formulas that have a name of their own.

    Raises
    ------
    InputError
        If it is none, or names what is not there.
    """
    known = _Known(units, of_modes, modes)
    try:
        tree = _Defined(defined or {}).visit(_tree(text))
        if _depth(tree) > _DEEPEST:
            raise InputError(f"it is nested more than {_DEEPEST} deep")
        taken = _variables(tree, known)
        blank = {n: np.zeros((1, len(known.modes)) if n in known.of_modes else 1) for n in taken}
        with np.errstate(all="ignore"):
            found = _Walk(known, blank).value(tree)
        if not taken:
            raise InputError("it names no input or output")
        if isinstance(found.value, str):
            raise InputError("it is a text")
    except InputError as error:
        raise InputError(f"formula {short(text)}: {error}") from error
    condition = np.asarray(found.value).dtype == bool
    return Formula(text, tuple(taken), found.unit or "", bool(condition), tree, known)


def _tree(text: str) -> ast.expr:
    if len(text) > _LONGEST:
        raise InputError(f"it has {len(text)} characters; at most {_LONGEST} are allowed")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
        raise InputError("it cannot be read; write e.g. f2 - f1, or f1 > 5 and speed < 90") from (
            error
        )
    if _depth(tree) > _DEEPEST:
        raise InputError(f"it is nested more than {_DEEPEST} deep")
    return tree


class _Defined(ast.NodeTransformer):
    """Puts formulas in the place of their names."""

    def __init__(self, defined: Mapping[str, ast.expr]) -> None:
        self._defined = defined

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Return the formula of a name."""
        return self._defined.get(node.id, node)


def _depth(tree: ast.AST) -> int:
    layer, depth = [tree], 0
    while layer and depth <= _DEEPEST:
        layer = [child for node in layer for child in ast.iter_child_nodes(node)]
        depth += 1
    return depth


def _variables(tree: ast.AST, known: _Known) -> list[str]:
    """Return the variables that a formula takes, each once."""
    functions = {id(n.func) for n in ast.walk(tree) if isinstance(n, ast.Call)}
    found: dict[str, None] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and id(node) not in functions:
            if _MODE.fullmatch(node.id) and node.id not in known.plain:
                name = "frequency_hz"
                if name not in known.units:
                    raise InputError("the sweep has no frequency_hz; add it to its outputs")
            else:
                name = known.variable(node.id)
            found[name] = None
    return list(found)
