"""`lightsieve exr diff`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lightsieve.cli import _output

EXAMPLE = "lightsieve exr diff new.exr reference.exr -o difference.exr --max-rmse 0.01"
JSON = {
    "a": "the file",
    "b": "the reference",
    "passed": "false if --max-rmse was given and exceeded, or a layer is missing",
    "layers": "one object a layer that both have: `name`, `rmse`, `relative_mse`, "
    "`flip` (0 to 1; null for data), `max_difference`, `max_at` (`x`, `y`), `values`, "
    "`different`, `nonfinite`",
    "only_a": "names of layers that only A has",
    "only_b": "names of layers that only B has",
}


def command(
    a: Annotated[Path, typer.Argument(metavar="A", help="A file.")],
    b: Annotated[Path, typer.Argument(metavar="B", help="The reference.")],
    picture: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PICTURE",
            help="Write the absolute difference to this .exr, .png or .tif.",
        ),
    ] = None,
    layer: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="The layer of a .png or .tif; the first if not given.",
            show_default=False,
        ),
    ] = "",
    max_rmse: Annotated[
        float | None,
        typer.Option(
            min=0,
            metavar="X",
            help="Exit 1 if a layer's RMSE is above X, or a layer is missing.",
            show_default=False,
        ),
    ] = None,
    json: _output.Json = False,
) -> None:
    """Compare two files layer by layer.

    Prints RMSE, relative MSE, FLIP (how much a person sees the pictures differ, 0 to 1) and the
    largest difference of each layer that both have.
    """
    from lightsieve import exr
    from lightsieve.extras.flip import flip_of_layers

    result = exr.diff(a, b, picture, layer)
    flips = flip_of_layers(exr.read(a), exr.read(b))
    worst = max((row.rmse for row in result.layers), default=0.0)
    missing = [*result.only_a, *result.only_b]
    failed = max_rmse is not None and (worst > max_rmse or bool(missing) or not result.layers)
    if json:
        _output.print_json(
            {
                "a": str(a),
                "b": str(b),
                "passed": not failed,
                "layers": [
                    {
                        "name": row.name,
                        "rmse": row.rmse,
                        "relative_mse": row.relative_mse,
                        "flip": flips.get(row.name),
                        "max_difference": row.max_difference,
                        "max_at": {"x": row.max_x, "y": row.max_y},
                        "values": row.n_values,
                        "different": row.n_different,
                        "nonfinite": row.n_nonfinite,
                    }
                    for row in result.layers
                ],
                "only_a": result.only_a,
                "only_b": result.only_b,
            }
        )
    else:
        rows = [("layer", "RMSE", "relative MSE", "FLIP", "largest", "at", "different")]
        rows += [
            (
                row.name,
                f"{row.rmse:.6g}",
                f"{row.relative_mse:.6g}",
                f"{flips[row.name]:.4f}" if row.name in flips else "",
                f"{row.max_difference:.6g}",
                f"{row.max_x},{row.max_y}",
                f"{row.n_different:,} of {row.n_values:,}"
                + (f", {row.n_nonfinite:,} not finite" if row.n_nonfinite else ""),
            )
            for row in result.layers
        ]
        _output.print_table(rows, ["bold"])
        for name, names in ((a, result.only_a), (b, result.only_b)):
            if names:
                typer.echo(f"only in {name}: {', '.join(names)}")
    if failed:
        raise typer.Exit(1)
