"""`lightsieve exr verify`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from lightsieve.cli import _output

EXAMPLE = "lightsieve exr verify out/frame.exr"
JSON = {
    "file": "the file",
    "passed": "true if something was checked and all of it adds up",
    "checks": "one object a sum: `sum`, `checked`, `passed`, `reason` (why it could not be "
    "checked), `worst` (null or `x`, `y`, `channel`, `whole`, `sum`, `residual`, `tolerance`), "
    "`failed_pixels`",
}


def command(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A file that Lightsieve wrote.")],
    json: _output.Json = False,
) -> None:
    """Re-check that a file's AOVs add up.

    From the pixels, for the sums that the renderer proved and named in the header; prints the
    largest residual of each. Exit code 1 if one does not add up or there is nothing to check.
    """
    from lightsieve import exr

    result = exr.verify(file)
    if json:
        _output.print_json(
            {
                "file": str(file),
                "passed": result.passed,
                "checks": [
                    {
                        "sum": check.text,
                        "checked": check.checked,
                        "passed": check.passed,
                        "reason": check.reason,
                        "worst": {
                            "x": check.worst_x,
                            "y": check.worst_y,
                            "channel": check.worst_channel,
                            "whole": check.whole,
                            "sum": check.sum,
                            "residual": check.residual,
                            "tolerance": check.tolerance,
                        }
                        if check.checked
                        else None,
                        "failed_pixels": check.n_failed,
                    }
                    for check in result.checks
                ],
            }
        )
    else:
        for check in result.checks:
            if not check.checked:
                typer.echo(f"not checked  {check.text}: {check.reason}")
                continue
            verdict = "adds up      " if check.passed else "DOES NOT ADD UP  "
            typer.echo(
                f"{verdict}{check.text}: largest residual {check.residual:.3g} "
                f"of {check.tolerance:.3g} allowed, "
                f"at {check.worst_x}, {check.worst_y} {check.worst_channel}"
                + ("" if check.passed else f"; {_output.plural(check.n_failed, 'pixel')} fail")
            )
        if not result.checks:
            typer.echo(f"{file}: the header names no sums to check")
    if not result.passed:
        raise typer.Exit(1)
