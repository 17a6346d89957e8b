"""Tables as TOML: written anew, or into the text of a file, whose comments stay (tomlkit).

Reading never comes here: the standard library reads TOML.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import tomlkit
from tomlkit import items
from tomlkit.exceptions import TOMLKitError

Tables = Mapping[str, Any]
Put = Callable[[Any, str, Any], None]


def toml_text(tables: Tables) -> str:
    """Return tables as TOML: the keys of a table first, then the tables in it.

    Parameters
    ----------
    tables : mapping
        Of numbers, texts, arrays, lists and mappings; a list of mappings becomes `[[...]]`.
    """
    document = tomlkit.document()
    _fill(document, plain(tables))
    return document.as_string()


def with_values(text: str, before: Tables, after: Tables) -> str:
    """Return the text of a file with other values; what does not change stays as it is written.

    Where tables stand in an order that cannot be kept, all is written anew, without comments.

    Parameters
    ----------
    text : str
        TOML.
    before, after : mapping
        What its keys were worth, and are to be worth, both in the same form, which need not be that
        of the file: "80 m/s" may stand there for 80. Keys that neither has are left alone.
    """
    before, after = plain(before), plain(after)
    wanted = tomllib.loads(text)
    _change(wanted, before, after, dict.__setitem__)
    try:
        document = tomlkit.parse(text)
        _change(document, before, after, _put)
        changed = document.as_string()
        if same(tomllib.loads(changed), wanted):
            return changed
    except (TOMLKitError, ValueError, LookupError, TypeError, AttributeError):
        pass
    return toml_text(wanted)


def plain(data: Any) -> Any:
    """Return data of Python's own types: arrays and tuples as lists."""
    if isinstance(data, Mapping):
        return {str(key): plain(value) for key, value in data.items()}
    if isinstance(data, list | tuple | np.ndarray):
        return [plain(value) for value in data]
    return data.item() if isinstance(data, np.generic) else data


def same(one: Any, other: Any) -> bool:
    """Tell whether two plain values are the same: NaN is NaN, and true is not 1."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(v, other[k]) for k, v in one.items())
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(same, one, other))
    alike = isinstance(one, bool) == isinstance(other, bool)
    return alike and (one == other or (one != one and other != other))


def _change(node: Any, before: Tables, after: Tables, put: Put) -> None:
    """Give the keys of a table those values that differ."""
    for key in before.keys() - after.keys():
        node.pop(key, None)
    for key, new in after.items():
        old: Any = before.get(key)
        inner: Any = node.get(key)
        if key in before and same(old, new):
            continue
        if all(isinstance(v, Mapping) for v in (old, inner, new)):
            _change(inner, old or {}, new, put)
        elif all(map(is_list_of_tables, (old, inner, new))) and len(old) == len(new) == len(inner):
            for parts in zip(inner, old, new, strict=True):
                _change(*parts, put)
        else:
            put(node, key, new)


def is_list_of_tables(value: Any) -> bool:
    """Tell whether a value is a list of tables, as `[[...]]` makes it."""
    return isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) for v in value)


def _put(node: Any, key: str, value: Any) -> None:
    """Set a key of a table of tomlkit: a value where the old one stood, a table behind the keys."""
    if isinstance(node, items.InlineTable):
        node[key] = _inline(value)
    elif isinstance(value, Mapping) or is_list_of_tables(value):
        node.pop(key, None)
        node.append(key, _below(value))
        node.append(None, tomlkit.nl())
    elif isinstance(node.get(key), items.Table | items.AoT):
        node.pop(key)
        _add(node, key, _inline(value))
    elif key in node:
        _replace(node, key, _inline(value))
    else:
        _add(node, key, _inline(value))


def _replace(node: Any, key: str, new: items.Item) -> None:
    """Put a value in the place of another; the comment behind it stays in its column."""
    old = node[key]
    longer = len(new.as_string()) - len(old.as_string())
    node[key] = new
    space = node[key].trivia.comment_ws
    node[key].trivia.comment_ws = " " * max(len(space) - longer, 1) if space else ""


def _add(node: Any, key: str, value: items.Item) -> None:
    """Put a key behind the last one of its table, before the comments that follow it."""
    values = [k for k, v in node.items() if not isinstance(v, items.Table | items.AoT)]
    container = node.value if isinstance(node, items.Table) else node
    if values:
        container._insert_after(values[-1], key, value)
    else:
        node.append(key, value)


def _fill(node: Any, table: Tables) -> None:
    below = {k: v for k, v in table.items() if isinstance(v, Mapping) or is_list_of_tables(v)}
    for key, value in table.items():
        if key not in below:
            node.append(key, _inline(value))
    for key, value in below.items():
        node.append(key, _below(value))


def _below(value: Any) -> items.Item:
    """Return what stands below the keys of its table: a table, or a list of them."""
    if isinstance(value, Mapping):
        only_tables = bool(value) and all(isinstance(v, Mapping) for v in value.values())
        table = tomlkit.table(is_super_table=only_tables)
        _fill(table, value)
        return table
    array = tomlkit.aot()
    for entry in value:
        array.append(_below(entry))
    return array


def _inline(value: Any) -> items.Item:
    """Return a value on the line of its key."""
    if isinstance(value, Mapping):
        table = tomlkit.inline_table()
        for key, inner in value.items():
            table.append(key, _inline(inner))
        return table
    if not isinstance(value, list):
        item: items.Item = tomlkit.item(value)
        return item
    parts: list[items.Item] = []
    for entry in value:  # array.append would look through the whole array each time
        parts += [items.Whitespace(", "), _inline(entry)]
    return items.Array(parts[1:], items.Trivia())
