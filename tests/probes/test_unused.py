"""Parameters without effect: a warning, or a reason why none is needed and not a bit changed."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

import lightsieve
from lightsieve.scene import Node, Param
from tests.probes.probing import (
    FOLDER,
    Probe,
    Renderer,
    all_nodes,
    params_with,
    probes,
    scene_text,
)

REASONS = tomllib.loads((FOLDER / "unused.toml").read_text())
PENDING, IGNORED = params_with("pending"), params_with("ignored")


def names(rows: list[tuple[Node, Param]]) -> list[str]:
    return [f"{node.name}.{param.name}" for node, param in rows]


def another_value(param: Param) -> str:
    """A value that is not the default, as a scene file writes it."""
    default = (
        param.default[0] if isinstance(param.default, list) and param.default else param.default
    )
    if param.type == "ENUM":
        word = next((word for word in param.enumerators if word != default), str(default))
        return f'"{word}"'
    if param.type == "BOOL":
        return "off" if default else "on"
    if param.type == "STRING":
        return '"another"'
    if param.type in ("NODE", "CLOSURE"):
        return "another"
    if param.type in ("INT", "UINT", "BYTE", "FLOAT"):
        number = float(default or 0)
        high = param.high if param.high is not None else number + 1
        other = number + 1 if number + 1 <= high else (param.low or 0)
        return str(other if param.type == "FLOAT" else int(other))
    size = {"RGB": 3, "VECTOR": 3, "VECTOR2": 2, "RGBA": 4, "MATRIX": 16}[param.type]
    return " ".join(["0.25"] * size)


def scene_of(node: Node, param: Param) -> Probe:
    """A scene in which the node is at work: that of its first probe."""
    first = next(probe for probe in probes(node) if "fails" not in " ".join(probe.expect))
    given = {name: value for name, value in first.given.items() if name != param.name}
    if first.before is not None:
        given[first.param] = first.before
    return replace(
        first,
        param=param.name,
        before=None,
        after=another_value(param),
        given=given,
        nodes=first.nodes + "\nflat { name another }",
    )


@pytest.mark.parametrize("node", {n.name: n for n, _ in PENDING}.values(), ids=lambda n: n.name)
def test_what_is_not_supported_warns(node: Node, tmp_path: Path) -> None:
    silent = []
    for param in (param for owner, param in PENDING if owner.name == node.name):
        probe = scene_of(node, param)
        path = tmp_path / "probe.ass"
        path.write_text(scene_text(probe, probe.after))
        codes = {item.code for item in lightsieve.check(path).diagnostics}
        if "param-pending" not in codes:
            silent.append(f"{param.name} = {probe.after}: {sorted(codes)}")
    assert not silent


@pytest.mark.parametrize("node", {n.name: n for n, _ in IGNORED}.values(), ids=lambda n: n.name)
def test_what_is_ignored_changes_nothing(node: Node, tmp_path: Path) -> None:
    renderer, changed = Renderer(tmp_path), []
    for param in (param for owner, param in IGNORED if owner.name == node.name):
        probe = scene_of(node, param)
        one, other = (
            renderer.frame(scene_text(probe, value), probe.sets) for value in (None, probe.after)
        )
        if one.layer(probe.layer).tobytes() != other.layer(probe.layer).tobytes():
            changed.append(f"{param.name} = {probe.after}")
    assert not changed, "they act: describe them without .ignored() and give them probes"


def test_what_is_ignored_has_a_reason() -> None:
    reasons = {
        name: [
            reason
            for reason, group in REASONS.items()
            if any(fnmatchcase(name, pattern) for pattern in group["params"])
        ]
        for name in names(IGNORED)
    }
    assert not {name: found for name, found in reasons.items() if len(found) != 1}


def test_reasons_are_of_parameters_that_exist() -> None:
    known = names(IGNORED)
    idle = [
        pattern
        for group in REASONS.values()
        for pattern in group["params"]
        if not any(fnmatchcase(name, pattern) for name in known)
    ]
    assert not idle


def test_probes_are_of_parameters_that_act() -> None:
    """A table's row for what is not supported, or is gone, would never fail."""
    stray = [
        f"{probe.node}.{probe.param}"
        for node in all_nodes().values()
        for probe in probes(node)
        if probe.param not in {param.name for param in node.params if param.status == "supported"}
    ]
    assert not stray
