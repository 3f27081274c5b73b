"""`lightsieve lpe translate`."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from lightsieve.cli import _lpe_options, _output

if TYPE_CHECKING:
    from lightsieve.dialects import DialectReading, Translation

EXAMPLE = """lightsieve lpe translate --to osl "C<RS[^'coat']>.*" """.strip()
JSON = {
    "source": "the dialect that it is written in",
    "target": "the dialect to write it in; null with `--explain`",
    "expression": "the expression, also where a name was given",
    "text": "the translation, or with `--explain` what the renderer reads; empty if it takes "
    "nothing",
    "exact": "is it the same set of paths, proved; with `--explain`: is it what was meant",
    "lost": "null, or a shortest path that is no longer taken: `text`, `words`; with `--explain` "
    "one that is meant and not taken",
    "added": "null, or a shortest path that is taken now and was not; with `--explain` one that "
    "is taken and not meant",
    "lost_prefixes": "prefixes that the other dialect does not have",
    "exact_without": "it is exact for scenes without all of these",
    "meant": "with `--explain` what was most likely meant; else null",
    "notes": "what else is worth knowing",
    "unverified": "what it relies on that is only inferred, not documented",
    "lints": "diagnostics: what the renderer reads otherwise than it looks",
    "dialects": "with `--list`, and then the only key: `name`, `title`, `verified`, `unverified`, "
    "`prefixes` of each",
}
Name = Literal["arnold", "osl", "osl-placeholder", "moonray", "renderman", "karma"]


class Property(StrEnum):
    """What a scene may be without; an enumeration, since typer takes no list of literals."""

    straight = "straight"
    volumes = "volumes"
    background = "background"
    glossy = "glossy"
    mirrors = "mirrors"
    object_labels = "object-labels"


def command(
    expression: Annotated[
        str | None,
        typer.Argument(metavar="EXPR", help="An expression; from arnold also an AOV's name."),
    ] = None,
    source: Annotated[
        Name, typer.Option("--from", help="The dialect that it is written in.")
    ] = "arnold",
    target: Annotated[
        Name | None, typer.Option("--to", help="The dialect to write it in.")
    ] = None,
    without: Annotated[
        list[Property] | None,
        typer.Option(help="Something that the scene does not have; may be repeated."),
    ] = None,
    explain: Annotated[
        bool,
        typer.Option("--explain", help="Say what the renderer really does with the expression."),
    ] = False,
    list_all: Annotated[
        bool, typer.Option("--list", help="Say what is known about each dialect.")
    ] = False,
    json: _output.Json = False,
) -> None:
    """Write an expression in another renderer's dialect.

    The same set of paths, proved; or the nearest expression, with a shortest path that shows the
    difference, and exit code 1. With --explain exit code 1 if the renderer does something else
    than was meant.
    """
    if list_all:
        _list(json)
        return
    if expression is None:
        raise typer.BadParameter("an expression is missing", param_hint="EXPR")
    if target is None and not explain:
        raise typer.BadParameter("a dialect is missing", param_hint="--to")
    from lightsieve import lpe

    text = lpe.parse(expression).text if source == "arnold" else expression
    if explain:
        reading = lpe.read_as(text, source)
        exact = not reading.differs
        _report_reading(reading, text, source, json)
    else:
        translation = lpe.translate(
            text,
            source=source,
            target=target or "arnold",
            without=[one.value for one in without or ()],
        )
        exact = translation.exact
        _report(translation, text, source, target or "arnold", json)
    if not exact:
        raise typer.Exit(1)


def _report(result: Translation, text: str, source: str, target: str, json: bool) -> None:
    if json:
        _output.print_json(
            {
                "source": source,
                "target": target,
                "expression": text,
                "text": result.text,
                "exact": result.exact,
                "lost": _lpe_options.path_document(result.lost),
                "added": _lpe_options.path_document(result.added),
                "lost_prefixes": result.lost_prefixes,
                "exact_without": result.exact_without,
                "meant": None,
                "notes": result.notes,
                "unverified": result.unverified,
                "lints": [lint.to_dict() for lint in result.lints],
            }
        )
        return
    _output.print_diagnostics(result.lints)
    if result.text:
        _output.print_title(result.text)
    if not result.exact:
        _output.print_text(
            "not exact: the nearest expression" if result.text else "nothing can be written"
        )
    if result.lost is not None:
        _lpe_options.print_path("lost", result.lost)
    if result.added is not None:
        _lpe_options.print_path("added", result.added)
    for prefix in result.lost_prefixes:
        _output.print_item("lost", f"{prefix};", f"{target} has no such prefix")
    if result.exact_without:
        from lightsieve import lpe

        meanings = lpe.scene_properties()
        _output.print_item(
            "exact",
            "--without " + " --without ".join(result.exact_without),
            "if " + _output.listed([meanings[name] for name in result.exact_without]),
        )
    _print_notes(result.notes, result.unverified)


def _report_reading(result: DialectReading, text: str, source: str, json: bool) -> None:
    if json:
        _output.print_json(
            {
                "source": source,
                "target": None,
                "expression": text,
                "text": result.text,
                "exact": not result.differs,
                "lost": _lpe_options.path_document(result.missed),
                "added": _lpe_options.path_document(result.extra),
                "lost_prefixes": [],
                "exact_without": [],
                "meant": result.meant,
                "notes": result.notes,
                "unverified": [],
                "lints": [lint.to_dict() for lint in result.lints],
            }
        )
        return
    _output.print_diagnostics(result.lints)
    _output.print_item("read as", result.text or "nothing")
    if not result.differs:
        _output.print_text("as it was meant")
    else:
        if result.meant:
            _output.print_item("meant  ", result.meant)
        if result.missed is not None:
            _lpe_options.print_path("missed ", result.missed)
        if result.extra is not None:
            _lpe_options.print_path("extra  ", result.extra)
    _print_notes(result.notes, [])


def _print_notes(notes: list[str], unverified: list[str]) -> None:
    for note in notes:
        _output.print_item("note", note)
    for fact in unverified:
        _output.print_item("unverified", fact)


def _list(json: bool) -> None:
    from lightsieve import lpe

    dialects = lpe.dialects()
    if json:
        _output.print_json({"dialects": [dialect._asdict() for dialect in dialects]})
        return
    for dialect in dialects:
        _output.print_title(f"{dialect.name}: {dialect.title}")
        for mark, facts in [("verified  ", dialect.verified), ("unverified", dialect.unverified)]:
            for fact in facts:
                _output.print_item(mark, fact)
        if dialect.prefixes:
            _output.print_item("prefixes  ", " ".join(f"{name};" for name in dialect.prefixes))
