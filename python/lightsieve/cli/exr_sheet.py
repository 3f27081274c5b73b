"""`lightsieve exr sheet`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lightsieve.cli import _output

EXAMPLE = "lightsieve exr sheet out/showcase.exr -o out/showcase.png"
JSON = {
    "file": "the sheet",
    "layers": "names of the layers on it, in order",
}


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Any OpenEXR file.")],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PNG",
            help="Where the sheet goes; FILE.png if not given.",
            show_default=False,
        ),
    ] = None,
    width: Annotated[int, typer.Option(min=16, metavar="N", help="Of each picture.")] = 320,
    columns: Annotated[int, typer.Option(min=0, metavar="N", help="0: as fits a screen.")] = 0,
    json: _output.Json = False,
) -> None:
    """Draw all layers of a file on one labelled sheet.

    Light is shown in sRGB; each label says how many stops its layer was brightened.
    """
    from lightsieve import exr
    from lightsieve.extras.contact_sheet import contact_sheet

    frame = exr.read(file)
    target = output or file.with_suffix(".png")
    sheet = contact_sheet(frame, file.name, width=width, columns=columns)
    _output.save(target, sheet.save)
    if json:
        _output.print_json({"file": str(target), "layers": frame.layers()})
    else:
        typer.echo(f"wrote {target}: {_output.plural(len(frame.layers()), 'layer')}")
