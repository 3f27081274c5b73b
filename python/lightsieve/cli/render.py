"""`lightsieve render`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from lightsieve.cli import _output, _progress, _scene_options, _signals

if TYPE_CHECKING:
    from lightsieve._core import CompiledScene, Outcome
    from lightsieve.rendering import Settings

EXAMPLE = (
    """lightsieve render shot.ass -o out/ --aov "diffuse RGB" --lpe "caustics CDS.*" """.strip()
)
JSON = {
    "scene": "the file",
    **_scene_options.DIAGNOSTICS_JSON,
    "files": "written; this and all below are missing if errors forbid rendering",
    "stopped": "true if Ctrl-C ended it early",
    "width": "of the rendered region [pixels]",
    "height": "of the rendered region [pixels]",
    "samples": "camera samples taken",
    "resumed_samples": "camera samples that a checkpoint had, not in `samples`",
    "checkpoint": "file from which --resume can go on, or null",
    "dropped_samples": "contributions that were not finite",
    "rays": "closest-hit and shadow rays",
    "seconds": "sampling, without reading the scene and writing files",
    "output_seconds": "writing files",
    "samples_per_second": "`samples` / `seconds`",
    "noise": "by layer of light: luminance as `mean` and root mean square (`level`), and the "
    "standard `error` of a pixel's, root mean square",
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


def _document(scene: Path, compiled: CompiledScene, outcome: Outcome | None) -> dict[str, Any]:
    document: dict[str, Any] = {
        "scene": str(scene),
        **_scene_options.diagnostics_document(compiled),
    }
    if outcome is not None:
        document |= {
            "files": outcome.files,
            "stopped": outcome.stopped,
            "width": outcome.width,
            "height": outcome.height,
            "samples": outcome.samples,
            "resumed_samples": outcome.resumed_samples,
            "checkpoint": outcome.checkpoint or None,
            "dropped_samples": outcome.dropped_samples,
            "rays": outcome.rays,
            "seconds": outcome.seconds,
            "output_seconds": outcome.output_seconds,
            "samples_per_second": outcome.samples / outcome.seconds
            if outcome.seconds > 0
            else 0.0,
            "noise": {
                name: {"mean": mean, "level": level, "error": error}
                for name, mean, level, error in outcome.noise
            },
        }
    return document


def _print_summary(compiled: CompiledScene, outcome: Outcome) -> None:
    for path in outcome.files:
        typer.echo(f"wrote {path}")
    rate = outcome.samples / outcome.seconds if outcome.seconds > 0 else 0.0
    typer.echo(
        f"{outcome.width} x {outcome.height} in {outcome.seconds:.1f} s "
        f"(+ {outcome.output_seconds:.1f} s output): "
        f"{outcome.samples:,} samples, {rate:,.0f} samples/s"
    )
    if outcome.resumed_samples:
        typer.echo(f"{outcome.resumed_samples:,} samples were in the checkpoint")
    if outcome.checkpoint:
        typer.echo(f"--resume goes on from {outcome.checkpoint}")
    if outcome.dropped_samples:
        typer.echo(f"{_output.plural(outcome.dropped_samples, 'sample')} dropped: not finite")
    if noisy := _noisiest(outcome):
        typer.echo(f"noise left in a pixel, of the layer's level: {noisy}")
    typer.echo(_scene_options.count_text(compiled))


def _noisiest(outcome: Outcome, n: int = 4) -> str:
    """The layers that are noisiest for how bright they are, worst first."""
    shares = [(error / level, name) for name, _, level, error in outcome.noise if level > 0]
    return ", ".join(f"{name} {share:.1%}" for share, name in sorted(shares)[: -n - 1 : -1])


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
    threads: Annotated[
        int,
        typer.Option("-t", "--threads", min=0, metavar="N", help="0: as many as the machine has."),
    ] = 0,
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
            help="Add an output to the first driver; may be repeated.",
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
    isa: Annotated[
        Literal["sse2", "avx2", "avx512"] | None,
        typer.Option(
            help="Pin the ray kernels, so that unlike machines give the same bits.",
            show_default=False,
        ),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Say nothing but errors.")] = False,
    verbosity: Annotated[
        int | None,
        typer.Option(
            "-v", metavar="N", help="As kick takes it; 0 is --quiet.", show_default=False
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
    settings: Settings = {
        "aovs": aovs or (),
        "lpes": _named(lpes),
        "threads": threads,
        "camera": camera,
        "strict": strict,
        "lpe_standard": lpe_standard,
        "lpe_table": lpe_table or "",
        "rendering_space": rendering_space,
        "isa": isa or "",
        "checkpoint": None if no_checkpoint else checkpoint,
        "resume": resume,
        "keep_checkpoint": keep_checkpoint,
        "output": output,
        "aa": aa or 0,
        "spp": spp or 0,
        "size": size or resolution or (0, 0),
    }
    if region is not None:
        settings["region"] = region
    if seed is not None:
        settings["seed"] = seed
    silent = quiet or verbosity == 0
    compiled = _scene_options.compile_scene(
        path, write_files=True, assignments=assignments, **settings
    )
    with _signals.interrupt() as came:
        outcome = _run(compiled, came, silent=silent, json=json)
    if json:
        _output.print_json(_document(path, compiled, outcome))
    elif outcome is not None and not silent:
        _print_summary(compiled, outcome)
    if came:
        raise typer.Exit(_signals.exit_code(came[0]))
    if compiled.n_errors:
        raise typer.Exit(1)


def _run(compiled: CompiledScene, came: list[int], *, silent: bool, json: bool) -> Outcome | None:
    """Renders if that is possible, with diagnostics and progress on standard error.

    `came` has the signals that came so far.
    """

    def report(first: int) -> int:
        items = compiled.diagnostics
        if not json:
            shown = (item for item in items[first:] if not silent or item.severity == "error")
            _output.print_diagnostics(shown)
        return len(items)

    n_reported = report(0)
    if not compiled.usable:
        return None
    with _progress.reporter(quiet=silent) as progress:
        outcome = compiled.render(progress)
    report(n_reported)
    if outcome.interrupted:
        _say_stopped(outcome, _signals.name_of(came[0]))
    return outcome
