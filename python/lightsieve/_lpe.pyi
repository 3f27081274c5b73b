"""Light path expressions: the engine alone. Private; use lightsieve.lpe."""

from collections.abc import Sequence

import lightsieve.errors


version: str = '0.1.0'

def exit_3_on_bug() -> None:
    """
    Makes a crash or a broken assertion end the process with exit code 3. For programs, not for libraries.
    """

class Expression:
    """A light path expression that was read without an error."""

    @property
    def text(self) -> str:
        """The expression as it was written, also where a name was given."""

    @property
    def name(self) -> str:
        """The AOV's name if one was given; else empty."""

    @property
    def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]:
        """What is legal in it but probably not meant."""

    @property
    def normal(self) -> str:
        """The expression in its normal spelling."""

class Names:
    """What `$name` and names of AOVs mean."""

    def __init__(self, table: str = 'reference', definitions: Sequence[str] = [], standard: bool = False) -> None:
        """
        The built-ins of a table and `NAME EXPRESSION` definitions; raises LightsieveError with every error in them.
        """

    def find(self, name: str) -> Expression | None:
        """The expression of that name, or None."""

    def names(self) -> list[str]:
        """All names, sorted."""

def read(text: str, names: Names) -> Expression:
    """
    Reads an expression, or finds the AOV of that name where no expression reads so; raises LightsieveError with every error in it.
    """

def match(expression: Expression, path: str) -> bool:
    """Does the expression take the path?"""

def print_path(path: str) -> str:
    """The path in its normal spelling."""

def path_in_words(path: str) -> str:
    """The path in words."""

def partition(whole: Expression, parts: Sequence[Expression], events: Sequence[str] | None = None) -> tuple[str, tuple[str, str] | None, int, int]:
    """
    Fault (none, lost, twice, outside), its witness, and the two parts of `twice`.
    """

def compare(a: Expression, b: Expression, events: Sequence[str] | None = None) -> tuple[str, tuple[str, str] | None, tuple[str, str] | None, tuple[str, str] | None]:
    """Relation, and shortest paths of only a, only b, and both."""

def rest(whole: Expression, parts: Sequence[Expression], events: Sequence[str] | None = None) -> str | None:
    """What the parts leave over of the whole, or None."""

def shortest_paths(expression: Expression, n: int, events: Sequence[str] | None = None) -> list[str]:
    """
    The shortest paths that the expression takes, differing in more than labels.
    """

def count_paths(expression: Expression, length: int, events: Sequence[str] | None = None) -> int:
    """
    How many different paths of that many events the expression takes; 2^64 - 1: at least.
    """

def graph(expressions: Sequence[tuple[str, Expression]], events: Sequence[str] | None = None) -> str:
    """The smallest automaton of named expressions as Graphviz text."""

class Explanation:
    """What an expression takes, in words."""

    @property
    def words(self) -> str:
        """A noun."""

    @property
    def paragraph(self) -> str:
        """All but the paths."""

    @property
    def notes(self) -> list[str]:
        """What is easily misread."""

    @property
    def taken(self) -> list[tuple[str, str]]:
        """Paths, each with its words."""

    @property
    def near_misses(self) -> list[tuple[str, str, str]]:
        """Paths that are not taken, each with its words and the reason."""

    @property
    def related(self) -> list[tuple[str, str]]:
        """Names of AOVs with how it lies to them."""

    @property
    def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]:
        """What is legal in it but probably not meant."""

def explain(expression: Expression, subject: str, others: Sequence[tuple[str, Expression]], events: Sequence[str] | None = None) -> Explanation:
    """Explains an expression; `subject` starts the paragraph."""

class AovSet:
    """How a set of AOVs divides the light."""

    def __init__(self, members: Sequence[tuple[Expression | None, str]], groups: Sequence[str], events: Sequence[str] | None = None) -> None:
        """
        Each member is an expression, or None, and a light group or an empty string; `groups` are all that lights can be in.
        """

    def relation(self, a: int, b: int) -> str:
        """equal, subset, superset, overlapping or disjoint."""

    def example(self, inside: Sequence[int], outside: Sequence[int]) -> tuple[str, str] | None:
        """
        A shortest path in all AOVs of the first list and in none of the second, or None.
        """

    def sums(self, whole: int) -> list[list[int]]:
        """Sets of AOVs that add up to it."""

    def nearest(self, whole: int) -> list[int]:
        """AOVs without common paths that take the most of it."""

class Tables:
    """A program as flat arrays of 32-bit numbers."""

    @property
    def table(self) -> bytes:
        """Rows: flags, next states, atoms."""

    @property
    def stride(self) -> int:
        """Numbers a row."""

    @property
    def first_terminal(self) -> int:
        """Column of the first atom."""

    @property
    def starts(self) -> bytes:
        """Start of each automaton."""

    @property
    def event_columns(self) -> bytes:
        """Of each event."""

    @property
    def atom_begin(self) -> bytes:
        """Into `atom_aovs`."""

    @property
    def atom_aovs(self) -> bytes:
        """The AOVs of each atom."""

    @property
    def events(self) -> list[str]:
        """The events as paths write them."""

def tables(expressions: Sequence[tuple[str, Expression]], events: Sequence[str] | None = None) -> Tables:
    """Compiles named expressions to flat arrays."""

class Builtin:
    """A built-in AOV."""

    @property
    def name(self) -> str:
        """Its name in `options.outputs`."""

    @property
    def meaning(self) -> str:
        """One line for people."""

    @property
    def part(self) -> str:
        """The part of the beauty that it belongs to; empty for sums of parts."""

    def expression(self, table: str = 'reference') -> str:
        """Its expression in the table `reference` or `arnold7`."""

def builtins() -> list[Builtin]:
    """All built-in AOVs, in the order of the reference page."""

def error_codes() -> list[tuple[str, str]]:
    """Every code with what it means, in the order of the reference."""

def additive_sets(table: str = 'reference') -> list[list[str]]:
    """The sets of built-ins that add up to the beauty."""

class TranslationResult:
    """What a translation came to."""

    @property
    def text(self) -> str: ...

    @property
    def exact(self) -> bool: ...

    @property
    def lost(self) -> tuple[str, str] | None: ...

    @property
    def added(self) -> tuple[str, str] | None: ...

    @property
    def lost_prefixes(self) -> list[str]: ...

    @property
    def exact_without(self) -> list[str]: ...

    @property
    def notes(self) -> list[str]: ...

    @property
    def unverified(self) -> list[str]: ...

    @property
    def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]: ...

class ReadingResult:
    """What a renderer reads a text as."""

    @property
    def text(self) -> str: ...

    @property
    def meant(self) -> str: ...

    @property
    def differs(self) -> bool: ...

    @property
    def missed(self) -> tuple[str, str] | None: ...

    @property
    def extra(self) -> tuple[str, str] | None: ...

    @property
    def notes(self) -> list[str]: ...

    @property
    def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]: ...

def translate_dialect(text: str, source: str, target: str, without: Sequence[str]) -> TranslationResult:
    """Translates an expression from one renderer's dialect to another's."""

def read_dialect(text: str, dialect: str) -> ReadingResult:
    """What a renderer does with a text, and what was most likely meant."""

def dialects() -> list[tuple[str, str, list[tuple[str, bool]], list[str]]]:
    """Name, title, facts (text, verified) and prefixes of every dialect."""

def scene_properties() -> list[tuple[str, str]]:
    """What a scene may be without, by name, with its meaning."""
