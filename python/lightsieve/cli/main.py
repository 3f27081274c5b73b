"""The program `lightsieve`: finds the commands, runs one, turns failures into exit codes."""

from __future__ import annotations

import io
import os
import pkgutil
import sys
import traceback
from collections.abc import Sequence
from importlib import import_module
from typing import Annotated, Any, NoReturn

import typer

import lightsieve
from lightsieve import cli
from lightsieve.cli import _output
from lightsieve.errors import LightsieveError, without_place

# What a group of commands is for; a file `exr_info.py` belongs to the group `exr`.
GROUPS = {
    "exr": "Look at, check and compare EXR files.",
    "lpe": "Ask the engine of light path expressions.",
}

EXIT_INPUT = 1
EXIT_BUG = 3
# Made beforehand: there may be no memory for it later.
_OUT_OF_MEMORY = without_place(
    "limit-memory",
    "not enough memory",
    "smaller pictures or scenes, or a machine with more memory",
)


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"lightsieve {lightsieve.__version__}")
        raise typer.Exit


def _top(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """Separate the light of a rendering by the path that it took.

    Exit codes: 0 ok, 1 bad input or a check that failed, 2 usage, 3 a bug of ours, 130 Ctrl-C.
    """


def command_files(arguments: Sequence[str] = ()) -> list[str]:
    """The files that a call needs: that of its command, or all of them.

    Making a command ready costs more than most commands do, so a call that names one loads no
    other.

    Args:
        arguments: Of the call, without the program's name.

    Returns:
        Names of modules of this package.

    Example:
        >>> command_files(["lpe", "rest", "diffuse"])
        ['lpe_rest']
        >>> "nodes" in command_files(["--help"])
        True
    """
    files = [
        found.name
        for found in pkgutil.iter_modules(cli.__path__)
        if not found.name.startswith("_") and found.name != "main"
    ]
    named = [name for name in ("_".join(arguments[:2]), *arguments[:1]) if name in files]
    return named[:1] or files


def build_app(pretty: bool, files: Sequence[str] | None = None) -> typer.Typer:
    """Gathers the commands of this package.

    Args:
        pretty: Help and usage errors with boxes and colours, for a terminal.
        files: The commands' files; all if not given.

    Returns:
        The program.

    Example:
        >>> build_app(pretty=False).info.name
        'lightsieve'
    """
    settings: dict[str, Any] = {
        "no_args_is_help": True,
        "rich_markup_mode": "rich" if pretty else None,
        "pretty_exceptions_enable": False,
        "context_settings": {"help_option_names": ["-h", "--help"]},
    }
    app = typer.Typer(name="lightsieve", **settings)
    app.callback()(_top)
    groups: dict[str, typer.Typer] = {}
    for file in command_files() if files is None else files:
        module = import_module(f"lightsieve.cli.{file}")
        group_name, _, name = file.rpartition("_")
        if group_name and group_name not in groups:
            groups[group_name] = typer.Typer(**settings)
            app.add_typer(groups[group_name], name=group_name, help=GROUPS[group_name])
        parent = groups[group_name] if group_name else app
        parent.command(name, epilog=f"Example: {module.EXAMPLE}")(module.command)
    return app


def _report_bug() -> None:
    version = getattr(lightsieve, "__version__", "?")
    traceback.print_exc()
    print(
        f"lightsieve {version}: bug: see above\n"
        "please report this with the scene or the expression that caused it",
        file=sys.stderr,
    )


def main() -> NoReturn:
    """Runs the command line and exits."""
    from lightsieve import _lpe

    _lpe.exit_3_on_bug()
    # Names and paths of scenes need not be UTF-8: they are printed as the bytes that they are.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="surrogateescape")
    try:
        pretty = sys.stderr.isatty() and sys.stdout.isatty()
        build_app(pretty, command_files(sys.argv[1:]))()
    except LightsieveError as error:
        _output.report_failure(error)
        code = EXIT_INPUT
    except MemoryError:
        _output.report_failure(LightsieveError([_OUT_OF_MEMORY]))
        code = EXIT_INPUT
    except BrokenPipeError:
        # The reader has gone (`lightsieve lpe list | head`): say nothing more, not even at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = EXIT_INPUT
    except Exception:
        _report_bug()
        code = EXIT_BUG
    sys.exit(code)
