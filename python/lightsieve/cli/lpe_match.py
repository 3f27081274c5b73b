"""`lightsieve lpe match`."""

from __future__ import annotations

from typing import Annotated

import typer

from lightsieve.cli import _lpe_options, _output

EXAMPLE = """lightsieve lpe match diffuse "C RD L" "C <RS'coat'> L'key'" """.strip()
JSON = {
    "expression": "the expression, also where a name was given",
    "paths": "one object a path, in order: `path`, `taken`",
    "lints": "diagnostics: what is legal in the expression but probably not meant",
}


def command(
    expression: Annotated[str, typer.Argument(metavar="EXPR", help=_lpe_options.EXPRESSION_HELP)],
    paths: Annotated[
        list[str],
        typer.Argument(
            metavar="PATH",
            help="Events separated by blanks, with or without the angle brackets.",
        ),
    ],
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Say which paths an expression takes.

    Exit code 1 if one of them is not taken.
    """
    context = _lpe_options.context(None, lpe_table, lpe_standard, definitions)
    from lightsieve import lpe

    parsed = lpe.parse(expression, context)
    taken = [(path, parsed.match(path)) for path in paths]
    if json:
        _output.print_json(
            {
                "expression": parsed.text,
                "paths": [{"path": path, "taken": yes} for path, yes in taken],
                "lints": [lint.to_dict() for lint in parsed.lints],
            }
        )
    else:
        _output.print_diagnostics(parsed.lints)
        _output.print_table((("yes" if yes else "no", path) for path, yes in taken), ["bold"])
    if not all(yes for _, yes in taken):
        raise typer.Exit(1)
