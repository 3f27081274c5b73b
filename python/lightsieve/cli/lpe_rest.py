"""`lightsieve lpe rest`."""

from __future__ import annotations

from typing import Annotated

import typer

from lightsieve.cli import _lpe_options, _output

EXAMPLE = "lightsieve lpe rest diffuse specular"
JSON = {
    "of": "the whole: `name` (empty if none was given), `expression`",
    "parts": "the parts, each as `of`",
    "rest": "an expression for what they leave over; null if nothing",
    "example": "null, or a shortest path of it: `text`, `words`",
}


def command(
    parts: Annotated[
        list[str], typer.Argument(metavar="EXPR...", help="Expressions or names of AOVs.")
    ],
    of: _lpe_options.Of = "C.*",
    scene: _lpe_options.Scene = None,
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Print an expression for what others leave over.

    It takes every path of the whole that none of them takes; nothing is printed if there is none.
    """
    context = _lpe_options.context(scene, lpe_table, lpe_standard, definitions)
    from lightsieve import lpe

    whole = lpe.parse(of, context)
    members = [lpe.parse(part, context) for part in parts]
    left = lpe.rest(*members, of=whole, context=context)
    example = None if left is None else left.shortest_paths(1)[0]
    if json:
        _output.print_json(
            {
                "of": {"name": whole.name, "expression": whole.text},
                "parts": [{"name": m.name, "expression": m.text} for m in members],
                "rest": None if left is None else left.text,
                "example": _lpe_options.path_document(example),
            }
        )
        return
    for member in (whole, *members):
        _output.print_diagnostics(member.lints)
    if left is None:
        _output.say(f"nothing is left over of {_lpe_options.label(whole)}")
        return
    typer.echo(left.text)
