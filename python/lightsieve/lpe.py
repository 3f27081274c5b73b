"""Light path expressions: which paths of light an expression takes.

The engine alone: this module loads neither the renderer nor any other library.

    >>> from lightsieve import lpe
    >>> lpe.match("C<RS'coat'>.*", "C RS'coat' RD L'key'")
    True
"""

from __future__ import annotations

from typing import Literal, NamedTuple

from lightsieve import _lpe
from lightsieve._lpe import Expression

__all__ = [
    "Builtin",
    "Expression",
    "Table",
    "additive_sets",
    "builtins",
    "match",
    "parse",
    "resolve",
]

Table = Literal["reference", "arnold7"]
"""Which reading of the built-ins: Arnold 5's (`specular` includes sheen) or Arnold 7's."""


class Builtin(NamedTuple):
    """A built-in AOV."""

    name: str
    """Its name in `options.outputs`."""
    expression: str
    """Its light path expression."""
    meaning: str
    """One line for people."""
    part: str
    """The part of the beauty that it belongs to, e.g. `specular`; empty for sums of parts."""


def parse(text: str) -> Expression:
    """Reads an expression.

    Args:
        text: The expression, e.g. `"C<RD>[DSVOB].*"`.

    Returns:
        The expression; its `lints` say what is legal in it but probably not meant.

    Raises:
        LightsieveError: It cannot be read; `errors` has every mistake with its column.

    Example:
        >>> parse("cDL").lints[0].severity
        'lint'
    """
    return _lpe.parse(text)


def match(expression: str | Expression, path: str) -> bool:
    """Does the expression take the path?

    Args:
        expression: An expression.
        path: Events separated by blanks, each as in an expression, with or without angle brackets:
            `"C RD L"`, `"C <RS'coat'> TS L'key'"`.

    Returns:
        True if the expression takes it.

    Raises:
        LightsieveError: The expression or the path cannot be read.

    Example:
        >>> match("C[DSV]L", "C RS L")
        True
    """
    parsed = _lpe.parse(expression) if isinstance(expression, str) else expression
    return _lpe.match(parsed, path)


def builtins(table: Table = "reference") -> list[Builtin]:
    """The built-in AOVs, in the order of Arnold's page.

    Args:
        table: Which reading of them.

    Returns:
        One row a name.

    Example:
        >>> [b.expression for b in builtins() if b.name == "direct"]
        ['C[DSV]L']
    """
    return [
        Builtin(row.name, row.expression(table), row.meaning, row.part) for row in _lpe.builtins()
    ]


def additive_sets(table: Table = "reference") -> list[list[str]]:
    """The sets of built-in AOVs that add up to the beauty.

    Args:
        table: Which reading of them.

    Returns:
        Names of AOVs, one list a set.

    Example:
        >>> additive_sets()[0]
        ['direct', 'indirect', 'emission', 'background']
    """
    return _lpe.additive_sets(table)


def resolve(text: str, table: Table = "reference") -> str:
    """An expression, or a built-in AOV's expression where its name is given instead.

    Args:
        text: An expression, a built-in's name where no expression reads so, or `$name`.
        table: Which reading of the built-ins.

    Returns:
        The expression.

    Example:
        >>> resolve("diffuse")
        'C<RD>.*'
    """
    builtin = _lpe.find_builtin(text.removeprefix("$"))
    if builtin is None or (not text.startswith("$") and _reads_as_expression(text)):
        return text
    return builtin.expression(table)


def _reads_as_expression(text: str) -> bool:
    from lightsieve.errors import LightsieveError

    try:
        _lpe.parse(text)
    except LightsieveError:
        return False
    return True
