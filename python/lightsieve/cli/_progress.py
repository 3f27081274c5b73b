"""How a render tells how far it is: a bar on a terminal, a line every few seconds in a log."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Protocol

from lightsieve.cli import _output

if TYPE_CHECKING:
    from lightsieve._core import RenderProgress

LOG_INTERVAL_S = 5.0
_LONGEST_INTERVAL_S = 60.0
# Of the time that a render has taken: an hour is told in about a hundred lines.
_INTERVAL_SHARE = 0.05


class Reporter(Protocol):
    """Is told about ten times a second how far the render is."""

    def __call__(self, now: RenderProgress) -> None:
        """Shows it, or does not."""


def interval_s(taken_s: float) -> float:
    """Time between two lines of a log.

    Args:
        taken_s: By the render so far [s].
    """
    return min(max(LOG_INTERVAL_S, _INTERVAL_SHARE * taken_s), _LONGEST_INTERVAL_S)


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


class _Clock:
    """Rate and time left by a clock of our own: a report may be older than its showing."""

    def __init__(self) -> None:
        self._start: float | None = None

    def rate_and_rest(self, now: RenderProgress) -> tuple[float, str]:
        """Samples a second, and the time left as text."""
        if self._start is None:
            self._start = time.monotonic() - now.seconds
        seconds = time.monotonic() - self._start
        rate = now.samples_done / seconds if seconds > 0 else 0.0
        return rate, _clock((now.samples_total - now.samples_done) / rate) if rate > 0 else "?"


def _noise(now: RenderProgress) -> str:
    """How noisy the buckets are that are done, once it is known."""
    return f", noise {now.noise:.1%}" if now.noise >= 0 else ""


class _Log:
    """A line every few seconds; the longer it takes the fewer."""

    def __init__(self) -> None:
        self._clock = _Clock()
        self._start = time.monotonic()
        self._next = self._start + LOG_INTERVAL_S
        self._shown = 0

    def __call__(self, now: RenderProgress) -> None:
        rate, left = self._clock.rate_and_rest(now)
        if time.monotonic() < self._next or now.samples_done == self._shown:
            return
        taken = time.monotonic() - self._start
        self._next = self._start + taken + interval_s(taken)
        self._shown = now.samples_done
        percent = 100 * now.samples_done // now.samples_total
        _output.say(
            f"{percent}%: {now.samples_done:,} of {now.samples_total:,} samples, "
            f"{rate:,.0f} samples/s, {left} left{_noise(now)}"
        )


@contextmanager
def _bar() -> Iterator[Reporter]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (
        BarColumn(),
        TextColumn("{task.percentage:>3.0f}%"),
        TextColumn("{task.description}"),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("", total=None)
        clock = _Clock()

        def show(now: RenderProgress) -> None:
            rate, left = clock.rate_and_rest(now)
            text = f"{now.samples_done:,} samples, {rate:,.0f}/s, {left} left{_noise(now)}"
            progress.update(
                task, total=now.samples_total or None, completed=now.samples_done, description=text
            )

        yield show


@contextmanager
def reporter(quiet: bool) -> Iterator[Reporter | None]:
    """What to hand to a render as its `progress`.

    Args:
        quiet: Show nothing.
    """
    if quiet:
        yield None
    elif sys.stderr.isatty():
        with _bar() as show:
            yield show
    else:
        yield _Log()
