"""What the commands that ask the engine share: options, the context, how they show a path."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from lightsieve.cli import _output, _scene_options

if TYPE_CHECKING:
    from lightsieve import lpe

Scene = Annotated[
    Path | None,
    typer.Option(
        "--scene",
        metavar="SCENE.ass",
        help="Ask about the paths that this scene can make, with its own expressions.",
    ),
]
LpeStandard = _scene_options.LpeStandard
LpeTable = Annotated[
    Literal["reference", "arnold7"] | None,
    typer.Option(
        "--lpe-table",
        help="Which reading of the built-in AOVs; reference, or as the scene says, if not given.",
    ),
]
Definitions = Annotated[
    list[str] | None,
    typer.Option(
        "--lpe",
        metavar='"NAME EXPR"',
        help="Define an expression for $NAME; may be repeated.",
    ),
]
Of = Annotated[
    str, typer.Option("--of", metavar="EXPR", help="The whole, an expression or an AOV's name.")
]
EXPRESSION_HELP = "An expression, or the name of an AOV."


def context(
    scene: Path | None,
    table: Literal["reference", "arnold7"] | None,
    standard: bool,
    definitions: list[str] | None,
) -> lpe.Context:
    """What expressions are read in.

    Args:
        scene: Only its paths and names; all paths if not given.
        table: Which built-ins.
        standard: Refuse our extensions.
        definitions: `NAME EXPRESSION` each.

    Returns:
        The context.

    Raises:
        LightsieveError: The scene or a definition has errors.
    """
    from lightsieve import lpe

    named: dict[str, str] = {}
    for definition in definitions or ():
        name, _, text = definition.strip().partition(" ")
        if not text:
            raise typer.BadParameter(f'"{definition}" is no "NAME EXPR"', param_hint="--lpe")
        named[name] = text.strip()
    if scene is None:
        return lpe.Context(table or "reference", definitions=named, standard=standard)
    from lightsieve.cli import _signals

    with _signals.end_process():
        return lpe.Context.of_scene(scene, table, definitions=named, standard=standard)


def path_document(path: lpe.Path | None) -> dict[str, Any] | None:
    """A path as `--json` prints it."""
    return None if path is None else path._asdict()


def label(expression: lpe.Expression) -> str:
    """An expression as a sentence names it."""
    return expression.name or expression.text


def print_path(mark: str, path: lpe.Path, *about: str) -> None:
    """Prints a path and, below it, its words.

    Args:
        mark: What stands before it, e.g. `lost`.
        path: The path.
        *about: Told after the words, each in a line of its own.
    """
    _output.print_item(mark, path.text, path.words, *about)
