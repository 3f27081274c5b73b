"""`lightsieve lpe compare`."""

from __future__ import annotations

from typing import Annotated

import typer

from lightsieve.cli import _lpe_options, _output

EXAMPLE = "lightsieve lpe compare sheen specular"
JSON = {
    "a": "the first: `name` (empty if none was given), `expression`",
    "b": "the second, as `a`",
    "relation": "of the first to the second: `equal`, `subset`, `superset`, `overlapping` or "
    "`disjoint`",
    "only_a": "null, or a shortest path that only the first takes: `text`, `words`",
    "only_b": "null, or one that only the second takes",
    "both": "null, or one that both take",
}
_SENTENCES = {
    "equal": "{a} and {b} take the same paths",
    "subset": "{a} takes a part of what {b} takes",
    "superset": "{b} takes a part of what {a} takes",
    "overlapping": "{a} and {b} overlap",
    "disjoint": "{a} and {b} have no path in common",
}


def command(
    a: Annotated[str, typer.Argument(metavar="A", help=_lpe_options.EXPRESSION_HELP)],
    b: Annotated[str, typer.Argument(metavar="B", help="Another.")],
    scene: _lpe_options.Scene = None,
    definitions: _lpe_options.Definitions = None,
    lpe_standard: _lpe_options.LpeStandard = False,
    lpe_table: _lpe_options.LpeTable = None,
    json: _output.Json = False,
) -> None:
    """Say whether two expressions are equal, contained, overlapping or disjoint.

    With shortest paths that show it. Exit code 0 whatever the answer is.
    """
    context = _lpe_options.context(scene, lpe_table, lpe_standard, definitions)
    from lightsieve import lpe

    first, second = lpe.parse(a, context), lpe.parse(b, context)
    result = lpe.compare(first, second, context)
    if json:
        _output.print_json(
            {
                "a": {"name": first.name, "expression": first.text},
                "b": {"name": second.name, "expression": second.text},
                "relation": result.relation,
                "only_a": _lpe_options.path_document(result.only_a),
                "only_b": _lpe_options.path_document(result.only_b),
                "both": _lpe_options.path_document(result.both),
            }
        )
        return
    for expression in (first, second):
        _output.print_diagnostics(expression.lints)
    names = {"a": _lpe_options.label(first), "b": _lpe_options.label(second)}
    sentence = _SENTENCES[result.relation].format(**names)
    _output.print_text(f"{result.relation}: {sentence}")
    for mark, path in [
        (f"only {names['a']}", result.only_a),
        (f"only {names['b']}", result.only_b),
        ("both", result.both),
    ]:
        if path is not None:
            _lpe_options.print_path(mark, path)
