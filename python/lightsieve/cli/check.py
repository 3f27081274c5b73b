"""`lightsieve check`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lightsieve import statistics
from lightsieve.cli import _output, _scene_options, _summary
from lightsieve.cli._output import plural

if TYPE_CHECKING:
    from lightsieve._core import SceneSummary
    from lightsieve.survey import Missing, Survey

# Lines of one kind that are printed; --json has all.
_MAX_LINES = 8

EXAMPLE = "lightsieve check shot.ass --strict"
JSON = {
    "scene": "the file",
    "ok": "true if there are no errors",
    **_scene_options.DIAGNOSTICS_JSON,
    "summary": "null if errors forbid rendering, else an object: `width`, `height`, "
    "`samples_per_pixel`, `shapes`, `instances`, `triangles`, `spheres`, `lights`, `shaders`, "
    "`light_groups`, `expressions`, `states`, `atoms`, `files` (each `path` and `layers`: `name`, "
    "`aov`, `type`, `expression`, `light_group`), `partitions`, "
    "`forecast` (see `render`)",
    "aovs": "null if errors forbid rendering or the proofs would take too long, else an object: "
    "`sums` (each `whole`, `parts`, `everywhere`: over all paths, not only those of this scene, "
    "`lost_elsewhere`: null or `text`, `words`), `missing` (null, or what the layers that come "
    "nearest to the beauty leave over: `parts`, `expression`, `builtins`, `example`, `left_out`), "
    "`equal` and `contained` (pairs of names), `dead` (AOVs that are black in this scene)",
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
        "forecast": statistics.forecast(summary),
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
    rows += _summary.forecast_rows(summary)
    for index, path in enumerate(summary.files):
        names = [
            layer.name
            for layer, of in zip(summary.layers, summary.layer_file, strict=True)
            if of == index
        ]
        rows.append(("file", f"{path}: {', '.join(names)}"))
    _output.print_table(rows, ["bold"])


def _survey_rows(survey: Survey) -> list[tuple[str, str]]:
    """What is told of a survey, one line a fact."""
    sums = []
    for one in survey.sums:
        text = f"{one.whole} = {' + '.join(one.parts)}"
        if one.lost_elsewhere is not None:
            text += f"  (here; elsewhere {one.lost_elsewhere} would be lost)"
        sums.append(text)
    rows = _lines("adds up", sums)
    if survey.missing is not None:
        rows += _missing_rows(survey.missing)
    rows += _lines("same", [f"{a} and {b} take the same paths" for a, b in survey.equal])
    rows += _lines("inside", _inside(survey))
    if survey.dead:
        rows.append(("black", f"{_output.listed(survey.dead)}: this scene makes no such paths"))
    return rows


def _missing_rows(missing: Missing) -> list[tuple[str, str]]:
    need = f"an AOV {missing.expression}"
    if missing.builtins:
        need = f"{_output.listed(missing.builtins)}, or one AOV {missing.expression}"
    texts = [
        need,
        f"to add up to RGBA with {_output.listed(missing.parts)}",
        f"so far {missing.example} is in none: {missing.example.words}",
    ]
    for one in missing.left_out:
        texts.append(
            f"{one.name} cannot be added: with {one.overlaps} it would count {one.example} twice"
        )
    return _lines("missing", texts)


def _lines(head: str, texts: list[str]) -> list[tuple[str, str]]:
    rows = [(head if i == 0 else "", text) for i, text in enumerate(texts[:_MAX_LINES])]
    if len(texts) > _MAX_LINES:
        rows.append(("", f"and {len(texts) - _MAX_LINES} more, see --json"))
    return rows


def _inside(survey: Survey) -> list[str]:
    """Containments that do not follow from other lines."""
    pairs = set(survey.contained)
    parts = {(part, one.whole) for one in survey.sums for part in one.parts}
    return [
        f"{a} is a part of {b}"
        for a, b in survey.contained
        if (a, b) not in parts and not any((a, c) in pairs and (c, b) in pairs for c, _ in pairs)
    ]


def command(
    scene: Annotated[
        Path, typer.Argument(metavar="SCENE.ass", help="The scene, .ass or .ass.gz.")
    ],
    strict: _scene_options.Strict = False,
    lpe_standard: _scene_options.LpeStandard = False,
    lpe_table: _scene_options.LpeTable = None,
    assignments: _scene_options.Assignments = None,
    max_memory: _scene_options.MaxMemory = None,
    json: _output.Json = False,
) -> None:
    """Report every error and lint of a scene.

    Reads and compiles everything, renders nothing; then says what the scene holds, what a render
    would write, and what its AOVs are to one another: which add up (proved over all paths), what
    is missing, which are the same, contained in others, or black in this scene.
    """
    compiled = _scene_options.compile_scene(
        scene,
        write_files=True,
        assignments=assignments,
        strict=strict,
        lpe_standard=lpe_standard,
        lpe_table=lpe_table or "",
        max_memory=max_memory or 0,
        checkpoint=0,  # as a render would: it counts in the forecast
    )
    summary = compiled.summary() if compiled.usable else None
    found = None
    if compiled.usable:
        from lightsieve.survey import survey

        found = survey(compiled)
    if json:
        _output.print_json(
            {
                "scene": str(scene),
                "ok": compiled.n_errors == 0,
                **_scene_options.diagnostics_document(compiled),
                "summary": None if summary is None else summary_document(summary),
                "aovs": None if found is None else found.to_dict(),
            }
        )
    else:
        _output.print_diagnostics(compiled.diagnostics)
        if summary is not None:
            _print_summary(str(scene), summary)
        if found is not None:
            _output.print_table(_survey_rows(found), ["bold"])
        typer.echo(_scene_options.count_text(compiled))
    if compiled.n_errors:
        raise typer.Exit(1)
