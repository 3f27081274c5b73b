"""What all commands say in the same way: JSON, tables, diagnostics.

Results go to standard output, everything else to standard error. Colour only on a terminal; rich
is loaded only then, so that a command in a pipe starts quickly.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from lightsieve.errors import Diagnostic, LightsieveError, without_place

_STYLES = {"error": "bold red", "warning": "bold yellow", "lint": "bold cyan"}
_json_wanted = False


def _remember_json(wanted: bool) -> bool:
    global _json_wanted
    _json_wanted = wanted
    return wanted


Json = Annotated[
    bool,
    typer.Option(
        "--json",
        callback=_remember_json,
        is_eager=True,
        help="Print one JSON document, for machines.",
    ),
]
"""The option that every command has."""


def print_json(document: dict[str, Any]) -> None:
    """Prints the one document of a command that was given `--json`."""
    typer.echo(json.dumps(document, indent=2, allow_nan=False))


def print_table(rows: Iterable[Sequence[str]], styles: Sequence[str] = ()) -> None:
    """Prints rows of text in columns; the last column is not padded.

    Args:
        rows: Texts, the same number in each row.
        styles: A rich style for each column, used on a terminal.
    """
    table = [list(row) for row in rows]
    if not table:
        return
    if sys.stdout.isatty():
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        grid = Table.grid(padding=(0, 2))
        for _ in table[0]:
            grid.add_column()
        for row in table:
            grid.add_row(
                *(
                    Text(cell, style=styles[i] if i < len(styles) else "")
                    for i, cell in enumerate(row)
                )
            )
        Console().print(grid)
        return
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    for row in table:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=True)]
        typer.echo("  ".join(cells).rstrip())


def say(text: str) -> None:
    """Prints a line to standard error."""
    typer.echo(text, err=True)


def print_diagnostics(items: Iterable[Diagnostic]) -> None:
    """Prints errors, warnings and lints as a person reads them, to standard error."""
    if not sys.stderr.isatty():
        for item in items:
            say(item.rendered)
        return
    from rich.console import Console

    console = Console(stderr=True, soft_wrap=True, highlight=False)
    for item in items:
        console.print(_coloured(item))


def _coloured(item: Diagnostic) -> Any:
    """The rendered text with its parts in colour."""
    from rich.text import Text

    text = Text(item.rendered)
    style = _STYLES[item.severity]
    text.highlight_regex(rf"(?m)^[^\n]*?{item.severity}\[[^\]]*\]:", "bold")
    text.highlight_words([f"{item.severity}[{item.code}]"], style)
    text.highlight_regex(r"(?m)^ +\| +\^~*$", style)
    text.highlight_regex(r"(?m)^ *\d* \|", "dim")
    text.highlight_regex(r"(?m)^  (hint|note):", "bold green")
    return text


def report_failure(error: LightsieveError) -> None:
    """Says what ended a command: on standard error, or as its JSON document."""
    if _json_wanted:
        print_json({"errors": [item.to_dict() for item in error.errors]})
    else:
        print_diagnostics(error.errors)


def plural(n: int, noun: str) -> str:
    """`1 light`, `2 lights`, `1,204 triangles`."""
    return f"{n:,} {noun}{'' if n == 1 else 's'}"


def save(path: Path, write: Callable[[Path], None]) -> None:
    """Writes a file; the disk's refusal becomes an error like any other.

    Args:
        path: The file; its folder is made if it is missing.
        write: Called with the path.

    Raises:
        LightsieveError: The file cannot be written (code `file-unwritable`).
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write(path)
    except OSError as error:
        message = f'cannot write "{path}": {error.strerror or error}'
        raise LightsieveError([without_place("file-unwritable", message, "")]) from None
