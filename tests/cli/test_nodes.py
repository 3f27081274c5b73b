"""`lightsieve nodes`."""

from __future__ import annotations

from lightsieve.cli import nodes as nodes_command
from lightsieve.scene import nodes
from tests.conftest import ROOT, Run


def test_every_file_of_a_node_is_a_node(run: Run) -> None:
    folders = [p.name for p in (ROOT / "src/nodes").iterdir() if p.is_dir() and p.name != "common"]
    files = {
        p.stem
        for folder in folders
        for p in (ROOT / "src/nodes" / folder).glob("*.cpp")
        if not p.stem.endswith("_test")
    }
    lines = run("nodes").out.splitlines()
    assert {line.split()[0] for line in lines} == files


def test_a_node_in_full(run: Run) -> None:
    done = run("nodes", "standard_surface")
    assert done.code == 0
    assert done.out.startswith("standard_surface (shader, gives CLOSURE): ")
    rows = {line.split()[0]: line for line in done.out.splitlines() if line.startswith("  ")}
    assert rows["base"].split()[1:3] == ["FLOAT", "1"]
    assert rows["base_color"].split()[1:5] == ["RGB", "0.8", "0.8", "0.8"]
    assert "RS'coat'" in rows
    assert "RS'sheen'" in rows


def test_a_node_as_json(run: Run) -> None:
    document = run("nodes", "lambert", "--json").json
    assert ["nodes", *document] == list(nodes_command.JSON)
    assert document["name"] == "lambert"
    assert document["lobes"][0]["event"] == "RD"
    params = {param["name"]: param for param in document["params"]}
    assert params["Kd_color"] == {
        "name": "Kd_color",
        "type": "RGB",
        "array": False,
        "default": [1, 1, 1],
        "doc": params["Kd_color"]["doc"],
        "unit": "",
        "low": 0,
        "high": 1,
        "hard_range": params["Kd_color"]["hard_range"],
        "enumerators": [],
        "status": "supported",
    }


def test_an_unknown_node_gets_a_suggestion(run: Run) -> None:
    done = run("nodes", "lambrt")
    assert done.code == 1
    assert done.out == ""
    assert (
        done.err
        == 'error[unknown-node]: there is no node "lambrt"\n  hint: did you mean "lambert"?\n'
    )


def test_everything_is_documented() -> None:
    undocumented = [name for name, node in nodes().items() if not node.doc.endswith(".")]
    for name, node in nodes().items():
        undocumented += [f"{name}.{param.name}" for param in node.params if not param.doc]
        undocumented += [f"{name} {lobe.event}" for lobe in node.lobes if not lobe.doc]
    assert undocumented == []


def test_defaults_have_the_type_that_is_named() -> None:
    sizes = {"RGB": 3, "RGBA": 4, "VECTOR": 3, "VECTOR2": 2, "MATRIX": 4}
    for name, node in nodes().items():
        for param in node.params:
            where = f"{name}.{param.name}"
            if param.array:
                assert isinstance(param.default, list), where
            elif param.type in sizes:
                assert len(param.default) == sizes[param.type], where
            elif param.type == "ENUM":
                assert param.default in param.enumerators, where
