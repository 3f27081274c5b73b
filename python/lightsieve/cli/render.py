"""`lightsieve render`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from lightsieve import statistics
from lightsieve.cli import _denoising, _log, _output, _progress, _scene_options, _signals, _summary
from lightsieve.errors import LightsieveError
from lightsieve.statistics import StatisticsFile

if TYPE_CHECKING:
    from lightsieve._core import CompiledScene, LogSettings, Outcome
    from lightsieve.rendering import Settings

EXAMPLE = (
    """lightsieve render shot.ass -o out/ --aov "diffuse RGB" --lpe "caustics CDS.*" """.strip()
)
JSON = {
    "scene": "the file",
    **_scene_options.DIAGNOSTICS_JSON,
    **statistics.KEYS,
    "files": "written; this and all below are missing if errors forbid rendering",
    "denoised": "with --denoise one object an EXR file, as `lightsieve denoise --json` prints it "
    "or `file` and `errors`; else empty",
}


def _parse_size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d+)x(\d+)", text)
    if found is None:
        raise typer.BadParameter(f'"{text}" is not WIDTHxHEIGHT')
    return int(found[1]), int(found[2])


def _parse_region(text: str) -> tuple[int, int, int, int]:
    found = re.fullmatch(r"(-?\d+),(-?\d+),(-?\d+),(-?\d+)", text)
    if found is None:
        raise typer.BadParameter(f'"{text}" is not X0,Y0,X1,Y1')
    x0, y0, x1, y1 = map(int, found.groups())
    if x1 < x0 or y1 < y0:
        raise typer.BadParameter(f'"{text}" is empty: X1 and Y1 are the last pixels inside')
    return x0, y0, x1, y1


def _named(definitions: Sequence[str] | None) -> dict[str, str]:
    """`NAME EXPR` strings by name."""
    out: dict[str, str] = {}
    for definition in definitions or ():
        name, _, expression = definition.strip().partition(" ")
        if not expression:
            raise typer.BadParameter(
                f'--lpe "{definition}" has no expression: write --lpe "NAME EXPR"'
            )
        if name in out:
            raise typer.BadParameter(f'--lpe defines "{name}" twice')
        out[name] = expression.strip()
    return out


def _document(
    scene: Path,
    compiled: CompiledScene,
    outcome: Outcome | None,
    denoised: _denoising.Results,
) -> dict[str, Any]:
    document = {"scene": str(scene), **_scene_options.diagnostics_document(compiled)}
    if outcome is not None:
        document |= statistics.of_render(compiled, outcome)
        document["denoised"] = _denoising.documents(denoised)
    return document


def _say_stopped(outcome: Outcome, cause: str) -> None:
    done = f"{outcome.samples:,} samples were taken"
    where = (
        f"what was done is in {', '.join(outcome.files)}"
        if outcome.files
        else "nothing was written"
    )
    _output.say(f"stopped by {cause}: {done}; {where}")


def command(
    scene: Annotated[
        Path | None,
        typer.Argument(
            metavar="SCENE.ass", help="The scene, .ass or .ass.gz.", show_default=False
        ),
    ] = None,
    input_: Annotated[
        Path | None,
        typer.Option(
            "-i", metavar="FILE", help="The scene, as kick takes it.", show_default=False
        ),
    ] = None,
    output: Annotated[
        str,
        typer.Option(
            "-o",
            "--output",
            metavar="PATH",
            help="A folder for the drivers' relative file names, or the first driver's file.",
            show_default=False,
        ),
    ] = "",
    aa: Annotated[
        int | None,
        typer.Option(
            "--aa",
            "-as",
            min=1,
            metavar="N",
            help="AA_samples: N*N samples a pixel.",
            show_default=False,
        ),
    ] = None,
    spp: Annotated[
        int | None,
        typer.Option(
            min=1, metavar="N", help="Samples a pixel; wins over --aa.", show_default=False
        ),
    ] = None,
    size: Annotated[
        Any,
        typer.Option(
            parser=_parse_size,
            metavar="WxH",
            help="Size of the frame in pixels.",
            show_default=False,
        ),
    ] = None,
    resolution: Annotated[
        tuple[int, int] | None,
        typer.Option("-r", metavar="W H", help="The same, as kick takes it.", show_default=False),
    ] = None,
    region: Annotated[
        Any,
        typer.Option(
            parser=_parse_region,
            metavar="X0,Y0,X1,Y1",
            help="Render only these pixels, both corners included.",
            show_default=False,
        ),
    ] = None,
    threads: _output.Threads = 0,
    seed: Annotated[
        int | None,
        typer.Option(
            min=0,
            max=2**32 - 1,
            metavar="N",
            help="Another seed, other noise.",
            show_default=False,
        ),
    ] = None,
    camera: Annotated[
        str, typer.Option(metavar="NAME", help="Another camera of the scene.", show_default=False)
    ] = "",
    aovs: Annotated[
        list[str] | None,
        typer.Option(
            "--aov",
            metavar='"NAME TYPE"',
            help="Add an output to the first EXR driver, if it lacks it; may be repeated.",
        ),
    ] = None,
    lpes: Annotated[
        list[str] | None,
        typer.Option(
            "--lpe",
            metavar='"NAME EXPR"',
            help="Define an expression and output it; may be repeated.",
        ),
    ] = None,
    assignments: _scene_options.Assignments = None,
    strict: _scene_options.Strict = False,
    lpe_standard: _scene_options.LpeStandard = False,
    lpe_table: _scene_options.LpeTable = None,
    rendering_space: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Colour space that light is computed in, a linear one.",
            show_default=False,
        ),
    ] = "",
    checkpoint: Annotated[
        float,
        typer.Option(
            min=0,
            metavar="MINUTES",
            help="Time between two saves of what is done, beside the first file; 0: only when the "
            "render is stopped.",
        ),
    ] = 5,
    no_checkpoint: Annotated[
        bool, typer.Option("--no-checkpoint", help="Save nothing but the pictures.")
    ] = False,
    keep_checkpoint: Annotated[
        bool,
        typer.Option(
            "--keep-checkpoint",
            help="Keep what was saved when the render is done, to go on with more samples later.",
        ),
    ] = False,
    resume: Annotated[
        bool,
        typer.Option(
            "--resume",
            help="Go on where a render was stopped: the same bits as if it had not been.",
        ),
    ] = False,
    max_memory: _scene_options.MaxMemory = None,
    tev: Annotated[
        str,
        typer.Option(
            metavar="HOST:PORT",
            help="Show the picture in the viewer tev as it grows; its usual port is 14158.",
            show_default=False,
        ),
    ] = "",
    tev_aovs: Annotated[
        list[str] | None,
        typer.Option(
            "--tev-aov",
            metavar="NAME",
            help="A layer that tev is to show, '*' for all; may be repeated. The first one if not "
            "given.",
        ),
    ] = None,
    stats: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.json",
            help="Write the render's statistics there, for machines; wins over "
            "options.stats_file.",
            show_default=False,
        ),
    ] = None,
    guiding: Annotated[
        bool,
        typer.Option(
            "--guiding",
            help="Learn where light comes from, from an eighth more samples, and send part of the "
            "rays of diffuse lobes and sheen there: less noise where caustics and indirect light "
            "are hard to find.",
        ),
    ] = False,
    denoise: Annotated[
        bool,
        typer.Option(
            "--denoise",
            help="When the render is done, denoise every EXR file to FILE_denoised.exr beside it, "
            "as `lightsieve denoise` does. The layers albedo and N are added to the first one: "
            "they help.",
        ),
    ] = False,
    isa: Annotated[
        Literal["sse2", "avx2", "avx512"] | None,
        typer.Option(
            help="Pin the ray kernels, so that unlike machines give the same bits.",
            show_default=False,
        ),
    ] = None,
    quiet: _output.Quiet = False,
    verbosity: Annotated[
        int | None,
        typer.Option(
            "-v",
            metavar="N",
            help="0: errors only, as --quiet; 1: a summary; 2: everything. Wins over "
            "options.log_verbosity.",
            show_default=False,
        ),
    ] = None,
    json: _output.Json = False,
) -> None:
    """Render a scene to its files.

    Each driver of options.outputs writes its file; a scene without outputs writes RGBA to
    SCENE.exr.
    """
    if (scene is None) == (input_ is None):
        raise typer.BadParameter("name one scene: SCENE.ass, or -i FILE")
    path = scene or input_
    assert path is not None
    if no_checkpoint and (resume or keep_checkpoint):
        raise typer.BadParameter(
            "--no-checkpoint forbids what --resume and --keep-checkpoint need"
        )
    if denoise:
        _denoising.require_denoiser()
    settings: Settings = {
        "aovs": [*(aovs or ()), *(_denoising.HELPERS if denoise else ())],
        "lpes": _named(lpes),
        "threads": threads,
        "camera": camera,
        "strict": strict,
        "lpe_standard": lpe_standard,
        "lpe_table": lpe_table or "",
        "rendering_space": rendering_space,
        "isa": isa or "",
        "guiding": guiding,
        "checkpoint": None if no_checkpoint else checkpoint,
        "resume": resume,
        "keep_checkpoint": keep_checkpoint,
        "max_memory": max_memory or 0,
        "tev": tev,
        "tev_aovs": tev_aovs or (),
        "output": output,
        "aa": aa or 0,
        "spp": spp or 0,
        "size": size or resolution or (0, 0),
    }
    if region is not None:
        settings["region"] = region
    if seed is not None:
        settings["seed"] = seed
    compiled = _scene_options.compile_scene(
        path, write_files=True, assignments=assignments, **settings
    )
    if denoise and compiled.usable:
        _denoising.require_picture(compiled.summary().files)
    denoised: _denoising.Results = []
    log = compiled.summary().log if compiled.usable else None
    if quiet or verbosity is not None:
        level = 0 if quiet else verbosity or 0
    else:
        level = 1 if log is None else log.verbosity
    with _log.copied_to("" if log is None else log.file):
        printed = _log.Printed(compiled, silent=level <= 0, json=json, log=log)
        printed.report()
        file = _statistics_file(stats, log)
        with _signals.interrupt() as came:
            outcome = _run(compiled, level=level)
            if denoise and outcome is not None and not outcome.interrupted:
                denoised = _denoising.denoise_files(
                    outcome.files, came, threads=threads, quiet=level <= 0
                )
        printed.report()
        if outcome is not None and outcome.interrupted:
            _say_stopped(outcome, _signals.name_of(came[0]))
        document = _document(path, compiled, outcome, denoised)
        if file is not None and outcome is not None:
            file.write(document)
        if json:
            _output.print_json(document)
        elif outcome is not None and level > 0:
            _summary.print_render(compiled, outcome, everything=level > 1)
        if not json:
            _denoising.print_results(denoised, quiet=level <= 0)
    if came:
        raise typer.Exit(_signals.exit_code(came[0]))
    if compiled.n_errors or _denoising.failed(denoised):
        raise typer.Exit(1)


def _statistics_file(wanted: Path | None, log: LogSettings | None) -> StatisticsFile | None:
    """The file that is asked for, or that the scene names: a bad one of the scene is no error."""
    if wanted is not None:
        return StatisticsFile(wanted, append=False)
    if log is None or not log.stats_file:
        return None
    try:
        return StatisticsFile(log.stats_file, append=log.stats_append)
    except LightsieveError as error:
        _output.say(f"warning: options.stats_file: {error.errors[0].message}")
        return None


def _run(compiled: CompiledScene, *, level: int) -> Outcome | None:
    """Renders if that is possible, with progress on standard error."""
    if not compiled.usable:
        return None
    if level > 1:
        _summary.say_forecast(compiled.summary())
    with _progress.reporter(quiet=level <= 0) as progress:
        return compiled.render(progress)
