"""What goes wrong, as data: one class of exception, with every error that one call found.

The compiled modules fill these classes; nothing here computes anything.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple


class Note(NamedTuple):
    """A second place that helps to understand a diagnostic."""

    message: str
    file: str | None
    line: int | None
    """Counted from 1."""
    column: int | None
    """Counted from 1, in characters."""


class Diagnostic(NamedTuple):
    """One error, warning or lint."""

    severity: str
    """`error`, `warning` (something was skipped or replaced) or `lint` (probably not meant)."""
    code: str
    """Its stable name, e.g. `unknown-param`; docs/errors.md lists them."""
    message: str
    """What is wrong with this input."""
    hint: str
    """What to do next; may be empty."""
    file: str | None
    """The file, or `<expression>`; None where there is no place."""
    line: int | None
    """Counted from 1."""
    column: int | None
    """Counted from 1, in characters."""
    rendered: str
    """All of it as a person sees it, the line with carets included."""
    notes: tuple[Note, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """The diagnostic as `--json` prints it."""
        return {**self._asdict(), "notes": [note._asdict() for note in self.notes]}


def without_place(code: str, message: str, hint: str) -> Diagnostic:
    """An error that belongs to no place in a text, rendered as the compiled modules render theirs.

    Args:
        code: A code of docs/reference/errors.md.
        message: What is wrong.
        hint: What to do next; may be empty.

    Returns:
        The error.

    Example:
        >>> without_place("unknown-node", 'there is no node "spher"', "").rendered
        'error[unknown-node]: there is no node "spher"'
    """
    rendered = f"error[{code}]: {message}" + (f"\n  hint: {hint}" if hint else "")
    return Diagnostic("error", code, message, hint, None, None, None, rendered)


class LightsieveError(Exception):
    """Bad input: everything that was found wrong with it.

    Example:
        >>> import lightsieve
        >>> try:
        ...     lightsieve.lpe.parse("CG")
        ... except lightsieve.LightsieveError as error:
        ...     print(error.errors[0].column)
        2
    """

    errors: tuple[Diagnostic, ...]
    """At least one, in the order in which they were found."""

    def __init__(self, errors: Sequence[Diagnostic]) -> None:
        self.errors = tuple(errors)
        super().__init__("\n".join(error.rendered for error in self.errors))
