"""What a render prints of its diagnostics, and the file that gets a copy (options.log_*)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from lightsieve.cli import _output

if TYPE_CHECKING:
    from lightsieve._core import CompiledScene, LogSettings

_MAX_WARNINGS = 100


class Printed:
    """Prints the diagnostics of a scene that were not printed before."""

    def __init__(
        self, scene: CompiledScene, *, silent: bool, json: bool, log: LogSettings | None
    ) -> None:
        """Nothing is printed yet.

        Args:
            scene: Whose diagnostics they are.
            silent: Print errors only.
            json: Print nothing: the document has them.
            log: How many warnings are printed at most.
        """
        self._scene = scene
        self._silent = silent
        self._json = json
        self._left = _MAX_WARNINGS if log is None else max(log.max_warnings, 0)
        self._n_seen = 0

    def report(self) -> None:
        """Prints what is new."""
        items = self._scene.diagnostics[self._n_seen :]
        self._n_seen += len(items)
        if self._json:
            return
        n_hidden = 0
        shown = []
        for item in items:
            if item.severity == "error":
                shown.append(item)
            elif self._silent:
                continue
            elif item.severity == "warning" and self._left == 0:
                n_hidden += 1
            else:
                self._left -= item.severity == "warning"
                shown.append(item)
        _output.print_diagnostics(shown)
        if n_hidden:
            warnings = _output.plural(n_hidden, "more warning")
            _output.say(f"{warnings}: options.log_max_warnings says how many are printed")


@contextmanager
def copied_to(path: str) -> Iterator[None]:
    """A file gets a copy of what is said and printed meanwhile.

    Args:
        path: The file; empty: none. If it cannot be written that is said, and no more.
    """
    if not path:
        yield
        return
    try:
        with open(path, "w", encoding="utf-8", errors="replace") as file, _output.copied_to(file):
            yield
    except OSError as error:
        if error.filename != path:
            raise
        _output.say(f'warning: options.log_file: cannot write "{path}": {error.strerror}')
        yield
