"""`lightsieve lpe match`."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from lightsieve import lpe
from lightsieve.cli import _output

EXAMPLE = """lightsieve lpe match diffuse "C RD L" "C <RS'coat'> L'key'" """.strip()
JSON = {
    "expression": "the expression, also where a name was given",
    "paths": "one object a path, in order: `path`, `taken`",
    "lints": "diagnostics: what is legal in the expression but probably not meant",
}


def command(
    expression: Annotated[
        str, typer.Argument(metavar="EXPR", help="An expression, or the name of a built-in AOV.")
    ],
    paths: Annotated[
        list[str],
        typer.Argument(
            metavar="PATH",
            help="Events separated by blanks, with or without the angle brackets.",
        ),
    ],
    lpe_table: Annotated[
        Literal["reference", "arnold7"],
        typer.Option(help="Which reading of the built-ins' names."),
    ] = "reference",
    json: _output.Json = False,
) -> None:
    """Say which paths an expression takes.

    Exit code 1 if one of them is not taken.
    """
    text = lpe.resolve(expression, lpe_table)
    parsed = lpe.parse(text)
    taken = [(path, lpe.match(parsed, path)) for path in paths]
    if json:
        _output.print_json(
            {
                "expression": text,
                "paths": [{"path": path, "taken": yes} for path, yes in taken],
                "lints": [lint.to_dict() for lint in parsed.lints],
            }
        )
    else:
        _output.print_diagnostics(parsed.lints)
        _output.print_table((("yes" if yes else "no", path) for path, yes in taken), ["bold"])
    if not all(yes for _, yes in taken):
        raise typer.Exit(1)
