"""`lightsieve.lpe`: expressions, contexts, answers."""

from __future__ import annotations

import itertools
import subprocess
import sys

import pytest

from lightsieve import LightsieveError, lpe
from tests.conftest import ROOT


def test_expressions_have_the_answers_as_methods() -> None:
    diffuse = lpe.parse("diffuse")
    assert (diffuse.name, diffuse.text, str(diffuse)) == ("diffuse", "C<RD>.*", "C<RD>.*")
    assert diffuse.match("C RD L")
    assert diffuse.partition("diffuse_direct", "diffuse_indirect")
    rest = diffuse.rest("diffuse_direct")
    assert rest is not None
    assert rest.compare("diffuse_indirect").relation == "equal"
    assert diffuse.explain().name == "diffuse"
    assert [path.text for path in diffuse.shortest_paths(2)] == ["C RD L", "C RD O"]
    assert not diffuse.is_empty()
    assert (diffuse - diffuse).is_empty()
    assert [lpe.parse("C<RD>{2}L").count_paths(n) for n in (3, 4, 5)] == [0, 1, 0]
    assert lpe.parse("C(<RD><RS>|<RS><RD>)L").count_paths(4) == 2
    assert repr(lpe.parse("CL")) == "lightsieve.lpe.parse('CL')"


def test_operators_are_those_of_the_language() -> None:
    direct, diffuse = lpe.parse("direct"), lpe.parse("diffuse")
    assert (direct & diffuse).compare("diffuse_direct").relation == "equal"
    assert (diffuse - direct).compare("diffuse_indirect").relation == "equal"
    assert (direct | diffuse).compare("$direct | $diffuse").relation == "equal"
    assert (~diffuse).partition().fault == "lost"
    assert lpe.partition(diffuse, ~diffuse)


def test_answers_can_be_used_as_conditions_and_tell_the_fault() -> None:
    result = lpe.partition("specular", "sheen", of="specular")
    assert not result
    assert (result.fault, result.parts) == ("twice", (0, 1))
    assert result.witness is not None
    assert str(result.witness) == "C RS'sheen' L"


def test_a_context_has_names_of_its_own() -> None:
    context = lpe.Context(definitions={"b": "$a & C.*L", "a": "CD.*", "diffuse": "CD.*"})
    assert lpe.compare("b", "$diffuse", context).relation == "subset"
    assert lpe.parse("diffuse", context).text == "CD.*"
    assert context.names[:2] == ["a", "b"]
    assert {"a", "b"} <= {aov.name for aov in lpe.explain("CDL", context).related}
    # Expressions remember theirs.
    assert lpe.parse("$b", context).compare("$a").relation == "subset"


@pytest.mark.parametrize(
    ("definitions", "code"),
    [
        ({"a": "$b", "b": "$a"}, "lpe-cycle"),
        ({"a": "CG"}, "lpe-event"),
        ({"a": "$no"}, "lpe-reference"),
    ],
)
def test_definitions_that_cannot_be_read(definitions: dict[str, str], code: str) -> None:
    with pytest.raises(LightsieveError) as caught:
        lpe.Context(definitions=definitions)
    assert code in {error.code for error in caught.value.errors}


def test_a_context_may_know_a_few_events_only() -> None:
    context = lpe.Context(events=["RD", "RS'coat'", "L'key'", "L", "B"])
    assert lpe.partition("diffuse", "coat", "CL", "CB", context=context)
    assert lpe.rest("diffuse", "C[LB]", of="C.*L", context=context) is not None
    assert lpe.compare("specular", "CB", context).relation != "equal"
    assert lpe.compare("specular", "transmission", context).relation == "equal"


def test_a_scene_is_a_context() -> None:
    context = lpe.Context.of_scene(ROOT / "tests/scenes/still.ass")
    told = lpe.explain("C.*<L.'key'>", context)
    assert told.taken[0].text == "C L'key'"
    with pytest.raises(LightsieveError):
        lpe.Context.of_scene(ROOT / "tests/broken/bad_expressions.ass")


def test_standard_contexts_refuse_extensions() -> None:
    standard = lpe.Context(standard=True)
    assert lpe.parse("$diffuse").match("C RD L")
    for text in ("$diffuse", "CD & CS", "!(CL)", "C.* - CL"):
        with pytest.raises(LightsieveError) as caught:
            lpe.parse(text, standard)
        assert caught.value.errors[0].code == "lpe-standard"
    assert lpe.parse("diffuse", standard).name == "diffuse"


def test_notebooks_show_words_and_pictures() -> None:
    expression = lpe.parse("C<RS'coat'>L")
    html = expression._repr_html_()
    assert "C&lt;RS&#x27;coat&#x27;&gt;L" in html
    assert "are reflected by the coat" in html
    assert "<script" not in lpe.parse("C<L.'<script>'>")._repr_html_()
    assert "<svg" in expression._repr_svg_()
    assert "<svg" in lpe.graph("direct", "indirect")._repr_svg_()


def test_every_pair_of_builtins_has_a_relation_that_its_witnesses_show() -> None:
    names = [row.name for row in lpe.builtins()]
    for a, b in itertools.product(names, names):
        result = lpe.compare(a, b)
        for path, in_a, in_b in [
            (result.only_a, True, False),
            (result.only_b, False, True),
            (result.both, True, True),
        ]:
            if path is not None:
                assert lpe.match(a, path.text) is in_a
                assert lpe.match(b, path.text) is in_b
        shown = (result.only_a is not None, result.only_b is not None, result.both is not None)
        assert (
            shown
            == {
                "equal": (False, False, True),
                "subset": (False, True, True),
                "superset": (True, False, True),
                "overlapping": (True, True, True),
                "disjoint": (True, True, False),
            }[result.relation]
        )


def test_commands_of_the_engine_load_nothing_heavy() -> None:
    """Else they could not answer at the speed of typing."""
    code = (
        "import sys\n"
        "from lightsieve.cli.main import build_app, command_files\n"
        "build_app(False, command_files(['lpe', 'explain']))\n"
        "from lightsieve import lpe\n"
        "lpe.explain('diffuse')\n"
        "heavy = {'numpy', 'lightsieve._core', 'rich.console', 'PIL', 'lightsieve.rendering'}\n"
        "print(sorted(heavy & set(sys.modules)), 'lightsieve.cli.render' in sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[] False\n"
