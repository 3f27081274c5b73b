"""Light path expressions: which paths of light an expression takes, and proofs about them.

The engine alone: this module loads neither the renderer nor any other library.

    >>> from lightsieve import lpe
    >>> lpe.match("C<RS'coat'>.*", "C RS'coat' RD L'key'")
    True
    >>> lpe.partition("diffuse", "specular", "coat").witness.words
    'a path that leaves the camera and ends at a light'
    >>> lpe.rest("diffuse", "specular", of="$diffuse | $specular | $coat")
    lightsieve.lpe.parse("C<RS'coat'>.*")

Wherever an expression is expected, the name of an AOV will do: a built-in, or one that the
`Context` defines. All answers are about every path that any scene could make, unless the context
is a scene's.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Literal, NamedTuple, cast

from lightsieve import _lpe
from lightsieve.dialects import (
    Dialect,
    DialectName,
    DialectReading,
    SceneProperty,
    Translation,
    dialects,
    read_as,
    scene_properties,
    translate,
)
from lightsieve.errors import Diagnostic
from lightsieve.graphs import Graph

if TYPE_CHECKING:
    from lightsieve.tables import Tables

__all__ = [
    "Builtin",
    "Comparison",
    "Context",
    "Dialect",
    "DialectName",
    "DialectReading",
    "Explanation",
    "Expression",
    "Fault",
    "Graph",
    "NearMiss",
    "Partition",
    "Path",
    "Related",
    "Relation",
    "SceneProperty",
    "Table",
    "Translation",
    "additive_sets",
    "builtins",
    "compare",
    "dialects",
    "explain",
    "graph",
    "match",
    "parse",
    "partition",
    "path",
    "read_as",
    "resolve",
    "rest",
    "scene_properties",
    "tables",
    "translate",
]

Table = Literal["reference", "arnold7"]
"""Which reading of the built-ins: Arnold 5's (`specular` includes sheen) or Arnold 7's."""

Relation = Literal["equal", "subset", "superset", "overlapping", "disjoint"]
"""How the paths of one expression lie to those of another."""

Fault = Literal["none", "lost", "twice", "outside"]
"""Why parts are no partition."""


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


class Path(NamedTuple):
    """A light path."""

    text: str
    """As `match` reads it: `C RS'coat' L'key'`."""
    words: str
    """`a path that leaves the camera, is reflected by the coat, and ends at a light`."""

    def __str__(self) -> str:
        return self.text


class Partition(NamedTuple):
    """Whether parts take each path of a whole exactly once, and nothing else. True if they do."""

    fault: Fault
    """No part takes the witness; two do; one does, but the whole does not."""
    witness: Path | None
    """A shortest path that shows the fault."""
    parts: tuple[int, ...]
    """The numbers of the two parts for `twice`, counted from 0; else none."""

    def __bool__(self) -> bool:
        return self.fault == "none"


class Comparison(NamedTuple):
    """How two expressions lie to one another, with shortest paths that show it."""

    relation: Relation
    """Of the first to the second: `subset`, if it takes a part of what the second takes."""
    only_a: Path | None
    """A path that only the first takes."""
    only_b: Path | None
    """A path that only the second takes."""
    both: Path | None
    """A path that both take."""


class NearMiss(NamedTuple):
    """A path that an expression does not take, one event away from one that it takes."""

    path: Path
    reason: str
    """What would have to stand in that place."""


class Related(NamedTuple):
    """An AOV that has paths in common with an expression."""

    name: str
    relation: Relation
    """Of the expression to the AOV."""


class Explanation(NamedTuple):
    """What an expression takes, in words and by examples."""

    expression: str
    name: str
    """Of the AOV if one was given; else empty."""
    paragraph: str
    """In plain English."""
    taken: list[Path]
    """The shortest paths that it takes, no two differing in labels only."""
    near_misses: list[NearMiss]
    related: list[Related]
    """AOVs that it is equal to, contained in, contains or overlaps, in this order."""
    lints: tuple[Diagnostic, ...]
    """What is legal in it but probably not meant."""

    def _repr_html_(self) -> str:
        """For notebooks."""
        title = f"<code>{escape(self.expression)}</code>"
        if self.name:
            title = f"<b>{escape(self.name)}</b> = {title}"
        rows = [("&#10003;", path, path.words) for path in self.taken]
        rows += [("&#10007;", miss.path, miss.reason) for miss in self.near_misses]
        cells = "".join(
            f"<tr><td>{mark}</td><td style='text-align:left'><code>{escape(path.text)}</code></td>"
            f"<td style='text-align:left'>{escape(text)}</td></tr>"
            for mark, path, text in rows
        )
        lints = "".join(f"<li>{escape(lint.message)}</li>" for lint in self.lints)
        return f"<p>{title}</p><p>{escape(self.paragraph)}</p><table>{cells}</table>" + (
            f"<ul>{lints}</ul>" if lints else ""
        )


class Context:
    """What expressions are read in, and which paths questions are about.

    Args:
        table: Which reading of the built-ins.
        definitions: Expressions of your own by name, for `$name`; they may name one another.
        standard: Refuse our extensions of Arnold's language.
        events: The events that paths are made of, e.g. `["RD", "RS'coat'", "L'key'", "B"]`; all
            possible ones if not given.

    Raises:
        LightsieveError: A definition cannot be read.

    Example:
        >>> studio = Context(definitions={"caustics": "CD.*S.*L"})
        >>> parse("$indirect - $caustics", studio).match("C RD RS L")
        False
    """

    def __init__(
        self,
        table: Table = "reference",
        *,
        definitions: Mapping[str, str] | None = None,
        standard: bool = False,
        events: Sequence[str] | None = None,
    ) -> None:
        lines = [f"{name} {text}" for name, text in (definitions or {}).items()]
        self._names = _lpe.Names(table, lines, standard)
        self._events = None if events is None else list(events)
        self.table = table

    @classmethod
    def of_scene(
        cls,
        scene: str | os.PathLike[str],
        table: Table | None = None,
        *,
        definitions: Mapping[str, str] | None = None,
        standard: bool = False,
    ) -> Context:
        """The context of a scene: its expressions, and only the paths that it can make.

        A path is possible if its events are: lobes of the shaders that shapes use, with their
        labels, and lights in their groups. Whether light really gets there is not looked at.

        Args:
            scene: An `.ass` or `.ass.gz` file.
            table: Which reading of the built-ins; as the scene says if not given.
            definitions: Expressions beside those of the scene; they win.
            standard: Refuse our extensions of Arnold's language.

        Returns:
            The context.

        Raises:
            LightsieveError: The scene or a definition has errors.

        Example:
            >>> bool(partition("$RGBA", of="C.*", context=Context.of_scene("scene.ass")))
            True
        """
        from lightsieve.errors import LightsieveError
        from lightsieve.rendering import compile_scene

        compiled = compile_scene(
            scene,
            capture=False,
            write_files=False,
            lpe_standard=standard,
            lpe_table=table or "",
        )
        if not compiled.usable:
            raise LightsieveError([i for i in compiled.diagnostics if i.severity == "error"])
        return cls(
            "arnold7" if compiled.lpe_table == "arnold7" else "reference",
            definitions={**dict(compiled.definitions), **(definitions or {})},
            standard=standard,
            events=compiled.events,
        )

    @cached_property
    def _aovs(self) -> list[tuple[str, _lpe.Expression]]:
        """Every name with its expression."""
        found = ((name, self._names.find(name)) for name in self.names)
        return [(name, expression) for name, expression in found if expression is not None]

    @cached_property
    def names(self) -> list[str]:
        """The AOVs that it knows: those that it defines, and the built-ins in their order."""
        builtin = [row.name for row in _lpe.builtins()]
        return [name for name in self._names.names() if name not in builtin] + builtin


_default_contexts: dict[Table, Context] = {}


def _default_context(table: Table = "reference") -> Context:
    if table not in _default_contexts:
        _default_contexts[table] = Context(table)
    return _default_contexts[table]


class Expression:
    """A light path expression that was read without an error; `parse` makes it.

    Expressions can be combined: `a & b`, `a | b`, `a - b`, and `~a` for the light that a does not
    take.

    Example:
        >>> caustics = parse("CD.*S.*L") & parse("C.*<L.'key'>")
        >>> caustics.match("C RD TS L'key'"), caustics.match("C RD TS L'rim'")
        (True, False)
    """

    __slots__ = ("_read", "context")

    context: Context
    """What it was read in."""

    def __init__(self, text: str, context: Context | None = None) -> None:
        self.context = context or _default_context()
        self._read = _lpe.read(text, self.context._names)

    @property
    def text(self) -> str:
        """As it was written, or what the name that was given stands for."""
        return self._read.text

    @property
    def name(self) -> str:
        """The AOV's name if one was given; else empty."""
        return self._read.name

    @property
    def normal(self) -> str:
        """In the spelling that every renderer reads alike."""
        return self._read.normal

    @property
    def lints(self) -> tuple[Diagnostic, ...]:
        """What is legal in it but probably not meant."""
        return self._read.lints

    def match(self, path: str) -> bool:
        """Does it take the path? See `match`."""
        return match(self, path)

    def partition(self, *parts: str | Expression) -> Partition:
        """Do the parts take each of its paths exactly once? See `partition`."""
        return partition(*parts, of=self)

    def rest(self, *parts: str | Expression) -> Expression | None:
        """What the parts leave over of it. See `rest`."""
        return rest(*parts, of=self)

    def compare(self, other: str | Expression) -> Comparison:
        """How it lies to another. See `compare`."""
        return compare(self, other)

    def explain(self) -> Explanation:
        """What it takes, in words and by examples. See `explain`."""
        return explain(self)

    def graph(self) -> Graph:
        """Its smallest automaton as a picture. See `graph`."""
        return graph(self)

    def shortest_paths(self, n: int = 3) -> list[Path]:
        """The n shortest paths that it takes, no two of which differ in labels only."""
        return [path(text) for text in _lpe.shortest_paths(self._read, n, self.context._events)]

    def is_empty(self) -> bool:
        """Whether it takes no path at all, or none that the context's scene can make."""
        return not self.shortest_paths(1)

    def count_paths(self, length: int) -> int:
        """How many different paths it takes that have exactly so many events.

        Args:
            length: events, the camera's included.

        Returns:
            With a context of a scene the number of paths of the scene's events; otherwise events
            count as different only if the expression tells them apart. 2**64 - 1 stands for all
            larger numbers.

        Raises:
            LightsieveError: the automaton is too large.

        >>> [parse("C(<RD>|<RS>+)L").count_paths(n) for n in (2, 3, 4)]
        [0, 2, 1]
        """
        return _lpe.count_paths(self._read, length, self.context._events)

    def __and__(self, other: Expression) -> Expression:
        return Expression(f"({self.text}) & ({other.text})", self.context)

    def __or__(self, other: Expression) -> Expression:
        return Expression(f"(({self.text})|({other.text}))", self.context)

    def __sub__(self, other: Expression) -> Expression:
        return Expression(f"({self.text}) - ({other.text})", self.context)

    def __invert__(self) -> Expression:
        return Expression(f"!({self.text})", self.context)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"lightsieve.lpe.parse({self.text!r})"

    def _repr_html_(self) -> str:
        """For notebooks: the explanation."""
        return self.explain()._repr_html_()

    def _repr_svg_(self) -> str:
        """For notebooks: the automaton."""
        return self.graph()._repr_svg_()


def _context_of(expressions: Sequence[str | Expression], context: Context | None) -> Context:
    """The one that was given, that of an expression, or the default."""
    if context is not None:
        return context
    for expression in expressions:
        if isinstance(expression, Expression):
            return expression.context
    return _default_context()


def _read(expression: str | Expression, context: Context) -> _lpe.Expression:
    if isinstance(expression, Expression):
        return expression._read
    return _lpe.read(expression, context._names)


def _path(witness: tuple[str, str] | None) -> Path | None:
    return None if witness is None else Path(*witness)


def parse(text: str, context: Context | None = None) -> Expression:
    """Reads an expression.

    Args:
        text: The expression, e.g. `"C<RD>[DSVOB].*"`, or an AOV's name where no expression reads
            so.
        context: What it is read in: names, table of built-ins, language.

    Returns:
        The expression; its `lints` say what is legal in it but probably not meant.

    Raises:
        LightsieveError: It cannot be read; `errors` has every mistake with its column.

    Example:
        >>> parse("cDL").lints[0].severity
        'lint'
    """
    return Expression(text, context)


def path(text: str) -> Path:
    """Reads a path.

    Args:
        text: Events separated by blanks, each as in an expression, with or without angle brackets:
            `"C RD L"`, `"C <RS'coat'> TS L'key'"`.

    Returns:
        The path in its normal spelling and in words.

    Raises:
        LightsieveError: It cannot be read.

    Example:
        >>> path("C <RS'coat'> L").words
        'a path that leaves the camera, is reflected by the coat, and ends at a light'
    """
    return Path(_lpe.print_path(text), _lpe.path_in_words(text))


def match(expression: str | Expression, path: str, context: Context | None = None) -> bool:
    """Does the expression take the path?

    Args:
        expression: An expression or an AOV's name.
        path: Events separated by blanks, each as in an expression, with or without angle brackets:
            `"C RD L"`, `"C <RS'coat'> TS L'key'"`.
        context: What the expression is read in.

    Returns:
        True if the expression takes it.

    Raises:
        LightsieveError: The expression or the path cannot be read.

    Example:
        >>> match("C[DSV]L", "C RS L")
        True
    """
    return _lpe.match(_read(expression, _context_of([expression], context)), path)


def partition(
    *parts: str | Expression, of: str | Expression = "C.*", context: Context | None = None
) -> Partition:
    """Proves that the parts take each path of a whole exactly once, and nothing else.

    Over all paths, not over samples of them; or finds a shortest path that shows that they do not.

    Args:
        *parts: Expressions or AOVs' names.
        of: The whole; all light if not given.
        context: What they are read in, and which paths count.

    Returns:
        True if they do (it can be used as a condition), or the fault with its witness.

    Raises:
        LightsieveError: An expression cannot be read, or is too large to prove anything about.

    Example:
        >>> bool(partition("direct", "indirect", "emission", "background"))
        True
        >>> partition("specular", "sheen", of="C<RS>.*").witness.text
        "C RS'coat' L"
    """
    context = _context_of([of, *parts], context)
    fault, witness, first, second = _lpe.partition(
        _read(of, context), [_read(part, context) for part in parts], context._events
    )
    return Partition(
        cast(Fault, fault), _path(witness), (first, second) if fault == "twice" else ()
    )


def rest(
    *parts: str | Expression, of: str | Expression = "C.*", context: Context | None = None
) -> Expression | None:
    """What the parts leave over of a whole, as an expression that a person can read.

    Args:
        *parts: Expressions or AOVs' names.
        of: The whole; all light if not given.
        context: What they are read in, and which paths count.

    Returns:
        The expression; None if nothing is left.

    Raises:
        LightsieveError: An expression cannot be read, or is too large to prove anything about.

    Example:
        >>> rest("emission", "background", of="C[LOB]") is None
        True
    """
    context = _context_of([of, *parts], context)
    text = _lpe.rest(_read(of, context), [_read(part, context) for part in parts], context._events)
    return None if text is None else Expression(text, context)


def compare(
    a: str | Expression, b: str | Expression, context: Context | None = None
) -> Comparison:
    """How two expressions lie to one another.

    Args:
        a: An expression or an AOV's name.
        b: Another.
        context: What they are read in, and which paths count.

    Returns:
        The relation of a to b, with shortest paths that only a, only b, and both take.

    Raises:
        LightsieveError: An expression cannot be read, or is too large to prove anything about.

    Example:
        >>> compare("sheen", "specular").relation
        'subset'
        >>> compare("C<RD>.*", "C.*<L.'key'>").both.text
        "C RD L'key'"
    """
    context = _context_of([a, b], context)
    relation, only_a, only_b, both = _lpe.compare(
        _read(a, context), _read(b, context), context._events
    )
    return Comparison(cast(Relation, relation), _path(only_a), _path(only_b), _path(both))


def explain(expression: str | Expression, context: Context | None = None) -> Explanation:
    """What an expression takes: in a sentence, by examples, by what it just misses.

    Args:
        expression: An expression or an AOV's name.
        context: What it is read in, which paths count, and the AOVs to compare it with.

    Returns:
        Everything that can be said, as texts.

    Raises:
        LightsieveError: The expression cannot be read, or is too large to prove anything about.

    Example:
        >>> told = explain("C<RD>L")
        >>> told.paragraph.split(". ")[0]
        'It takes paths that leave the camera, are reflected diffusely, and end at a light'
        >>> told.near_misses[0].path.text, told.near_misses[0].reason
        ('C RD O', 'after C RD it must end at a light')
    """
    context = _context_of([expression], context)
    read = _read(expression, context)
    others = [(name, other) for name, other in context._aovs if name != read.name]
    told = _lpe.explain(read, read.name or "It", others, context._events)
    return Explanation(
        read.text,
        read.name,
        told.paragraph,
        [Path(*taken) for taken in told.taken],
        [NearMiss(Path(text, words), reason) for text, words, reason in told.near_misses],
        [Related(name, cast(Relation, relation)) for name, relation in told.related],
        told.lints,
    )


def graph(*expressions: str | Expression, context: Context | None = None) -> Graph:
    """The smallest automaton of one or several expressions as a picture.

    Args:
        *expressions: Expressions or AOVs' names.
        context: What they are read in, and which paths count.

    Returns:
        The picture; notebooks show it, `save` writes it.

    Raises:
        LightsieveError: An expression cannot be read, or the automaton is too large for a picture.

    Example:
        >>> graph("direct", "indirect").dot.startswith("digraph")
        True
    """
    context = _context_of(expressions, context)
    read = [_read(expression, context) for expression in expressions]
    return Graph(_lpe.graph([(e.name or e.text, e) for e in read], context._events))


def tables(*expressions: str | Expression, context: Context | None = None) -> Tables:
    """The automaton of a set of AOVs as flat arrays, for GPUs and other renderers.

    Args:
        *expressions: Expressions or AOVs' names.
        context: What they are read in; its events are those that the arrays know, one of each
            class that the expressions tell apart if it has none.

    Returns:
        The arrays; `save` writes them. docs/embedding.md describes the layout.

    Raises:
        LightsieveError: An expression cannot be read, or it exceeds a budget.

    Example:
        >>> made = tables("diffuse", "specular", context=Context(events=["RD", "RS", "L"]))
        >>> made.table.shape, made.aovs
        ((4, 4), ['diffuse', 'specular'])
    """
    import numpy as np

    from lightsieve.tables import Tables

    context = _context_of(expressions, context)
    read = [_read(expression, context) for expression in expressions]
    named = [(expression.name or expression.text, expression) for expression in read]
    made = _lpe.tables(named, context._events)

    def numbers(data: bytes) -> np.ndarray[tuple[int], np.dtype[np.uint32]]:
        return np.frombuffer(data, np.uint32)

    return Tables(
        numbers(made.table).reshape(-1, made.stride),
        made.first_terminal,
        numbers(made.starts),
        made.events,
        numbers(made.event_columns),
        [name for name, _ in named],
        numbers(made.atom_begin),
        numbers(made.atom_aovs),
    )


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

    Raises:
        LightsieveError: It cannot be read.

    Example:
        >>> resolve("diffuse"), resolve("$coat")
        ('C<RD>.*', "C<RS'coat'>.*")
    """
    context = _default_context(table)
    named = context._names.find(text.removeprefix("$")) if text.startswith("$") else None
    return (named or _lpe.read(text, context._names)).text
