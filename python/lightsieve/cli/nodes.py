"""`lightsieve nodes`."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Annotated, Any

import typer

from lightsieve.cli import _output
from lightsieve.errors import LightsieveError, without_place

if TYPE_CHECKING:
    from lightsieve.scene import Node, Param

EXAMPLE = "lightsieve nodes standard_surface"
JSON = {
    "nodes": "without NAME: one object a node: `name`, `kind`, `doc`",
    "name": "with NAME: the node's name",
    "kind": "with NAME: `shader`, `light`, `light filter`, `shape`, `camera`, `filter`, `driver`, "
    "`operator`, `color manager` or `options`",
    "doc": "with NAME: one line",
    "output": "with NAME: what a shader gives to a parameter that links to it",
    "params": "with NAME: one object a parameter: `name`, `type`, `array`, `default`, `doc`, "
    "`unit`, `low`, `high`, `hard_range`, `enumerators`, `status` (`supported`, `ignored` or "
    "`pending`)",
    "lobes": "with NAME: one object a lobe: `event`, `label`, `doc`",
}


def _unknown(name: str, known: list[str]) -> LightsieveError:
    message = f'there is no node "{name}"'
    near = get_close_matches(name, known, n=1)
    hint = f'did you mean "{near[0]}"?' if near else "`lightsieve nodes` lists all of them"
    return LightsieveError([without_place("unknown-node", message, hint)])


def format_value(value: Any) -> str:
    """A default as a scene file writes it."""
    if value is None or value == []:
        return ""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, tuple | list):
        return " ".join(format_value(part) for part in value)
    return f'"{value}"' if isinstance(value, str) else str(value)


def parameter_notes(param: Param) -> str:
    """What there is to say of a parameter, in one line."""
    parts = [param.doc]
    if param.enumerators:
        parts.append(f"One of: {', '.join(param.enumerators)}.")
    if param.unit:
        parts.append(f"[{param.unit}]")
    if param.low is not None and param.high is not None:
        parts.append(f"{param.low:.6g} to {param.high:.6g}.")
    if param.status == "ignored":
        parts.append("(no effect here)")
    elif param.status == "pending":
        parts.append("(not supported yet)")
    return " ".join(parts)


def default_text(param: Param) -> str:
    """A parameter's default as a scene file writes it."""
    return str(param.default) if param.type == "ENUM" else format_value(param.default)


def _print_node(node: Node) -> None:
    typer.echo(
        f"{node.name} ({node.kind}{', gives ' + node.output if node.output else ''}): {node.doc}"
    )
    if node.params:
        typer.echo("\nparameters")
        _output.print_table(
            (
                (
                    f"  {param.name}",
                    param.type + ("[]" if param.array else ""),
                    default_text(param),
                    parameter_notes(param),
                )
                for param in node.params
            ),
            ["bold", "cyan", "green"],
        )
    if node.lobes:
        typer.echo("\nlobes")
        _output.print_table(((f"  {lobe.event}", lobe.doc) for lobe in node.lobes), ["bold"])


def command(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="Only this node, in full.")
    ] = None,
    json: _output.Json = False,
) -> None:
    """List the nodes, or show one in full.

    In full: parameters with types and defaults, lobes with the light path events that they make.
    """
    from lightsieve.scene import nodes

    known = nodes()
    if name is None:
        if json:
            _output.print_json(
                {"nodes": [{"name": n.name, "kind": n.kind, "doc": n.doc} for n in known.values()]}
            )
        else:
            _output.print_table(
                ((n.name, n.kind, n.doc) for n in known.values()), ["bold", "cyan"]
            )
        return
    if name not in known:
        raise _unknown(name, list(known))
    if json:
        _output.print_json(known[name].to_dict())
    else:
        _print_node(known[name])
