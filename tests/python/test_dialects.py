"""`lightsieve.lpe.translate` and its kin."""

from __future__ import annotations

import pytest

from lightsieve import LightsieveError, lpe

OTHERS = [dialect.name for dialect in lpe.dialects() if dialect.name != "arnold"]


def test_a_translation_is_true_if_it_is_exact() -> None:
    assert lpe.translate("C<RD>L", target="osl")
    lossy = lpe.translate("C<RS[^'coat']>L", target="osl")
    assert not lossy
    assert lossy.added == lpe.Path(
        "C RG'coat' L",
        "a path that leaves the camera, is reflected glossily by a lobe 'coat', "
        "and ends at a light",
    )
    assert lossy.lost is None


def test_names_and_parsed_expressions_will_do() -> None:
    assert lpe.translate(lpe.parse("coat"), target="karma").text == "C<RG.'coat'>.*"
    assert lpe.translate("coat", target="karma").text == "C<RG.'coat'>.*"
    combined = lpe.parse("direct") & lpe.parse("diffuse")
    assert lpe.translate(combined, target="karma").exact


@pytest.mark.parametrize("target", OTHERS)
def test_built_ins_come_back_as_they_were(target: lpe.DialectName) -> None:
    exact = 0
    for builtin in lpe.builtins():
        there = lpe.translate(builtin.expression, target=target)
        assert bool(there) == (bool(there.text) and there.lost is None and there.added is None)
        if not there:
            continue
        exact += 1
        back = lpe.translate(there.text, source=target)
        assert back.exact
        assert lpe.compare(back.text, builtin.expression).relation == "equal"
    assert exact > 0 or target == "renderman"


def test_refusals_are_errors_with_places() -> None:
    with pytest.raises(LightsieveError) as refused:
        lpe.translate("CD?S?L", source="osl")
    assert [(error.code, error.column) for error in refused.value.errors] == [
        ("lpe-quantifier", 3),
        ("lpe-quantifier", 5),
    ]
    with pytest.raises(LightsieveError) as refused:
        lpe.translate("CDL", target="nuke")  # type: ignore[arg-type]
    assert refused.value.errors[0].code == "unknown-choice"
    with pytest.raises(LightsieveError) as refused:
        lpe.translate("CDL", target="osl", without=["light"])  # type: ignore[list-item]
    assert refused.value.errors[0].code == "unknown-choice"


def test_what_a_renderer_really_reads() -> None:
    reading = lpe.read_as("C(DL|SL)")
    assert not reading
    assert (reading.text, reading.meant) == ("CDSL", "C((DL)|(SL))")
    assert (reading.missed, reading.extra) == (
        lpe.Path(
            "C RD L", "a path that leaves the camera, is reflected diffusely, and ends at a light"
        ),
        lpe.Path(
            "C RD RS L",
            "a path that leaves the camera, is reflected diffusely, is reflected perfectly, "
            "and ends at a light",
        ),
    )
    assert lpe.read_as("C<RD>L", "moonray")
