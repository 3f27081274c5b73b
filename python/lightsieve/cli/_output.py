"""What all commands say in the same way: JSON, tables, diagnostics.

Results go to standard output, everything else to standard error. Colour only on a terminal; rich
is loaded only then, so that a command in a pipe starts quickly.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, TextIO

import typer

from lightsieve.errors import Diagnostic, LightsieveError, without_place

_STYLES = {"error": "bold red", "warning": "bold yellow", "lint": "bold cyan"}
_json_wanted = False
_copy: TextIO | None = None


def _remember_json(wanted: bool) -> bool:
    global _json_wanted
    _json_wanted = wanted
    return wanted


Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")]
Threads = Annotated[
    int,
    typer.Option("-t", "--threads", min=0, metavar="N", help="0: as many as the machine has."),
]
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


@contextmanager
def copied_to(file: TextIO) -> Iterator[None]:
    """The file gets a copy of what is said, told and printed of diagnostics."""
    global _copy
    _copy = file
    try:
        yield
    finally:
        _copy = None


def _keep(text: str) -> None:
    if _copy is not None:
        print(text, file=_copy, flush=True)


def say(text: str) -> None:
    """Prints a line to standard error."""
    typer.echo(text, err=True)
    _keep(text)


def tell(text: str) -> None:
    """Prints a line of a result to standard output."""
    typer.echo(text)
    _keep(text)


def _width() -> int:
    """Columns for running text: the terminal's, at most what is easy to read."""
    return max(40, min(shutil.get_terminal_size((100, 24)).columns, 100))


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b, and c`."""
    if len(names) < 3:
        return " and ".join(names)
    return f"{', '.join(names[:-1])}, and {names[-1]}"


def print_text(text: str) -> None:
    """Prints running text, wrapped at words."""
    for line in textwrap.wrap(text, _width(), break_long_words=False, break_on_hyphens=False):
        typer.echo(line)


def print_title(text: str) -> None:
    """Prints the line that says what all that follows is about."""
    typer.echo(_styled(text, bold=True))


def print_heading(text: str) -> None:
    """Prints the line above some items."""
    typer.echo(_styled(f"{text}:", bold=True))


def print_item(mark: str, text: str, *about: str) -> None:
    """Prints something short with what it is and, below it, running text about it.

    Args:
        mark: What stands before it.
        text: It.
        *about: Each begins in a new line.
    """
    typer.echo(f"  {_styled(mark, bold=True)}  {_styled(text, fg='cyan')}")
    indent = " " * (4 + len(mark))
    for words in about:
        for line in textwrap.wrap(
            words, _width() - len(indent), break_long_words=False, break_on_hyphens=False
        ):
            typer.echo(indent + line)


def _styled(text: str, **style: Any) -> str:
    """Text in colour or bold, on a terminal only."""
    wants_colour = sys.stdout.isatty() and not os.environ.get("NO_COLOR")
    return typer.style(text, **style) if wants_colour else text


def print_diagnostics(items: Iterable[Diagnostic]) -> None:
    """Prints errors, warnings and lints as a person reads them, to standard error.

    On a terminal in colour (unless NO_COLOR is set) and fitted to its width; else as they are.
    """
    if not sys.stderr.isatty():
        for item in items:
            say(item.rendered)
        return
    items = list(items)
    for item in items:
        _keep(item.rendered)
    # Lines are fitted here, not wrapped by rich, so that carets stay under what they point at.
    width = shutil.get_terminal_size().columns
    if os.environ.get("NO_COLOR"):
        for item in items:
            typer.echo(fitted(item.rendered, width), err=True)
        return
    from rich.console import Console

    console = Console(stderr=True, soft_wrap=True, highlight=False)
    for item in items:
        console.print(_coloured(item, fitted(item.rendered, width)))


_QUOTED = re.compile(r" *\d+ \| ")


def fitted(rendered: str, width: int) -> str:
    """A rendered diagnostic whose lines are no longer than a terminal is wide.

    Args:
        rendered: Message, quoted line, carets, hint, notes.
        width: Columns.

    Returns:
        The same; a long quoted line is cut down to what surrounds the carets, other long lines go
        on in the next one.
    """
    lines = rendered.splitlines()
    out: list[str] = []
    while lines:
        line = lines.pop(0)
        quoted = _QUOTED.match(line)
        if quoted and lines and "^" in lines[0]:
            out += _cut(line, lines.pop(0), quoted.end(), width)
        elif len(line) > width:
            pad = " " * (len(line) - len(line.lstrip()) + 2)
            out += textwrap.wrap(
                line,
                width,
                subsequent_indent=pad,
                break_long_words=False,
                break_on_hyphens=False,
            )
        else:
            out.append(line)
    return "\n".join(out)


def _cut(line: str, carets: str, begin: int, width: int) -> tuple[str, str]:
    """A quoted line and the carets below it, cut to a width; both have a margin up to `begin`."""
    text, marks = line[begin:], carets[begin:]
    room = max(width - begin, 8)
    if len(text) <= room:
        return line, carets
    # As much of what is pointed at as fits, a little after it, and what stands before.
    first = min(marks.index("^"), max(0, min(len(marks) + 3, len(text)) - room))
    shown = text[first : first + room]
    if first > 0:
        shown = "..." + shown[3:]
    if first + room < len(text):
        shown = shown[:-3] + "..."
    return line[:begin] + shown, (carets[:begin] + marks[first : first + room]).rstrip()


def _coloured(item: Diagnostic, rendered: str) -> Any:
    """The rendered text with its parts in colour."""
    from rich.text import Text

    text = Text(rendered)
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
