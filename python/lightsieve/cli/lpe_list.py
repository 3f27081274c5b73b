"""`lightsieve lpe list`."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from lightsieve import lpe
from lightsieve.cli import _output

EXAMPLE = "lightsieve lpe list --lpe-table arnold7"
JSON = {
    "table": "`reference` or `arnold7`",
    "aovs": "one object a built-in: `name`, `expression`, `meaning`, `part`",
}


def command(
    lpe_table: Annotated[
        Literal["reference", "arnold7"],
        typer.Option(help="Which reading of the built-ins: arnold7 takes sheen out of specular."),
    ] = "reference",
    json: _output.Json = False,
) -> None:
    """List the built-in AOVs and their expressions."""
    rows = lpe.builtins(lpe_table)
    if json:
        _output.print_json({"table": lpe_table, "aovs": [row._asdict() for row in rows]})
        return
    _output.print_table(
        ((row.name, row.expression, row.meaning) for row in rows), ["bold", "cyan"]
    )
