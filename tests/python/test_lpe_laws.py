"""Laws of light path expressions, on expressions that hypothesis invents."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from lightsieve import lpe

LABELS = st.sampled_from(["coat", "hero", "key"])

single_events = st.one_of(
    st.sampled_from(
        ["D", "S", "R", "T", "V", "L", "O", "B", ".", "[DSV]", "[^D]", "<RD>", "<TS>"]
    ),
    LABELS.map(lambda label: f"<RS'{label}'>"),
    LABELS.map(lambda label: f"<R.[^'{label}']>"),
    LABELS.map(lambda label: f"<L.'{label}'>"),
)


def combined(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Larger parts of expressions from smaller ones."""
    pairs = st.tuples(inner, inner)
    return st.one_of(
        pairs.map("".join),
        pairs.map(lambda two: f"(({two[0]})|({two[1]}))"),
        pairs.map(lambda two: f"({two[0]} & {two[1]})"),
        pairs.map(lambda two: f"({two[0]} - {two[1]})"),
        st.tuples(inner, st.sampled_from("*+?")).map(lambda two: f"({two[0]}){two[1]}"),
    )


expressions = st.one_of(
    st.recursive(single_events, combined, max_leaves=5).map(lambda part: f"C{part}.*"),
    st.recursive(single_events, combined, max_leaves=4).map(lambda part: f"!(C{part}.*)"),
    st.sampled_from(["$direct", "$indirect", "$coat & C.*L", "C.*", "C[DSV][LO]"]),
)

scattering = st.one_of(
    st.sampled_from(["RD", "RS", "TD", "TS", "V"]),
    LABELS.map(lambda label: f"RS'{label}'"),
    LABELS.map(lambda label: f"RD'{label}'"),
)
paths = st.tuples(
    st.lists(scattering, max_size=4),
    st.sampled_from(["L", "L'key'", "O", "O'hero'", "B", "B'key'"]),
).map(lambda path: " ".join(["C", *path[0], path[1]]))

laws = settings(max_examples=150, deadline=None, derandomize=True)


@laws
@given(expressions)
def test_what_is_printed_means_the_same(text: str) -> None:
    expression = lpe.parse(text)
    again = lpe.parse(expression.normal)
    assert again.normal == expression.normal
    assert lpe.compare(expression, again).relation == "equal"


@laws
@given(expressions, expressions)
def test_de_morgan(a: str, b: str) -> None:
    assert lpe.compare(f"!(({a})|({b}))", f"!({a}) & !({b})").relation == "equal"
    assert lpe.compare(f"!(({a}) & ({b}))", f"(!({a}))|(!({b}))").relation == "equal"


@laws
@given(expressions, expressions)
def test_a_without_b_is_empty_if_a_is_a_part_of_b(a: str, b: str) -> None:
    difference = lpe.rest(b, of=a)
    relation = lpe.compare(a, b).relation
    assert (difference is None) == (relation in ("equal", "subset"))
    if difference is not None:
        assert lpe.compare(difference, f"({a}) - ({b})").relation == "equal"


@laws
@given(expressions, expressions, paths)
def test_operators_mean_what_they_say_on_every_path(a: str, b: str, path: str) -> None:
    in_a, in_b = lpe.match(a, path), lpe.match(b, path)
    assert lpe.match(f"({a}) & ({b})", path) == (in_a and in_b)
    assert lpe.match(f"({a}) - ({b})", path) == (in_a and not in_b)
    assert lpe.match(f"(({a})|({b}))", path) == (in_a or in_b)
    assert lpe.match(f"!({a})", path) == (not in_a)


@laws
@given(expressions, expressions)
def test_witnesses_are_what_they_are_witnesses_for(a: str, b: str) -> None:
    found = lpe.compare(a, b)
    for witness, in_a, in_b in (
        (found.only_a, True, False),
        (found.only_b, False, True),
        (found.both, True, True),
    ):
        if witness is not None:
            assert lpe.match(a, witness.text) == in_a
            assert lpe.match(b, witness.text) == in_b


@laws
@given(expressions, expressions)
def test_a_rest_completes_a_partition(a: str, b: str) -> None:
    both = f"({a}) & ({b})"
    left = lpe.rest(both, of=a)
    parts = [both] if left is None else [both, left]
    assert lpe.partition(*parts, of=a)


@laws
@given(expressions)
def test_shortest_paths_are_taken_and_sorted(text: str) -> None:
    found = lpe.parse(text).shortest_paths(4)
    assert all(lpe.match(text, path.text) for path in found)
    assert [len(path.text.split()) for path in found] == sorted(
        len(path.text.split()) for path in found
    )
