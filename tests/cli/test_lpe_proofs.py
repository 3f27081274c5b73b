"""`lightsieve lpe explain`, `partition`, `rest`, `compare` and `graph`."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

from lightsieve.cli import lpe_compare, lpe_explain, lpe_graph, lpe_partition, lpe_rest
from tests.conftest import ROOT, Run

STILL = ROOT / "tests/scenes/still.ass"


def test_a_partition_is_proved(run: Run) -> None:
    done = run("lpe", "partition", "direct", "indirect", "emission", "background")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("yes: direct, indirect, emission, and background take each path")


@pytest.mark.parametrize(
    ("arguments", "fault", "path", "about"),
    [
        (["diffuse"], "lost", "C L", "nothing takes it"),
        (
            ["--of", "$specular", "specular", "sheen"],
            "twice",
            "C RS'sheen' L",
            "both specular and",
        ),
        (["--of", "diffuse", "C[DS].*"], "outside", "C RS L", "it is no path of diffuse"),
    ],
)
def test_what_is_no_partition_has_a_witness_in_words(
    run: Run, arguments: list[str], fault: str, path: str, about: str
) -> None:
    done = run("lpe", "partition", *arguments)
    assert done.code == 1
    assert f"\n  {fault}  {path}\n" in done.out
    assert " a path that leaves the camera" in done.out
    assert about in done.out


def test_partition_as_json(run: Run) -> None:
    done = run("lpe", "partition", "diffuse", "C[^D].*", "--json")
    assert done.code == 1
    assert list(done.json) == list(lpe_partition.JSON)
    assert done.json["fault"] == "lost"
    assert done.json["witness"]["text"] == "C TD L"
    assert done.json["missing"] == "C<TD>.*"
    assert done.json["parts"][0] == {"name": "diffuse", "expression": "C<RD>.*"}
    good = run("lpe", "partition", "C.*", "--json").json
    assert (good["holds"], good["witness"], good["missing"]) == (True, None, None)


def test_rest_is_one_line_that_can_be_used(run: Run) -> None:
    done = run("lpe", "rest", "diffuse", "specular")
    assert (done.code, done.out) == (0, "C[<RS'coat'>TVLOB].*\n")
    assert run("lpe", "partition", "diffuse", "specular", done.out.strip()).code == 0


def test_rest_of_nothing_prints_nothing(run: Run) -> None:
    done = run("lpe", "rest", "--of", "CB", "background")
    assert (done.code, done.out) == (0, "")
    assert done.err == "nothing is left over of CB\n"
    document = run("lpe", "rest", "--of", "CB", "background", "--json").json
    assert list(document) == list(lpe_rest.JSON)
    assert (document["rest"], document["example"]) == (None, None)


@pytest.mark.parametrize(
    ("a", "b", "relation"),
    [
        ("diffuse", "C<RD>.*", "equal"),
        ("sheen", "specular", "subset"),
        ("RGBA", "CB", "superset"),
        ("diffuse", "C.*<L.'key'>", "overlapping"),
        ("coat", "$specular", "disjoint"),
    ],
)
def test_compare(run: Run, a: str, b: str, relation: str) -> None:
    document = run("lpe", "compare", a, b, "--json").json
    assert list(document) == list(lpe_compare.JSON)
    assert document["relation"] == relation
    assert (document["only_a"] is None) == (relation in ("equal", "subset"))
    assert (document["only_b"] is None) == (relation in ("equal", "superset"))
    assert (document["both"] is None) == (relation == "disjoint")


def test_compare_knows_both_tables(run: Run) -> None:
    done = run("lpe", "compare", "sheen", "specular", "--lpe-table", "arnold7")
    assert done.out.startswith("disjoint: sheen and specular have no path in common\n")


def test_explain_as_json(run: Run) -> None:
    document = run("lpe", "explain", "cDL", "--json").json
    assert list(document) == list(lpe_explain.JSON)
    assert document["paragraph"].startswith("It takes paths that leave the camera, are scattered")
    assert document["taken"][0]["text"] == "C RD L"
    assert all(set(miss) == {"text", "words", "reason"} for miss in document["near_misses"])
    assert {"name": "RGBA", "relation": "subset"} in document["related"]
    assert [lint["code"] for lint in document["lints"]] == ["lpe-lower-case"]


def test_explain_says_that_the_default_group_is_literal(run: Run) -> None:
    assert "The group 'default' is literal" in run("lpe", "explain", "C<L.'default'>").out


def test_explain_in_a_scene_speaks_of_its_paths(run: Run) -> None:
    done = run("lpe", "explain", "C.*<L.'kye'>", "--scene", STILL)
    assert done.code == 0
    assert "takes, for example" not in done.out
    assert 'no light in group "kye"' in done.err
    assert 'did you mean "key"?' in done.err
    assert "+  C L'key'\n" in run("lpe", "explain", "C[DSL]+", "--scene", STILL).out


def test_proofs_in_a_scene_need_only_hold_there(run: Run) -> None:
    parts = ["diffuse", "specular", "coat", "transmission", "sss", "C[LOB]"]
    assert run("lpe", "partition", *parts).code == 1
    assert run("lpe", "partition", *parts, "--scene", STILL).code == 0


def test_a_scene_with_errors_is_told(run: Run) -> None:
    done = run("lpe", "rest", "diffuse", "--scene", ROOT / "tests/broken/bad_expressions.ass")
    assert done.code == 1
    assert done.err.count("error[") >= 6


def test_definitions_and_the_standard_language(run: Run) -> None:
    given = ["--lpe", "caustics CD.*S.*", "$diffuse - $caustics", "diffuse"]
    assert run("lpe", "compare", *given).out.startswith("subset: ")
    done = run("lpe", "compare", *given, "--lpe-standard")
    assert done.code == 1
    assert "error[lpe-standard]" in done.err
    assert run("lpe", "compare", "--lpe", "alone", "CL", "CB").code == 2


def test_several_mistakes_at_once_with_their_columns(run: Run) -> None:
    errors = run("lpe", "explain", "C(GD|<RX>)*+L", "--json").json["errors"]
    assert [error["column"] for error in errors] == [3, 8, 12]


def test_a_misspelt_name_is_no_expression_with_many_mistakes(run: Run) -> None:
    done = run("lpe", "explain", "difuse_direct")
    assert done.code == 1
    assert done.err.count("error[") == 1
    assert 'no AOV is called "difuse_direct"' in done.err
    assert 'did you mean "diffuse_direct"' in done.err


def test_what_is_too_large_is_an_error(run: Run) -> None:
    done = run("lpe", "rest", "C.*D.{20}L")
    assert done.code == 1
    assert "error[limit-lpe-" in done.err


def test_graph_text_goes_to_standard_output(run: Run) -> None:
    done = run("lpe", "graph", "direct", "CB")
    assert done.out.startswith("digraph lpe {\n")
    assert 'label="direct"' in done.out
    document = run("lpe", "graph", "direct", "--json").json
    assert list(document) == list(lpe_graph.JSON)
    assert document["file"] is None


@pytest.mark.parametrize(
    ("suffix", "head"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("dot", b"digraph")]
)
def test_graph_writes_pictures(run: Run, tmp_path: Path, suffix: str, head: bytes) -> None:
    done = run("lpe", "graph", "coat", "-o", f"sub/graph.{suffix}")
    assert (done.code, done.out) == (0, f"wrote sub/graph.{suffix}\n")
    assert (tmp_path / f"sub/graph.{suffix}").read_bytes().startswith(head)


def test_graph_of_another_kind_is_a_usage_error(run: Run) -> None:
    assert run("lpe", "graph", "coat", "-o", "graph.jpg").code == 2


def test_graph_without_dot_says_what_to_install(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "lightsieve", "lpe", "graph", "coat", "-o", "graph.svg"],
        cwd=tmp_path,
        env={**os.environ, "PATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert 'the program "dot" is not installed' in done.stderr
    assert "graphviz" in done.stderr


@pytest.mark.parametrize("colour", [True, False])
def test_errors_on_a_terminal_fit_it(tmp_path: Path, colour: bool) -> None:
    """The caret stays under what is wrong, however long the expression is."""
    environment = {**os.environ, "COLUMNS": "50", "TERM": "xterm-256color"}
    environment.pop("NO_COLOR", None)
    if not colour:
        environment["NO_COLOR"] = "1"
    ours, theirs = pty.openpty()
    expression = "C" + "D" * 90 + "G" + "L" * 30
    done = subprocess.run(
        [sys.executable, "-m", "lightsieve", "lpe", "explain", expression],
        cwd=tmp_path,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=theirs,
        check=False,
    )
    os.close(theirs)
    said = os.read(ours, 65536).decode()
    os.close(ours)
    assert done.returncode == 1
    assert ("\x1b[" in said) == colour
    if not colour:
        lines = said.replace("\r", "").splitlines()
        assert max(map(len, lines)) <= 50
        caret = next(i for i, line in enumerate(lines) if line.endswith("^"))
        assert lines[caret - 1][lines[caret].index("^")] == "G"
