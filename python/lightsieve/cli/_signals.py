"""Ctrl-C, and SIGTERM as render farms send it: what is done is kept, and the exit code says so."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

_NUMBERS = (signal.SIGINT, signal.SIGTERM)
_Handler = Callable[[int, FrameType | None], None]


def name_of(number: int) -> str:
    """The signal as a person knows it."""
    return "Ctrl-C" if number == signal.SIGINT else signal.Signals(number).name


def exit_code(number: int) -> int:
    """What a shell reports for a program that a signal ended: 130 for Ctrl-C."""
    return 128 + number


@contextmanager
def _handled_by(handler: _Handler) -> Iterator[None]:
    before = [(number, signal.signal(number, handler)) for number in _NUMBERS]
    try:
        yield
    finally:
        for number, old in before:
            signal.signal(number, old)


def _leave(number: int, _frame: FrameType | None) -> None:
    text = f"stopped by {name_of(number)} before the first ray; nothing was written"
    print(text, file=sys.stderr, flush=True)
    os._exit(exit_code(number))


@contextmanager
def end_process() -> Iterator[None]:
    """A signal ends the process at once: for work that has no half way and writes nothing."""
    with _handled_by(_leave):
        yield


@contextmanager
def interrupt() -> Iterator[list[int]]:
    """A signal raises KeyboardInterrupt.

    Yields:
        The numbers of the signals that came.
    """
    came: list[int] = []

    def handle(number: int, _frame: FrameType | None) -> None:
        came.append(number)
        raise KeyboardInterrupt

    with _handled_by(handle):
        yield came
