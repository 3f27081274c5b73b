"""Checking and rendering scenes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple, TypedDict, Unpack

from lightsieve import statistics
from lightsieve._core import CompiledScene, RenderOptions, RenderProgress, SceneSummary
from lightsieve.errors import Diagnostic, LightsieveError
from lightsieve.frame import Frame, Layer
from lightsieve.statistics import StatisticsFile

Path = str | os.PathLike[str]


class Settings(TypedDict, total=False):
    """What a caller may say beyond the scene; what is left out is as the scene says."""

    aovs: Iterable[str]
    """Outputs added to the first EXR driver if it lacks them: `"diffuse"` (RGB), `"N VECTOR"`."""
    lpes: Mapping[str, str]
    """Expressions by name, defined and output as RGB."""
    output: Path
    """A folder for the drivers' relative file names, or the first driver's file."""
    aa: int
    """AA_samples: aa * aa samples a pixel."""
    spp: int
    """Samples a pixel; wins over `aa`."""
    size: tuple[int, int]
    """Width and height of the frame [pixels]."""
    region: tuple[int, int, int, int]
    """x0, y0, x1, y1 from the upper left corner, both ends included [pixels]."""
    threads: int
    """0: as many as the machine has. The picture does not depend on it."""
    seed: int
    """Another seed gives other noise."""
    camera: str
    """Name of a camera node."""
    set: Mapping[str, object]
    """`{"node.param": value}`, values as in a scene file."""
    strict: bool
    """Unknown nodes and parameters are errors, not warnings."""
    lpe_standard: bool
    """Our extensions of the expression language are errors."""
    lpe_table: str
    """`reference` or `arnold7`: which reading of the built-in AOVs."""
    rendering_space: str
    """Colour space that light is computed in, by name; empty: as the scene says, or ACEScg."""
    guiding: bool
    """Learn where light comes from, from an eighth more samples, and send part of the rays of
    diffuse lobes and sheen there: less noise where caustics must be found by chance."""
    checkpoint: float | None
    """Minutes between two writes of what is done to FILE.checkpoint beside the first file; 0: only
    when the render ends before time; None: never, unless `resume` or `keep_checkpoint` ask for
    it."""
    resume: bool
    """Go on from the checkpoint, if there is one."""
    keep_checkpoint: bool
    """Keep it also when the render is done, to go on with more samples."""
    max_memory: int
    """The render is refused if its forecast exceeds this [bytes]; 0: no limit."""
    tev: str
    """`HOST:PORT` of the viewer tev, which shows the picture as it grows."""
    tev_aovs: Iterable[str]
    """Names of the layers that it shows, `*` for all; empty: the first one."""
    stats: Path
    """A file for the statistics of renders (JSON), written anew."""
    isa: str
    """`sse2`, `avx2` or `avx512`: pins the ray kernels, for equal bits on unlike machines."""


class Report(NamedTuple):
    """What `check` found."""

    summary: SceneSummary | None
    """What the scene holds; None if errors forbid rendering."""
    diagnostics: tuple[Diagnostic, ...]
    """Errors, warnings and lints in the order in which they were found."""

    @property
    def ok(self) -> bool:
        """No errors; there may be warnings and lints."""
        return all(item.severity != "error" for item in self.diagnostics)


def compile_scene(
    scene: Path,
    *,
    capture: bool,
    write_files: bool,
    assignments: Iterable[str] = (),
    **settings: Unpack[Settings],
) -> CompiledScene:
    """Reads and compiles a scene; never raises for bad input, its `diagnostics` have it.

    Args:
        scene: An `.ass` or `.ass.gz` file.
        capture: Keep the layers of a render in memory.
        write_files: Let a render write the scene's files.
        assignments: `node.param=value` each, beside those of the settings.
        **settings: See `Settings`.

    Returns:
        The scene, ready to render if it is `usable`.

    Example:
        >>> compile_scene("scene.ass", capture=False, write_files=False).usable
        True
    """
    options = RenderOptions()
    options.capture = capture
    options.write_files = write_files
    options.output = os.fspath(settings.get("output", ""))
    options.aa_samples = settings.get("aa", 0)
    options.spp = settings.get("spp", 0)
    options.width, options.height = settings.get("size", (0, 0))
    options.threads = settings.get("threads", 0)
    options.seed = settings.get("seed")
    options.camera = settings.get("camera", "")
    options.aovs = [
        aov if " " in aov.strip() else f"{aov} RGB" for aov in settings.get("aovs", ())
    ]
    options.lpes = [
        f"{name} {expression}" for name, expression in settings.get("lpes", {}).items()
    ]
    options.lpe_standard = settings.get("lpe_standard", False)
    options.lpe_table = settings.get("lpe_table", "")
    options.rendering_space = settings.get("rendering_space", "")
    options.isa = settings.get("isa", "")
    options.guiding = settings.get("guiding", False)
    minutes = settings.get("checkpoint")
    options.resume = settings.get("resume", False)
    options.keep_checkpoint = settings.get("keep_checkpoint", False)
    options.checkpoints = minutes is not None or options.resume or options.keep_checkpoint
    options.checkpoint_minutes = minutes or 0.0
    options.max_memory = settings.get("max_memory", 0)
    options.viewer = settings.get("tev", "")
    options.viewer_layers = list(settings.get("tev_aovs", ()))
    if "region" in settings:
        options.set_region(*settings["region"])
    changes = [f"{key}={_as_written(value)}" for key, value in settings.get("set", {}).items()]
    return CompiledScene(
        os.fspath(scene), options, settings.get("strict", False), [*changes, *assignments]
    )


def _as_written(value: object) -> str:
    """A value as a scene file writes it."""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, tuple | list):
        return " ".join(_as_written(part) for part in value)
    return str(value)


def check(scene: Path, **settings: Unpack[Settings]) -> Report:
    """Reads and compiles everything, renders nothing.

    Args:
        scene: An `.ass` or `.ass.gz` file.
        **settings: See `Settings`.

    Returns:
        What the scene holds, and everything that is wrong or doubtful in it.

    Example:
        >>> check("scene.ass").summary.n_lights
        2
    """
    compiled = compile_scene(scene, capture=False, write_files=True, **settings)
    return Report(compiled.summary() if compiled.usable else None, compiled.diagnostics)


def render(
    scene: Path,
    *,
    progress: Callable[[RenderProgress], object] | None = None,
    write: bool = False,
    **settings: Unpack[Settings],
) -> Frame:
    """Renders a scene and returns its layers.

    Args:
        scene: An `.ass` or `.ass.gz` file.
        progress: Called about ten times a second.
        write: Write the scene's files too; giving `output` does as much.
        **settings: See `Settings`.

    Returns:
        Every layer that the scene's outputs, `aovs` and `lpes` ask for.

    Raises:
        LightsieveError: The scene has errors; all that were found.
        KeyboardInterrupt: Ctrl-C; what was done is in the files.

    Example:
        >>> frame = render("scene.ass", aovs=["diffuse"], lpes={"mirrored": "CS[LOB]"})
        >>> frame.layers()
        ['RGBA', 'diffuse', 'mirrored']
    """
    compiled = compile_scene(
        scene, capture=True, write_files=write or "output" in settings, **settings
    )
    if not compiled.usable:
        raise LightsieveError([item for item in compiled.diagnostics if item.severity == "error"])
    stats = StatisticsFile(settings["stats"], append=False) if "stats" in settings else None
    outcome = compiled.render(progress)
    if stats is not None:
        stats.write(statistics.of_render(compiled, outcome))
    if outcome.interrupted:
        raise KeyboardInterrupt
    layers = [
        (
            Layer(
                info.name,
                info.aov,
                info.aov_type,
                info.expression,
                info.light_group,
                info.filter,
                info.filter_width,
            ),
            pixels,
        )
        for info, pixels in outcome.layers
    ]
    return Frame(
        layers,
        files=outcome.files,
        diagnostics=compiled.diagnostics,
        samples=outcome.samples,
        seconds=outcome.seconds,
    )
