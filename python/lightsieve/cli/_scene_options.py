"""What the commands that read a scene share: options, and how they say what they found."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Unpack

import typer

from lightsieve.cli import _signals
from lightsieve.cli._output import plural

if TYPE_CHECKING:
    from lightsieve import rendering
    from lightsieve._core import CompiledScene

Strict = Annotated[bool, typer.Option("--strict", help="Unknown nodes and parameters are errors.")]
LpeStandard = Annotated[
    bool,
    typer.Option("--lpe-standard", help="Our extensions of the expression language are errors."),
]
LpeTable = Annotated[
    Literal["reference", "arnold7"] | None,
    typer.Option(
        "--lpe-table", help="Which reading of the built-in AOVs; as the scene says if not given."
    ),
]
Assignments = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="NODE.PARAM=VALUE", help="Change a parameter; may be repeated."),
]


def _parse_bytes(text: str) -> int:
    found = re.fullmatch(r"(\d+(?:\.\d+)?) ?([KMGT]?)(?:i?B)?", text, re.IGNORECASE)
    if found is None:
        raise typer.BadParameter(f'"{text}" is no size: write 4G, 512M or a number of bytes')
    return int(float(found[1]) * 1024 ** " KMGT".index(found[2].upper() or " "))


MaxMemory = Annotated[
    Any,
    typer.Option(
        "--max-memory",
        parser=_parse_bytes,
        metavar="SIZE",
        help="Refuse to render what may take more memory than this, such as 4G or 512M.",
        show_default=False,
    ),
]

DIAGNOSTICS_JSON = {
    "errors": "how many",
    "warnings": "how many",
    "lints": "how many",
    "diagnostics": "the first 20 errors and 200 warnings and lints",
}
"""Keys of `diagnostics_document`, for the commands' own `JSON`."""


def diagnostics_document(scene: CompiledScene) -> dict[str, Any]:
    """What was found wrong, as `--json` prints it."""
    return {
        "errors": scene.n_errors,
        "warnings": scene.n_warnings,
        "lints": scene.n_lints,
        "diagnostics": [item.to_dict() for item in scene.diagnostics],
    }


def count_text(scene: CompiledScene) -> str:
    """`1 error, 2 warnings, no lints`."""
    counts = [(scene.n_errors, "error"), (scene.n_warnings, "warning"), (scene.n_lints, "lint")]
    return ", ".join(plural(n, noun) if n else f"no {noun}s" for n, noun in counts)


def compile_scene(
    scene: Path,
    *,
    write_files: bool,
    assignments: list[str] | None,
    **settings: Unpack[rendering.Settings],
) -> CompiledScene:
    """Reads and compiles a scene; Ctrl-C ends the process.

    Args:
        scene: The file.
        write_files: Let a render write the scene's files.
        assignments: `NODE.PARAM=VALUE` each.
        **settings: As `lightsieve.render` takes them.

    Returns:
        The scene with its diagnostics.
    """
    from lightsieve import rendering

    with _signals.end_process():
        return rendering.compile_scene(
            scene,
            capture=False,
            write_files=write_files,
            assignments=assignments or (),
            **settings,
        )
