"""The nodes that a scene may contain, as the renderer describes them."""

from __future__ import annotations

from typing import Any, NamedTuple

from lightsieve import _core


class Param(NamedTuple):
    """A parameter of a node."""

    name: str
    """As in a scene file."""
    type: str
    """As a scene file writes it: `FLOAT`, `RGB`, `STRING`, ..."""
    array: bool
    """Takes an array of such values."""
    default: Any
    """A number, text, boolean, tuple of numbers, list for arrays, or None for no node."""
    doc: str
    """One line."""
    unit: str
    """E.g. `deg`; empty if it has none."""
    low: float | None
    """Lowest sensible value."""
    high: float | None
    """Highest sensible value."""
    hard_range: bool
    """Values outside make no sense and are clamped with a warning."""
    enumerators: list[str]
    """The words that an ENUM takes."""
    status: str
    """`supported`, `ignored` (steers only Arnold's own sampling) or `pending` (not yet)."""


class Lobe(NamedTuple):
    """A lobe that a shader can produce."""

    event: str
    """The light path event that it makes, e.g. `RS'coat'`."""
    label: str
    """Its label; empty if it has none."""
    doc: str
    """One line."""


class Node(NamedTuple):
    """A node type."""

    name: str
    """As in a scene file."""
    kind: str
    """`shader`, `light`, `shape`, `camera`, `filter`, `driver` or `options`."""
    doc: str
    """One line."""
    output: str
    """What a shader gives to a parameter: `FLOAT`, `RGB`, `CLOSURE`, ...; else empty."""
    params: list[Param]
    """In the order of the documentation."""
    lobes: list[Lobe]
    """Of a shader with closures."""

    def to_dict(self) -> dict[str, Any]:
        """The node as `lightsieve nodes --json` prints it."""
        return {
            **self._asdict(),
            "params": [param._asdict() for param in self.params],
            "lobes": [lobe._asdict() for lobe in self.lobes],
        }


def nodes() -> dict[str, Node]:
    """The node types, by name.

    Returns:
        Every node that the renderer knows, with its parameters, defaults and lobes.

    Example:
        >>> nodes()["lambert"].lobes[0].event
        'RD'
    """
    return {
        row["name"]: Node(
            **{
                **row,
                "params": [Param(**param) for param in row["params"]],
                "lobes": [Lobe(**lobe) for lobe in row["lobes"]],
            }
        )
        for row in _core.nodes()
    }
