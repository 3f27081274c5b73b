"""`lightsieve exr info`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lightsieve.cli import _output
from lightsieve.cli._output import plural

EXAMPLE = "lightsieve exr info out/frame.exr --attributes"
JSON = {
    "file": "the file",
    "width": "of the display window [pixels]",
    "height": "of the display window [pixels]",
    "data_window": "`x`, `y`, `width`, `height`, relative to the display window",
    "storage": "`tiles` or `scanlines`",
    "compression": "as driver_exr.compression names it",
    "parts": "how many",
    "layers": "one object a layer: `name`, `channels` (their suffixes), `type` (`half`, `float`, "
    "`uint`), `aov`, `expression`, `light_group`, `filter`, `filter_width`",
    "attributes": "numbers, texts and lists of numbers of the first part's header, by name",
}


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Any OpenEXR file.")],
    attributes: Annotated[
        bool, typer.Option("--attributes", help="Print the header's attributes too.")
    ] = False,
    json: _output.Json = False,
) -> None:
    """Show a file's layers.

    For each its channels, pixel type, filter, expression and light group.
    """
    from lightsieve import exr

    info = exr.info(file)
    if json:
        _output.print_json(
            {
                "file": str(file),
                "width": info.width,
                "height": info.height,
                "data_window": dict(
                    zip(("x", "y", "width", "height"), info.data_window, strict=True)
                ),
                "storage": "tiles" if info.tiled else "scanlines",
                "compression": info.compression,
                "parts": info.n_parts,
                "layers": [
                    {
                        "name": layer.name,
                        "channels": layer.suffixes,
                        "type": layer.type,
                        "aov": layer.source,
                        "expression": layer.expression,
                        "light_group": layer.light_group,
                        "filter": layer.filter,
                        "filter_width": layer.filter_width,
                    }
                    for layer in info.layers
                ],
                "attributes": info.attributes,
            }
        )
        return
    x, y, width, height = info.data_window
    window = (
        ""
        if (x, y, width, height) == (0, 0, info.width, info.height)
        else f", data {width} x {height} at {x}, {y}"
    )
    storage = "tiles" if info.tiled else "scanlines"
    typer.echo(
        f"{file}: {info.width} x {info.height}{window}, {storage}, {info.compression}, "
        f"{plural(len(info.layers), 'layer')}, {plural(info.n_channels, 'channel')}, "
        f"{plural(info.n_parts, 'part')}"
    )
    rows = [
        (
            f"  {layer.name}",
            "".join(layer.suffixes),
            layer.type,
            f"{layer.filter} {layer.filter_width:g}" if layer.filter else "",
            layer.expression
            + (f"  (light group {layer.light_group})" if layer.light_group else ""),
        )
        for layer in info.layers
    ]
    _output.print_table(rows, ["bold", "", "", "dim", "cyan"])
    if attributes:
        typer.echo("attributes")
        _output.print_table(
            (
                (f"  {name}", str(value).replace("\n", "; "))
                for name, value in sorted(info.attributes.items())
            ),
            ["bold"],
        )
