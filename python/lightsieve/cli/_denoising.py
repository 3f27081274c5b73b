"""What `lightsieve denoise` and `lightsieve render --denoise` share."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from lightsieve.cli import _output, _signals
from lightsieve.cli._progress import LOG_INTERVAL_S
from lightsieve.errors import LightsieveError, without_place

if TYPE_CHECKING:
    from lightsieve.denoising import Denoised

JSON = {
    "file": "the noisy file",
    "denoised": "the new file",
    "layers": "names of the layers that were denoised",
    "kept": "names of the layers that are as they were",
    "sums": "that the header claims and that hold again",
    "albedo": "names of the layers that were added up for the albedo",
    "normal": "name of the layer with the normal, or null",
    "nonfinite": "by layer: values that were no numbers and became means of their neighbours",
}

# Outputs that help, with their types.
HELPERS = ("albedo RGB", "N VECTOR")


def document(file: Path, done: Denoised) -> dict[str, Any]:
    """What was done, as `--json` prints it."""
    return {
        "file": str(file),
        "denoised": done.file,
        "layers": list(done.layers),
        "kept": list(done.kept),
        "sums": list(done.sums),
        "albedo": list(done.albedo),
        "normal": done.normal or None,
        "nonfinite": done.nonfinite,
    }


def print_done(done: Denoised) -> None:
    """What was done, for people: results to standard output, what to do better to the other."""
    helpers = [*done.albedo, *([done.normal] if done.normal else [])]
    text = f"wrote {done.file}: {_output.plural(len(done.layers), 'layer')} denoised"
    if helpers:
        text += f", with the help of {_output.listed(helpers)}"
    if done.sums:
        text += f", {_output.plural(len(done.sums), 'sum')} kept"
    typer.echo(text)
    for name, n in done.nonfinite.items():
        _output.say(f"{name}: {_output.plural(n, 'value')} that were no numbers were replaced")
    lacking = [
        output
        for output, there in zip(HELPERS, (done.albedo, done.normal), strict=True)
        if not there
    ]
    if lacking:
        options = " ".join(f'--aov "{output}"' for output in lacking)
        _output.say(f"detail would be kept better by layers that the file lacks: {options}")


@contextmanager
def progress(quiet: bool) -> Iterator[Callable[[str, int, int], None] | None]:
    """What to hand to `lightsieve.denoise` as its `progress`.

    Args:
        quiet: Show nothing.
    """
    if quiet:
        yield None
    elif sys.stderr.isatty():
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn

        columns = (BarColumn(), TextColumn("{task.completed}/{task.total} {task.description}"))
        with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
            task = bar.add_task("", total=None)
            yield lambda name, n_done, n_all: bar.update(
                task, total=n_all, completed=n_done, description=name
            )
    else:
        last = time.monotonic()

        def log(name: str, n_done: int, n_all: int) -> None:
            nonlocal last
            if time.monotonic() >= last + LOG_INTERVAL_S and n_done < n_all:
                last = time.monotonic()
                _output.say(f"denoising {name}: {n_done} of {n_all} layers done")

        yield log


def require_denoiser() -> None:
    """Says before the scene is read that nothing can be denoised here.

    Raises:
        LightsieveError: It cannot (code `denoiser-missing`).
    """
    from lightsieve import denoise_oidn

    denoise_oidn.require()


def require_picture(files: Sequence[str]) -> None:
    """Says before the first ray that a render's files cannot be denoised.

    Args:
        files: What the render would write.

    Raises:
        LightsieveError: None is an EXR file (code `denoise`).
    """
    if not any(map(is_exr, files)):
        message = "--denoise needs an EXR file, the render writes none"
        hint = "add an output to a driver_exr; pictures of other formats are not denoised"
        raise LightsieveError([without_place("denoise", message, hint)])


def is_exr(file: str) -> bool:
    """By its name."""
    return file.lower().endswith(".exr")


Results = list[tuple[str, "Denoised | LightsieveError"]]
"""For each EXR file what was done or why nothing was."""


def denoise_files(
    files: Sequence[str], came: Sequence[int], *, threads: int, quiet: bool
) -> Results:
    """Denoises what a render wrote, each EXR file to a new one beside it.

    Args:
        files: Of the render; the first that has an albedo helps those after it that have none.
        came: Has the signals that came; one ends it.
        threads: 0: as many as the machine has.
        quiet: Show no progress.
    """
    from lightsieve.denoising import denoise

    out: Results = []
    helpers: str | None = None
    try:
        for file in filter(is_exr, files):
            try:
                with progress(quiet) as show:
                    done = denoise(file, helpers=helpers, threads=threads, progress=show)
                out.append((file, done))
                if helpers is None and done.albedo:
                    helpers = file
            except LightsieveError as error:
                out.append((file, error))
    except KeyboardInterrupt:
        _output.say(
            f"denoising was stopped by {_signals.name_of(came[0])}; the render is complete"
        )
    return out


def print_results(results: Results, *, quiet: bool) -> None:
    """What was done to each file, for people; with `quiet` only why nothing was."""
    for _, result in results:
        if isinstance(result, LightsieveError):
            _output.print_diagnostics(result.errors)
        elif not quiet:
            print_done(result)


def documents(results: Results) -> list[dict[str, Any]]:
    """What was done to each file, as `--json` prints it."""
    return [
        {"file": file, "errors": [item.to_dict() for item in result.errors]}
        if isinstance(result, LightsieveError)
        else document(Path(file), result)
        for file, result in results
    ]


def failed(results: Results) -> bool:
    """Whether a file could not be denoised."""
    return any(isinstance(result, LightsieveError) for _, result in results)
