"""`lightsieve lpe graph`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lightsieve.cli import _lpe_options, _output

EXAMPLE = "lightsieve lpe graph direct indirect -o graph.svg"
JSON = {
    "file": "the picture; null without -o",
    "dot": "the automaton as Graphviz text",
}


def command(
    expressions: Annotated[
        list[str], typer.Argument(metavar="EXPR...", help="Expressions or names of AOVs.")
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="A .svg, .png or .dot file; else text is printed.",
        ),
    ] = None,
    scene: _lpe_options.Scene = None,
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Draw the smallest automaton of one or several expressions.

    Circles are where a path can be; each coloured box is a set of expressions that take a path
    which ends there. Pictures are drawn by the program dot of Graphviz.
    """
    context = _lpe_options.context(scene, lpe_table, lpe_standard, definitions)
    from lightsieve import graphs, lpe

    if output is not None and output.suffix not in graphs.FORMATS:
        raise typer.BadParameter(f"{output}: write a .svg, .png or .dot file", param_hint="-o")
    members = [lpe.parse(text, context) for text in expressions]
    picture = lpe.graph(*members, context=context)
    if output is not None:
        picture.save(output)
    if json:
        _output.print_json({"file": None if output is None else str(output), "dot": picture.dot})
        return
    for member in members:
        _output.print_diagnostics(member.lints)
    typer.echo(picture.dot if output is None else f"wrote {output}")
