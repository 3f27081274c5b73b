"""`lightsieve lpe explain`."""

from __future__ import annotations

from typing import Annotated

import typer

from lightsieve.cli import _lpe_options, _output

EXAMPLE = "lightsieve lpe explain specular_direct"
JSON = {
    "expression": "the expression, also where a name was given",
    "name": "of the AOV if one was given, else empty",
    "paragraph": "what it takes, in plain English",
    "taken": "the shortest paths that it takes: `text`, `words`",
    "near_misses": "paths that it does not take, one event away: `text`, `words`, `reason`",
    "related": "AOVs with paths in common: `name`, `relation` (of the expression to the AOV: "
    "`equal`, `subset`, `superset` or `overlapping`)",
    "lints": "diagnostics: what is legal in the expression but probably not meant",
}


def command(
    expression: Annotated[str, typer.Argument(metavar="EXPR", help=_lpe_options.EXPRESSION_HELP)],
    scene: _lpe_options.Scene = None,
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Say in plain English what an expression takes.

    With the shortest paths that it takes, paths that it just misses and why, and the AOVs that it
    overlaps.
    """
    context = _lpe_options.context(scene, lpe_table, lpe_standard, definitions)
    from lightsieve import lpe

    told = lpe.explain(expression, context)
    if json:
        _output.print_json(
            {
                "expression": told.expression,
                "name": told.name,
                "paragraph": told.paragraph,
                "taken": [path._asdict() for path in told.taken],
                "near_misses": [
                    {**miss.path._asdict(), "reason": miss.reason} for miss in told.near_misses
                ],
                "related": [aov._asdict() for aov in told.related],
                "lints": [lint.to_dict() for lint in told.lints],
            }
        )
        return
    _output.print_title(f"{told.name} = {told.expression}" if told.name else told.expression)
    _output.print_text(told.paragraph)
    if told.taken:
        _output.print_heading("takes, for example")
    for path in told.taken:
        _lpe_options.print_path("+", path)
    if told.near_misses:
        _output.print_heading("just misses")
    for miss in told.near_misses:
        _lpe_options.print_path("-", miss.path, miss.reason)
    _output.print_diagnostics(told.lints)
