"""`lightsieve lpe translate`."""

from __future__ import annotations

import typing

import pytest

from lightsieve import dialects
from lightsieve.cli import lpe_translate
from tests.conftest import Run


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--to", "karma", "C<RS[^'coat']>L"], "C<RG.[^'coat']>L"),
        (["--to", "osl", "diffuse"], "Cs*<RD>.*"),
        (["--to", "moonray", "--without", "straight", "diffuse_direct"], "C<RD>L"),
        (["--from", "karma", "--to", "arnold", "C<TG>A"], "C<TS>A"),
        (["--from", "osl", "--to", "arnold", "C<Ts>*D<Ts>*L"], "CDL"),
    ],
)
def test_an_exact_translation_comes_first_and_exits_0(
    run: Run, arguments: list[str], text: str
) -> None:
    done = run("lpe", "translate", *arguments)
    assert done.code == 0, done.err
    first, *others = done.out.splitlines()
    assert first == text
    assert all(line.startswith("  unverified  ") for line in others)


def test_a_loss_is_told_with_a_path_and_exits_1(run: Run) -> None:
    done = run("lpe", "translate", "--from", "osl", "--to", "arnold", "CSL")
    assert done.code == 1
    assert done.out.splitlines()[:4] == [
        "CSL",
        "not exact: the nearest expression",
        "  added  C RG L",
        "         a path that leaves the camera, is reflected glossily, and ends at a light",
    ]
    assert "--without straight --without glossy" in done.out


def test_what_cannot_be_written_is_told(run: Run) -> None:
    done = run("lpe", "translate", "--to", "renderman", "volume")
    assert done.code == 1
    assert done.out.startswith("nothing can be written\n  lost  C V L\n")


def test_a_prefix_that_is_lost_is_told(run: Run) -> None:
    done = run("lpe", "translate", "--from", "karma", "--to", "arnold", "unoccluded;CL")
    assert done.code == 1
    assert "  lost  unoccluded;\n        arnold has no such prefix\n" in done.out


def test_explain_says_what_a_renderer_really_does(run: Run) -> None:
    done = run("lpe", "translate", "--from", "osl", "--explain", "(CDL)|(CSL)")
    assert done.code == 1
    assert done.out.splitlines()[:3] == [
        "  read as  CDL",
        "  meant    ((CDL)|(CSL))",
        "  missed   C RS L",
    ]
    assert "lint[lpe-misread]: OSL ignores everything after a leading parenthesis" in done.err
    done = run("lpe", "translate", "--from", "osl", "--explain", "C<RD>L")
    assert (done.code, done.out) == (0, "  read as  C<RD>L\nas it was meant\n")


def test_every_mistake_of_a_text_is_reported(run: Run) -> None:
    done = run("lpe", "translate", "--from", "osl", "--to", "arnold", "C D?L")
    assert done.code == 1
    assert done.out == ""
    assert done.err.count("error[") == 2
    assert "      |   ^\n  hint: write {0,1}\n" in done.err.replace("    ^", "   ^", 1)


@pytest.mark.parametrize(
    "arguments",
    [
        ["--to", "osl"],
        ["CDL"],
        ["--to", "nuke", "CDL"],
        ["--to", "osl", "--without", "light", "CDL"],
    ],
)
def test_wrong_usage_exits_2(run: Run, arguments: list[str]) -> None:
    assert run("lpe", "translate", *arguments).code == 2


def test_json(run: Run) -> None:
    keys = [key for key in lpe_translate.JSON if key != "dialects"]
    exact = run("lpe", "translate", "--to", "karma", "coat", "--json")
    assert exact.code == 0
    assert list(exact.json) == keys
    assert exact.json["expression"] == "C<RS'coat'>.*"
    assert (exact.json["text"], exact.json["exact"]) == ("C<RG.'coat'>.*", True)
    lossy = run("lpe", "translate", "--from", "osl", "--to", "arnold", "CSL", "--json")
    assert lossy.code == 1
    assert lossy.json["added"] == {
        "text": "C RG L",
        "words": "a path that leaves the camera, is reflected glossily, and ends at a light",
    }
    assert lossy.json["exact_without"] == ["straight", "glossy"]
    read = run("lpe", "translate", "--from", "osl", "--explain", "CDL|CSL", "--json")
    assert read.code == 1
    assert list(read.json) == keys
    assert (read.json["text"], read.json["meant"]) == ("", "((CDL)|(CSL))")
    assert read.json["lost"]["text"] == "C RD L"


def test_list(run: Run) -> None:
    done = run("lpe", "translate", "--list")
    assert done.code == 0
    assert "karma: Houdini Karma" in done.out
    assert "  unverified  an event without the tag or label passes a [^'x']\n" in done.out
    listed = run("lpe", "translate", "--list", "--json").json["dialects"]
    assert [row["name"] for row in listed] == [row.name for row in dialects.dialects()]
    assert all(row["verified"] or row["unverified"] for row in listed)


def test_the_names_in_python_are_those_of_the_engine() -> None:
    names = [dialect.name for dialect in dialects.dialects()]
    assert list(typing.get_args(dialects.DialectName)) == names
    assert list(typing.get_args(lpe_translate.Name)) == names
    properties = list(dialects.scene_properties())
    assert list(typing.get_args(dialects.SceneProperty)) == properties
    assert [one.value for one in lpe_translate.Property] == properties
