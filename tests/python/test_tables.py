"""Exported tables: the arrays take the paths that the matcher takes, in every kind of file."""

from __future__ import annotations

import itertools
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lightsieve import LightsieveError, lpe
from lightsieve.tables import FIRST_CLASS, NO_ATOM, Tables

SCATTERING = ["RD", "RS'coat'", "TS", "V'fi\"re'"]
TERMINALS = ["L'key'", "L", "O", "B", "A"]
EXPRESSIONS = ["diffuse", "C<RS'coat'>.*", "C.*<L.'key'>", "C.*<V.'fi\"re'>O", "diffuse_albedo"]
CONTEXT = lpe.Context(events=SCATTERING + TERMINALS)


def paths() -> Iterator[tuple[str, ...]]:
    for length in range(4):
        for scattering in itertools.product(SCATTERING, repeat=length):
            for terminal in TERMINALS:
                if length > 0 or terminal != "A":
                    yield (*scattering, terminal)


def follow(arrays: Mapping[str, Any], path: tuple[str, ...]) -> list[str]:
    """The AOVs that take the path, by the arrays alone."""
    table = arrays["table"].ravel()
    column = dict(zip(list(arrays["events"]), arrays["event_columns"], strict=True))
    taken = []
    for state in arrays["starts"]:
        for event in path[:-1]:
            state = table[state + column[event]]
        atom = table[state + column[path[-1]]]
        if atom != NO_ATOM:
            assert table[state] & (2 if path[-1] == "A" else 1)
            begin, end = arrays["atom_begin"][atom : atom + 2]
            taken += [str(arrays["aovs"][aov]) for aov in arrays["atom_aovs"][begin:end]]
    return taken


@pytest.fixture
def made() -> Tables:
    return lpe.tables(*EXPRESSIONS, context=CONTEXT)


def test_the_arrays_take_what_the_matcher_takes(made: Tables) -> None:
    n_taken = 0
    for path in paths():
        text = " ".join(["C", *path])
        expected = [e for e in EXPRESSIONS if lpe.match(e, text, CONTEXT)]
        assert follow(made._asdict(), path) == expected, text
        n_taken += len(expected)
    assert n_taken > 100


def test_columns_are_where_the_layout_says(made: Tables) -> None:
    for event, column in zip(made.events, made.event_columns, strict=True):
        low, high = FIRST_CLASS, made.first_terminal
        if event in TERMINALS:
            low, high = made.first_terminal, made.table.shape[1]
        assert low <= column < high, event
    assert not made.table[0, : made.first_terminal].any()
    assert (made.table[0, made.first_terminal :] == NO_ATOM).all()
    assert (made.table[:, FIRST_CLASS : made.first_terminal] % made.table.shape[1] == 0).all()


def test_without_a_context_every_class_of_events_is_there() -> None:
    events = lpe.tables("C<RS'coat'>.*<L.'key'>").events
    assert {"RS'coat'", "L'key'", "RD", "TS", "V", "O", "B", "A"} <= set(events)


def test_npz_has_every_array_and_npy_the_table(made: Tables, tmp_path: Path) -> None:
    made.save(tmp_path / "all.npz")
    made.save(tmp_path / "table.npy")
    with np.load(tmp_path / "all.npz") as arrays:
        assert set(arrays) == set(Tables._fields)
        path = ("RS'coat'", "L'key'")
        assert follow(arrays, path) == ["C<RS'coat'>.*", "C.*<L.'key'>"]
        assert int(arrays["first_terminal"]) == made.first_terminal
    assert (np.load(tmp_path / "table.npy") == made.table).all()


def test_the_header_is_c_and_holds_the_same_numbers(made: Tables, tmp_path: Path) -> None:
    made.save(tmp_path / "2 aovs.h")
    prints = [
        f"for (int i = 0; i < (int)(sizeof _2_aovs_{name} / sizeof *_2_aovs_{name}); ++i) "
        f'printf("%lu ", (unsigned long)_2_aovs_{name}[i]);\nputs("");'
        for name in ("table", "starts", "event_columns", "atom_begin", "atom_aovs")
    ]
    prints += [
        f"for (int i = 0; i < _2_aovs_n_{name}; ++i) puts(_2_aovs_{name}[i]);"
        for name in ("events", "aovs")
    ]
    program = tmp_path / "program.c"
    program.write_text(
        '#include <stdio.h>\n#include "2 aovs.h"\nint main(void) {\n' + "\n".join(prints) + "\n}\n"
    )
    subprocess.run(
        ["cc", "-std=c99", "-Wall", "-Werror", program, "-o", tmp_path / "program"], check=True
    )
    said = subprocess.run(
        [tmp_path / "program"], check=True, capture_output=True, text=True
    ).stdout.splitlines()
    for line, field in zip(
        said, ("table", "starts", "event_columns", "atom_begin", "atom_aovs"), strict=False
    ):
        assert [int(n) for n in line.split()] == getattr(made, field).ravel().tolist()
    assert said[5:] == made.events + made.aovs


def test_an_expression_over_budget_is_an_error() -> None:
    with pytest.raises(LightsieveError) as raised:
        lpe.tables("C.*D.{20}L")
    assert raised.value.errors[0].code.startswith("limit-lpe-")


def test_other_kinds_of_files_are_refused(made: Tables, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="h, "):
        made.save(tmp_path / "table.txt")


def test_the_tables_of_all_built_ins_are_as_small_as_the_guide_says() -> None:
    made = lpe.tables(*(builtin.name for builtin in lpe.builtins()))
    assert (len(made.aovs), len(made.table), made.table.nbytes) == (35, 16, 768)
