"""`lightsieve check`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lightsieve.cli import _output, _scene_options
from lightsieve.cli._output import plural

if TYPE_CHECKING:
    from lightsieve._core import CompiledScene, SceneSummary

EXAMPLE = "lightsieve check shot.ass --strict"
JSON = {
    "scene": "the file",
    "ok": "true if there are no errors",
    "errors": "how many",
    "warnings": "how many",
    "lints": "how many",
    "diagnostics": "the first 20 errors and 200 warnings and lints",
    "summary": "null if errors forbid rendering, else an object: `width`, `height`, "
    "`samples_per_pixel`, `shapes`, `instances`, `triangles`, `spheres`, `lights`, `shaders`, "
    "`light_groups`, `expressions`, `states`, `atoms`, `files` (each `path` and `layers`: `name`, "
    "`aov`, `type`, `expression`, `light_group`), `partitions`",
}


def summary_document(summary: SceneSummary) -> dict[str, Any]:
    """The summary as `--json` prints it."""
    return {
        "width": summary.width,
        "height": summary.height,
        "samples_per_pixel": summary.samples_per_pixel,
        "shapes": summary.n_shapes,
        "instances": summary.n_instances,
        "triangles": summary.n_triangles,
        "spheres": summary.n_spheres,
        "lights": summary.n_lights,
        "shaders": summary.n_shaders,
        "light_groups": summary.light_groups,
        "expressions": summary.n_aovs,
        "states": summary.n_states,
        "atoms": summary.n_atoms,
        "files": [
            {
                "path": path,
                "layers": [
                    {
                        "name": layer.name,
                        "aov": layer.aov,
                        "type": layer.aov_type,
                        "expression": layer.expression,
                        "light_group": layer.light_group,
                    }
                    for layer, of in zip(summary.layers, summary.layer_file, strict=True)
                    if of == index
                ],
            }
            for index, path in enumerate(summary.files)
        ],
        "partitions": summary.partitions,
    }


def _print_summary(scene: str, summary: SceneSummary) -> None:
    groups = ", ".join([*summary.light_groups, "default"])
    shapes = f"{plural(summary.n_triangles, 'triangle')}, {plural(summary.n_spheres, 'sphere')}"
    rows = [
        ("scene", scene),
        (
            "frame",
            f"{summary.width} x {summary.height}, "
            f"{plural(summary.samples_per_pixel, 'sample')} a pixel",
        ),
        ("shapes", f"{summary.n_shapes:,} ({shapes}), placed {summary.n_instances:,} times"),
        ("shaders", f"{summary.n_shaders:,}"),
        ("lights", f"{summary.n_lights:,}, groups: {groups}"),
        (
            "AOVs",
            f"{plural(len(summary.layers), 'layer')}; {plural(summary.n_aovs, 'expression')} in "
            f"{plural(summary.n_states, 'state')} and {plural(summary.n_atoms, 'atom')}",
        ),
    ]
    for index, path in enumerate(summary.files):
        names = [
            layer.name
            for layer, of in zip(summary.layers, summary.layer_file, strict=True)
            if of == index
        ]
        rows.append(("file", f"{path}: {', '.join(names)}"))
    rows.extend(("proved", partition) for partition in summary.partitions)
    _output.print_table(rows, ["bold"])


def count_text(scene: CompiledScene) -> str:
    """`1 error, 2 warnings, no lints`."""
    counts = [(scene.n_errors, "error"), (scene.n_warnings, "warning"), (scene.n_lints, "lint")]
    return ", ".join(plural(n, noun) if n else f"no {noun}s" for n, noun in counts)


def command(
    scene: Annotated[
        Path, typer.Argument(metavar="SCENE.ass", help="The scene, .ass or .ass.gz.")
    ],
    strict: _scene_options.Strict = False,
    lpe_standard: _scene_options.LpeStandard = False,
    lpe_table: _scene_options.LpeTable = None,
    assignments: _scene_options.Assignments = None,
    json: _output.Json = False,
) -> None:
    """Report every error and lint of a scene.

    Reads and compiles everything, renders nothing; then says what the scene holds, what a render
    would write, and which sums of its AOVs were proved.
    """
    compiled = _scene_options.compile_scene(
        scene,
        write_files=True,
        assignments=assignments,
        strict=strict,
        lpe_standard=lpe_standard,
        lpe_table=lpe_table or "",
    )
    summary = compiled.summary() if compiled.usable else None
    if json:
        _output.print_json(
            {
                "scene": str(scene),
                "ok": compiled.n_errors == 0,
                "errors": compiled.n_errors,
                "warnings": compiled.n_warnings,
                "lints": compiled.n_lints,
                "diagnostics": [item.to_dict() for item in compiled.diagnostics],
                "summary": None if summary is None else summary_document(summary),
            }
        )
    else:
        _output.print_diagnostics(compiled.diagnostics)
        if summary is not None:
            _print_summary(str(scene), summary)
        typer.echo(count_text(compiled))
    if compiled.n_errors:
        raise typer.Exit(1)
