"""`lightsieve lpe export`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lightsieve.cli import _lpe_options, _output

EXAMPLE = "lightsieve lpe export diffuse specular -o aovs.h"
JSON = {
    "file": "the file that was written",
    "states": "rows of the table",
    "stride": "numbers a row",
    "automata": "states that a path carries",
    "atoms": "sets of AOVs that a path can end in",
    "events": "the events with their columns",
}


def command(
    expressions: Annotated[
        list[str], typer.Argument(metavar="EXPR...", help="Expressions or names of AOVs.")
    ],
    output: Annotated[
        Path,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="A .h file for C, an .npz file, or an .npy file of the main table alone.",
        ),
    ],
    scene: _lpe_options.Scene = None,
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Write the automaton of a set of AOVs as flat arrays, for GPUs and other renderers.

    The arrays' layout is described in docs/embedding.md. They know one event of each class that
    the expressions tell apart, or with --scene the events that the scene can make.
    """
    from lightsieve import lpe, tables

    if output.suffix not in tables.FORMATS:
        raise typer.BadParameter(f"{output}: write a .h, .npz or .npy file", param_hint="-o")
    context = _lpe_options.context(scene, lpe_table, lpe_standard, definitions)
    members = [lpe.parse(text, context) for text in expressions]
    made = lpe.tables(*members, context=context)
    made.save(output)
    n_states, stride = made.table.shape
    if json:
        _output.print_json(
            {
                "file": str(output),
                "states": n_states,
                "stride": stride,
                "automata": len(made.starts),
                "atoms": len(made.atom_begin) - 1,
                "events": dict(zip(made.events, made.event_columns.tolist(), strict=True)),
            }
        )
        return
    for member in members:
        _output.print_diagnostics(member.lints)
    typer.echo(f"wrote {output}: {_output.plural(n_states, 'state')} of {stride} numbers")
