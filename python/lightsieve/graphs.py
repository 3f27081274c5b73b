"""Pictures of automata, drawn by the program `dot` of Graphviz."""

from __future__ import annotations

import os
from pathlib import Path

from lightsieve.errors import LightsieveError, without_place

FORMATS = {".dot": "dot", ".gv": "dot", ".png": "png", ".svg": "svg"}
"""The kind of picture that a file's name asks for."""
_TIMEOUT_S = 60


class Graph:
    """A picture of an automaton.

    Example:
        >>> Graph("digraph { a -> b }").dot
        'digraph { a -> b }'
    """

    def __init__(self, dot: str) -> None:
        self.dot = dot
        """The picture as Graphviz text."""

    def render(self, kind: str) -> bytes:
        """The picture as `dot` draws it.

        Args:
            kind: A format of Graphviz: `svg`, `png`, ...

        Returns:
            The file's bytes.

        Raises:
            LightsieveError: The program `dot` is not installed, or it fails.

        Example:
            >>> b"<svg" in Graph("digraph { a -> b }").render("svg")
            True
        """
        import subprocess

        resolution = ["-Gdpi=144"] if kind == "png" else []
        try:
            done = subprocess.run(
                ["dot", f"-T{kind}", *resolution],
                input=self.dot.encode(),
                capture_output=True,
                timeout=_TIMEOUT_S,
                check=True,
            )
        except FileNotFoundError:
            raise _failure(
                'the program "dot" is not installed',
                "it is in the package graphviz; a .dot file can be written without it",
            ) from None
        except subprocess.TimeoutExpired:
            raise _failure(
                f'"dot" takes more than {_TIMEOUT_S} s', "write a .dot file instead"
            ) from None
        except subprocess.CalledProcessError as error:
            said = error.stderr.decode(errors="replace").strip()
            raise _failure(f'"dot" fails: {said}', "write a .dot file instead") from None
        return done.stdout

    def svg(self) -> str:
        """The picture as SVG.

        Returns:
            The text of the file.

        Raises:
            LightsieveError: As `render`.

        Example:
            >>> Graph("digraph { a -> b }").svg().rstrip().endswith("</svg>")
            True
        """
        return self.render("svg").decode()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture.

        Args:
            path: A file `.svg`, `.png` or `.dot` (Graphviz text).

        Raises:
            LightsieveError: As `render`, or the file cannot be written.
            ValueError: The name ends otherwise.

        Example:
            >>> Graph("digraph { a -> b }").save("graph.svg")
        """
        file = Path(path)
        if file.suffix not in FORMATS:
            raise ValueError(f"{file.name}: a graph is written as {', '.join(FORMATS)}")
        kind = FORMATS[file.suffix]
        data = self.dot.encode() if kind == "dot" else self.render(kind)
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
        except OSError as error:
            message = f'cannot write "{file}": {error.strerror or error}'
            raise LightsieveError([without_place("file-unwritable", message, "")]) from None

    def _repr_svg_(self) -> str:
        """For notebooks."""
        return self.svg()


def _failure(message: str, hint: str) -> LightsieveError:
    return LightsieveError([without_place("file-not-found", message, hint)])
