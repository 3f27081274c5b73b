"""Other renderers' light path expressions: translation between their dialects.

    >>> from lightsieve import lpe
    >>> lpe.translate("C<RS[^'coat']>L", target="karma").text
    "C<RG.[^'coat']>L"

Paths here are *common paths*: finer than what any one renderer tells apart. `RD RG RS` and
`TD TG TS` are diffuse, glossy (rough) and mirror lobes, `Ts` is straight through a surface by
opacity; `'coat'` is a lobe's label or a light's group, `@'hero'` an object's label.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Literal, NamedTuple

from lightsieve import _lpe
from lightsieve.errors import Diagnostic

if TYPE_CHECKING:
    from lightsieve.lpe import Expression, Path

__all__ = [
    "Dialect",
    "DialectName",
    "DialectReading",
    "SceneProperty",
    "Translation",
    "dialects",
    "read_as",
    "scene_properties",
    "translate",
]

DialectName = Literal["arnold", "osl", "osl-placeholder", "moonray", "renderman", "karma"]
"""A renderer's dialect; `dialects` says what is known of each."""

SceneProperty = Literal["straight", "volumes", "background", "glossy", "mirrors", "object-labels"]
"""What a scene may be without; `scene_properties` says what each means."""


class Dialect(NamedTuple):
    """What the translator knows about a renderer's dialect."""

    name: str
    title: str
    verified: list[str]
    """What its documents or its source say, or what was measured."""
    unverified: list[str]
    """What is only inferred. A translation that relies on it says so."""
    prefixes: list[str]
    """What may stand before an expression, e.g. `unoccluded`."""


class Translation(NamedTuple):
    """An expression in another renderer's dialect. True if it is exact."""

    text: str
    """The expression; the nearest that takes all it can if it is not exact; empty if no
    expression takes any of the paths."""
    exact: bool
    """Does it take the same set of common paths? Proved."""
    lost: Path | None
    """A shortest path that is no longer taken."""
    added: Path | None
    """A shortest path that is taken now and was not."""
    lost_prefixes: list[str]
    """Prefixes that the other dialect does not have."""
    exact_without: list[str]
    """It is exact for scenes without all of these; empty if not even then."""
    notes: list[str]
    unverified: list[str]
    """What it relies on that is only inferred, not documented."""
    lints: tuple[Diagnostic, ...]
    """What the source's renderer reads otherwise than it looks."""

    def __bool__(self) -> bool:
        return self.exact


class DialectReading(NamedTuple):
    """What a renderer really does with a text. True if that is what it looks like."""

    text: str
    """What it is read as, spelled so that nobody can misread it; empty if it takes nothing."""
    meant: str
    """What was most likely meant, in the same dialect; empty if that cannot be written."""
    differs: bool
    missed: Path | None
    """A shortest path that is meant and not taken."""
    extra: Path | None
    """A shortest path that is taken and not meant."""
    notes: list[str]
    lints: tuple[Diagnostic, ...]

    def __bool__(self) -> bool:
        return not self.differs


def _path(witness: tuple[str, str] | None) -> Path | None:
    from lightsieve.lpe import Path

    return None if witness is None else Path(*witness)


def translate(
    expression: str | Expression,
    *,
    source: DialectName = "arnold",
    target: DialectName = "arnold",
    without: Iterable[SceneProperty] = (),
) -> Translation:
    """Translates an expression from one renderer's dialect to another's.

    The result takes the same set of paths, proved on a common alphabet of events, or it says what
    is lost or added, with a shortest path that shows it.

    Args:
        expression: In the dialect `source`; for `arnold` also an AOV's name.
        source: The dialect that it is written in, read as that renderer reads it.
        target: The dialect to write it in.
        without: What the scene does not have; the proof is then about such scenes only.

    Returns:
        The translation.

    Raises:
        LightsieveError: The expression cannot be read, or needs more work than is allowed.

    Example:
        >>> translate("specular", target="osl").added.text
        "C RG'coat' L"
        >>> translate("CSL", source="osl").exact_without
        ['straight', 'glossy']
        >>> translate("CSL", source="osl", without=["straight", "glossy"]).exact
        True
    """
    result = _lpe.translate_dialect(_text(expression, source), source, target, list(without))
    return Translation(
        result.text,
        result.exact,
        _path(result.lost),
        _path(result.added),
        result.lost_prefixes,
        result.exact_without,
        result.notes,
        result.unverified,
        result.lints,
    )


def read_as(expression: str | Expression, dialect: DialectName = "osl") -> DialectReading:
    """What a renderer really does with a text, beside what was most likely meant.

    Args:
        expression: The text.
        dialect: Whose reading.

    Returns:
        Both readings, with shortest paths that show how they differ.

    Raises:
        LightsieveError: The renderer refuses the text.

    Example:
        >>> read_as("(CDL)|(CSL)").text
        'CDL'
    """
    result = _lpe.read_dialect(_text(expression, dialect), dialect)
    return DialectReading(
        result.text,
        result.meant,
        result.differs,
        _path(result.missed),
        _path(result.extra),
        result.notes,
        result.lints,
    )


def _text(expression: str | Expression, dialect: str) -> str:
    if isinstance(expression, str):
        if dialect != "arnold":
            return expression
        from lightsieve.lpe import parse

        return parse(expression).text
    return expression.text


def dialects() -> list[Dialect]:
    """Every dialect, Arnold's first.

    Returns:
        What is known about each.

    Example:
        >>> [dialect.name for dialect in dialects()][:2]
        ['arnold', 'osl']
    """
    return [
        Dialect(
            name,
            title,
            [text for text, verified in facts if verified],
            [text for text, verified in facts if not verified],
            prefixes,
        )
        for name, title, facts, prefixes in _lpe.dialects()
    ]


def scene_properties() -> dict[str, str]:
    """What a scene may be without.

    Returns:
        The meaning by name.

    Example:
        >>> scene_properties()["volumes"]
        'the scene has no volumes'
    """
    return dict(_lpe.scene_properties())
