"""`lightsieve lpe partition`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from lightsieve.cli import _lpe_options, _output

if TYPE_CHECKING:
    from lightsieve import lpe

EXAMPLE = "lightsieve lpe partition --of diffuse diffuse_direct diffuse_indirect"
JSON = {
    "of": "the whole: `name` (empty if none was given), `expression`",
    "parts": "the parts, each as `of`",
    "holds": "true if they take each path of the whole exactly once, and nothing else",
    "fault": "`none`, `lost` (no part takes the witness), `twice`, or `outside` (of the whole)",
    "witness": "null, or a shortest path that shows the fault: `text`, `words`",
    "between": "for `twice`: the numbers of the two parts, counted from 0; else empty",
    "missing": "what the parts leave over, as an expression; null if nothing, or too large",
}


def command(
    parts: Annotated[
        list[str],
        typer.Argument(metavar="EXPR...", help="Expressions or names of AOVs."),
    ],
    of: _lpe_options.Of = "C.*",
    scene: _lpe_options.Scene = None,
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Prove that expressions add up to a whole.

    That they take each of its paths exactly once, and nothing else: over all paths, not over
    samples. Or print the shortest path that is lost, counted twice, or outside. Exit code 1 if
    they do not add up.
    """
    context = _lpe_options.context(scene, lpe_table, lpe_standard, definitions)
    from lightsieve import lpe
    from lightsieve.errors import LightsieveError

    whole = lpe.parse(of, context)
    members = [lpe.parse(part, context) for part in parts]
    result = lpe.partition(*members, of=whole, context=context)
    try:
        missing = None if result else lpe.rest(*members, of=whole, context=context)
    except LightsieveError:
        missing = None
    names = [_lpe_options.label(member) for member in members]
    if json:
        _output.print_json(
            {
                "of": {"name": whole.name, "expression": whole.text},
                "parts": [{"name": m.name, "expression": m.text} for m in members],
                "holds": bool(result),
                "fault": result.fault,
                "witness": _lpe_options.path_document(result.witness),
                "between": list(result.parts),
                "missing": None if missing is None else missing.text,
            }
        )
    else:
        for member in (whole, *members):
            _output.print_diagnostics(member.lints)
        _print(_lpe_options.label(whole), names, result, missing)
    if not result:
        raise typer.Exit(1)


def _print(
    whole: str, names: list[str], result: lpe.Partition, missing: lpe.Expression | None
) -> None:
    parts, one = _output.listed(names), len(names) == 1
    if result.witness is None:
        verb = "takes" if one else "take"
        _output.print_text(f"yes: {parts} {verb} each path of {whole} exactly once")
        return
    _output.print_text(f"no: {parts} {'does' if one else 'do'} not add up to {whole}")
    about = {
        "lost": "nothing takes it",
        "twice": "both " + _output.listed([names[i] for i in result.parts]) + " take it",
        "outside": f"it is no path of {whole}",
    }[result.fault]
    _lpe_options.print_path(result.fault, result.witness, about)
    if missing is not None:
        _output.print_item("missing", missing.text)
