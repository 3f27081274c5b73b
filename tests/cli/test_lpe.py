"""`lightsieve lpe list` and `lightsieve lpe match`."""

from __future__ import annotations

import pytest

from lightsieve.cli import lpe_list, lpe_match
from tests.conftest import Run


def test_list_prints_one_line_a_built_in(run: Run) -> None:
    done = run("lpe", "list")
    assert done.code == 0
    lines = {line.split()[0]: line for line in done.out.splitlines()}
    assert len(lines) == len(done.out.splitlines()) == 35
    assert "C<RS[^'coat']>L" in lines["specular_direct"]


def test_list_as_json_differs_between_the_tables_in_specular_only(run: Run) -> None:
    tables = [
        run("lpe", "list", "--lpe-table", name, "--json").json for name in ("reference", "arnold7")
    ]
    assert list(tables[0]) == list(lpe_list.JSON)
    assert [table["table"] for table in tables] == ["reference", "arnold7"]
    changed = [
        a["name"] for a, b in zip(tables[0]["aovs"], tables[1]["aovs"], strict=True) if a != b
    ]
    assert changed == ["specular", "specular_direct", "specular_indirect", "specular_albedo"]


@pytest.mark.parametrize(
    ("expression", "path", "taken"),
    [
        ("C<RD>L", "C RD L'key'", True),
        ("C<RD>L", "C RS L", False),
        ("C[DSV]L", "C <RS'coat'> L", True),
        ("diffuse", "C RD TS O", True),
        ("$coat_direct", "C RS'coat' L", True),
        ("$coat_direct", "C RS L", False),
        ("C<L.'key'>", "C L'key'", True),
        ("B", "C B", False),
    ],
)
def test_match_says_yes_or_no_and_exits_accordingly(
    run: Run, expression: str, path: str, taken: bool
) -> None:
    done = run("lpe", "match", expression, path)
    assert done.out == f"{'yes' if taken else 'no'}  {path}\n"
    assert done.code == (0 if taken else 1)


def test_match_as_json(run: Run) -> None:
    done = run("lpe", "match", "diffuse_direct", "C RD L", "C RD O", "--json")
    assert done.code == 1
    assert list(done.json) == list(lpe_match.JSON)
    assert done.json == {
        "expression": "C<RD>L",
        "paths": [{"path": "C RD L", "taken": True}, {"path": "C RD O", "taken": False}],
        "lints": [],
    }


def test_a_lint_is_told_and_is_no_failure(run: Run) -> None:
    done = run("lpe", "match", "cDL", "C RD L")
    assert done.code == 0
    assert done.out == "yes  C RD L\n"
    assert "lint[" in done.err


def test_bad_expression_is_quoted_with_a_caret(run: Run) -> None:
    done = run("lpe", "match", "CGL", "C RD L")
    assert done.code == 1
    assert done.out == ""
    assert done.err == (
        '<expression>:1:2: error[lpe-event]: no event "G"\n'
        "    1 | CGL\n"
        "      |  ^\n"
        "  hint: OSL has glossy and straight; here S covers both\n"
    )


def test_all_mistakes_of_an_expression_are_reported(run: Run) -> None:
    errors = run("lpe", "match", "C(GD", "C RD L", "--json").json["errors"]
    assert sorted((error["column"], error["severity"]) for error in errors) == [
        (2, "error"),
        (3, "error"),
    ]


def test_bad_path_is_quoted_with_a_caret(run: Run) -> None:
    done = run("lpe", "match", "C.*", "C D L")
    assert done.code == 1
    assert "error[lpe-path]" in done.err
    assert "| C D L\n      |   ^" in done.err
