"""`lightsieve denoise`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

from lightsieve.cli import _denoising, _output, _signals

EXAMPLE = "lightsieve denoise out/shot.exr -o out/shot_clean.exr"
JSON = _denoising.JSON


def command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE.exr", help="A file that Lightsieve wrote, not deep.")
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="The new file; FILE_denoised.exr if not given.",
            show_default=False,
        ),
    ] = None,
    in_place: Annotated[
        bool, typer.Option("--in-place", help="Replace FILE.exr; the noisy picture is lost.")
    ] = False,
    helpers: Annotated[
        Path | None,
        typer.Option(
            "--helpers",
            metavar="EXR",
            help="Another file of the same frame, with the layers albedo and N if FILE.exr has "
            "none.",
            show_default=False,
        ),
    ] = None,
    quality: Annotated[
        Literal["high", "balanced", "fast"], typer.Option(help="`fast` is for previews.")
    ] = "high",
    threads: _output.Threads = 0,
    quiet: _output.Quiet = False,
    json: _output.Json = False,
) -> None:
    """Take the noise out of a file's light so that its layers still add up.

    Every layer of light is denoised with Intel Open Image Denoise (pip install
    "lightsieve[denoise]"); the layers albedo and N tell noise from detail where they are there.
    Then layers are moved by as little as it takes for all sums that the header names to hold, none
    below 0: `lightsieve exr verify` passes. Alpha and data (Z, N, ID, mattes, ...) stay bit for
    bit, and so does everything else in the file.
    """
    if in_place and output is not None:
        raise typer.BadParameter("--in-place and -o exclude each other")
    from lightsieve.denoising import denoise

    with _signals.interrupt() as came, _denoising.progress(quiet) as progress:
        try:
            done = denoise(
                file,
                output,
                in_place=in_place,
                helpers=helpers,
                quality=quality,
                threads=threads,
                progress=progress,
            )
        except KeyboardInterrupt:
            _output.say(f"stopped by {_signals.name_of(came[0])}; nothing was written")
            raise typer.Exit(_signals.exit_code(came[0])) from None
    if json:
        _output.print_json(_denoising.document(file, done))
    elif not quiet:
        _denoising.print_done(done)
