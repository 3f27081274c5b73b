"""Light path expressions: the engine alone. Private; use lightsieve.lpe."""

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
        """The expression as it was written."""

    @property
    def lints(self) -> tuple[lightsieve.errors.Diagnostic, ...]:
        """What is legal in it but probably not meant."""

    def __repr__(self) -> str: ...

def parse(text: str) -> Expression:
    """Reads an expression; raises LightsieveError with every error in it."""

def match(expression: Expression, path: str) -> bool:
    """Does the expression take the path?"""

def print_path(path: str) -> str:
    """The path in its normal spelling."""

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

def find_builtin(name: str) -> Builtin | None:
    """The built-in AOV of that name, or None."""

def error_codes() -> list[tuple[str, str]]:
    """Every code with what it means, in the order of the reference."""

def additive_sets(table: str = 'reference') -> list[list[str]]:
    """The sets of built-ins that add up to the beauty."""
