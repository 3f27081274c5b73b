"""The automaton of a set of AOVs as flat arrays, for GPUs and renderers in any language.

The layout is described in docs/embedding.md; C and C++ programs that compile expressions
themselves get the same arrays from the engine.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from lightsieve.errors import LightsieveError, without_place

FORMATS = (".h", ".npy", ".npz")
"""What files of tables can be, by the end of their names."""
NO_ATOM = 0xFFFFFFFF
"""The path ends in no AOV."""
FIRST_CLASS = 1
"""Column of the first class of scattering events; column 0 has flags."""

Array = npt.NDArray[np.uint32]
_NUMBERS_A_LINE = 12


class Tables(NamedTuple):
    """The arrays. A path starts in a state of `starts` and carries it.

    Example:
        >>> from lightsieve import lpe
        >>> t = lpe.tables("C<RD>L", context=lpe.Context(events=["RD", "L'key'"]))
        >>> column = dict(zip(t.events, t.event_columns, strict=True))
        >>> flat = t.table.ravel()
        >>> state = flat[t.starts[0] + column["RD"]]
        >>> t.aovs_of(int(flat[state + column["L'key'"]]))
        ['C<RD>L']
    """

    table: Array
    """(n_states, stride): flags, the next states, the atoms. A state is the offset of its row."""
    first_terminal: int
    """Column of the first atom; the columns of next states begin at `FIRST_CLASS`."""
    starts: Array
    """The state in which a path starts, for each automaton; a path carries a state of each."""
    events: list[str]
    """The events, as paths write them."""
    event_columns: Array
    """The column of each event."""
    aovs: list[str]
    """The expressions' names, or the expressions where they have none."""
    atom_begin: Array
    """The AOVs of atom i are atom_aovs[atom_begin[i]:atom_begin[i + 1]]."""
    atom_aovs: Array
    """Indices into `aovs`."""

    def aovs_of(self, atom: int) -> list[str]:
        """The AOVs that take the paths of an atom.

        Args:
            atom: A number of the table, or NO_ATOM.

        Returns:
            Their names.
        """
        if atom == NO_ATOM:
            return []
        begin, end = self.atom_begin[atom : atom + 2]
        return [self.aovs[i] for i in self.atom_aovs[begin:end]]

    def header(self, name: str = "lpe") -> str:
        """The arrays as a header for C, C++ and shading languages that resemble them.

        Args:
            name: What the names of all arrays begin with.

        Returns:
            The text of the file.
        """
        n_states, stride = self.table.shape
        counts = {
            "n_states": n_states,
            "stride": stride,
            "first_class": FIRST_CLASS,
            "first_terminal": self.first_terminal,
            "n_automata": len(self.starts),
            "n_events": len(self.events),
            "n_atoms": len(self.atom_begin) - 1,
            "n_aovs": len(self.aovs),
        }
        parts = [
            "// Tables of light path expressions, written by `lightsieve lpe export`.",
            "// Next state: table[state + column]. Atom: table[state + column of a terminal].",
            "// What can still be reached: table[state] & 1 (light), & 2 (probes).",
            "#pragma once",
            "#include <stdint.h>",
            "",
            "enum {",
            *(f"    {name}_{key} = {value}," for key, value in counts.items()),
            "};",
            _number_array(f"{name}_table", self.table.ravel().tolist()),
            _number_array(f"{name}_starts", self.starts.tolist()),
            _text_array(f"{name}_events", self.events),
            _number_array(f"{name}_event_columns", self.event_columns.tolist()),
            _text_array(f"{name}_aovs", self.aovs),
            _number_array(f"{name}_atom_begin", self.atom_begin.tolist()),
            _number_array(f"{name}_atom_aovs", self.atom_aovs.tolist()),
        ]
        return "\n".join(parts) + "\n"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the arrays to a file.

        Args:
            path: A `.h` (the names of its arrays begin with the file's), a `.npz` (every array by
                its name), or a `.npy` (`table` alone).

        Raises:
            LightsieveError: The file cannot be written.
            ValueError: The name ends otherwise.
        """
        file = Path(path)
        if file.suffix not in FORMATS:
            raise ValueError(f"{file.name}: tables are written as {', '.join(FORMATS)}")
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            if file.suffix == ".h":
                file.write_text(self.header(_identifier(file.stem)), encoding="utf-8")
            elif file.suffix == ".npy":
                np.save(file, self.table)
            else:
                arrays: dict[str, Any] = self._asdict()
                np.savez(file, **arrays)
        except OSError as error:
            message = f'cannot write "{file}": {error.strerror or error}'
            raise LightsieveError([without_place("file-unwritable", message, "")]) from None


def _identifier(text: str) -> str:
    """The text as the beginning of a name in C."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", text)
    return f"_{name}" if name[:1].isdigit() else name


def _number_array(name: str, numbers: Sequence[int]) -> str:
    # C has no empty arrays; the counts say how many there are.
    texts = [f"{number:#x}" if number > 0xFFFF else str(number) for number in numbers] or ["0"]
    lines = (
        ", ".join(texts[at : at + _NUMBERS_A_LINE]) for at in range(0, len(texts), _NUMBERS_A_LINE)
    )
    return _array(f"static const uint32_t {name}", lines)


def _text_array(name: str, texts: Sequence[str]) -> str:
    return _array(f"static const char* const {name}", [_literal(t) for t in texts] or ["0"])


def _array(head: str, lines: Iterable[str]) -> str:
    body = "".join(f"    {line},\n" for line in lines)
    return f"{head}[] = {{\n{body}}};"


def _literal(text: str) -> str:
    """A string of C."""
    # Other bytes become three octal digits: a digit after them cannot be taken for a fourth.
    plain = (
        chr(byte) if 32 <= byte < 127 and byte not in b'"\\?' else f"\\{byte:03o}"
        for byte in text.encode()
    )
    return '"' + "".join(plain) + '"'
