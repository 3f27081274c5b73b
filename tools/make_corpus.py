#!/usr/bin/env python3
"""Writes tests/lpe/corpus/generated.toml: random expressions, with verdicts by the definitions.

The verdicts come from tests/lpe/reference_engine.py, which shares nothing with the engine in
src/lpe, so the two check each other. The same script writes the same file everywhere; a test
compares. `make_corpus.py --check` only says whether the file is in step.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from tests.lpe.reference_engine import is_path, parse_path, takes  # noqa: E402
from tests.lpe.reference_parser import Event, Node, RefusedError, compile_text  # noqa: E402

TARGET = ROOT / "tests/lpe/corpus/generated.toml"
SEED = 20240607
N_STANDARD, N_EXTENDED, N_PROBES, N_ERRORS = 900, 250, 100, 180
#: At most so many paths of each verdict a case.
N_PATHS = 3
#: Paths tried on an expression until it is given up.
N_TRIED = 120

LABELS = ["coat", "sheen", "skin", "hero", "coat2"]
GROUPS = ["key", "fill"]
BLANKS = ["", "", "", "", " "]
LOBES = ["RD", "RS", "TD", "TS"]


def label(rng: random.Random) -> str:
    """A quoted label."""
    return f"'{rng.choice(LABELS)}'"


def label_tests(rng: random.Random) -> str:
    """None, one or two label tests."""
    forms = ["", "", label(rng), f"[{label(rng)}{label(rng)}]", f"[^{label(rng)}]", "."]
    forms += [f"[^{label(rng)}{label(rng)}]", f"{label(rng)}[^{label(rng)}]"]
    return rng.choice(forms)


def angle(rng: random.Random) -> str:
    """`<..>` of a scattering event."""
    kind = rng.choice(["R", "T", "R", "T", "V", ".", "[RT]", "[RV]", "[^R]", "[^TV]"])
    lobe = rng.choice(["D", "S", "D", "S", ".", "[DS]", "[^D]", "[^S]"])
    blank = rng.choice(BLANKS)
    if rng.random() < 0.15:
        return f"<{kind}{blank}>"
    return f"<{kind}{blank}{'.' if kind == 'V' else lobe}{label_tests(rng)}{blank}>"


def single(rng: random.Random) -> str:
    """One scattering event, in any spelling."""
    roll = rng.random()
    if roll < 0.5:
        return rng.choice("DSVDSRT.")
    if roll < 0.75:
        return angle(rng)
    if roll < 0.83:
        return label(rng)
    negation = "^" if rng.random() < 0.4 else ""
    items = [rng.choice([*"DSVRT", angle(rng), label(rng)]) for _ in range(rng.randint(1, 3))]
    return f"[{negation}{''.join(items)}]"


def quantifier(rng: random.Random) -> str:
    """What repeats."""
    low = rng.randint(0, 2)
    high = low + rng.randint(0, 2)
    counted = [f"{{{low}}}", f"{{{low},}}", f"{{{low},{high}}}", f"{{ {low} , {high} }}"]
    return rng.choice(["*", "*", "+", "+", "?", "?", *counted])


def repeat(rng: random.Random, depth: int) -> str:
    """One part of a sequence."""
    body = f"({middle(rng, depth - 1)})" if depth > 0 and rng.random() < 0.35 else single(rng)
    return body + (quantifier(rng) if rng.random() < 0.4 else "")


def sequence(rng: random.Random, depth: int) -> str:
    """Some parts, one after the other."""
    return rng.choice(BLANKS).join(repeat(rng, depth) for _ in range(rng.randint(1, 3)))


def middle(rng: random.Random, depth: int) -> str:
    """Scattering events: a sequence, or alternatives in one of their spellings."""
    roll = rng.random()
    if depth == 0 or roll < 0.6:
        return sequence(rng, depth)
    parts = [sequence(rng, depth - 1) for _ in range(rng.randint(2, 3))]
    if roll < 0.8:
        return "|".join(parts)
    blank = " " if roll < 0.9 else ""
    return f"({blank.join(f'({part})' for part in parts)})"


def end(rng: random.Random) -> str:
    """What ends a light path."""
    group = rng.choice(GROUPS)
    ends = ["L", "L", "O", "B", ".", "[LO]", "[^L]", f"<L.'{group}'>", f"<L.[^'{group}']>"]
    return rng.choice([*ends, "<L.'default'>", "<[LB]>", ".*", ".*", "V*L", f".*<L.'{group}'>"])


def light(rng: random.Random) -> str:
    """An expression that can take light."""
    text = f"C{middle(rng, 2)}{end(rng)}"
    if rng.random() < 0.15:
        other = f"C{sequence(rng, 1)}{end(rng)}"
        text = rng.choice([f"{text}|{other}", f"(({text})|({other}))", f"(({text}) ({other}))"])
    return text


def extended(rng: random.Random) -> str:
    """An expression with our extensions."""
    names = ["diffuse", "indirect", "coat_direct", "specular", "volume", "emission"]
    a = light(rng) if rng.random() < 0.4 else rng.choice(["C.*", "C.*L", "C.*D.*"])
    b = f"${rng.choice(names)}" if rng.random() < 0.3 else f"C.*{single(rng)}.*"
    c = f"C{single(rng)}.*"
    forms = [f"({a}) & {b}", f"({a}) - {b}", f"!({a})", f"({a}) - {b} - {c}", f"({a}) & !({b})"]
    forms += [f"({a}) - ({b} - {c})", f"C({single(rng)} & {single(rng)})*{end(rng)}"]
    forms += [f"C.* - {b} & {c}", f"C({single(rng)} - {single(rng)})+.*", f"!({b}|{c})"]
    return rng.choice(forms)


def probe(rng: random.Random) -> str:
    """An expression that takes probes."""
    return f"C{middle(rng, 1)}{rng.choice(['A', 'A', '[LA]', '<A>', 'A?', '(A|O)'])}"


def broken(rng: random.Random) -> str:
    """A good expression with one character too many, too few or another."""
    text = light(rng)
    at = rng.randrange(len(text))
    new = rng.choice("()[]<>'*+?{}|^CDLGEsx1,")
    return rng.choice([text[:at] + text[at + 1 :], text[:at] + new + text[at:]])


def random_event(rng: random.Random) -> str:
    """A scattering event."""
    if rng.random() < 0.15:
        return "V" + (label(rng) if rng.random() < 0.3 else "")
    text = rng.choice(LOBES)
    for name in sorted(rng.sample(LABELS, rng.choice([0, 0, 1, 1, 2]))):
        text += f"'{name}'"
    return text


def random_end(rng: random.Random) -> str:
    """A terminal event."""
    ends = ["L", "L", "L'key'", "L'fill'", "O", "O'skin'", "B", "B'key'", "A"]
    return rng.choice(ends)


def path_pool(rng: random.Random) -> list[tuple[str, list[Event]]]:
    """Paths to choose from."""
    texts = ["C L", "C L'key'", "C O", "C B"]
    texts += [f"C {lobe} {stop}" for lobe in [*LOBES, "V"] for stop in ("L", "O", "B", "A")]
    for length in (1, 2, 2, 3, 3, 4, 5):
        for _ in range(60):
            middle_part = " ".join(random_event(rng) for _ in range(length))
            texts.append(f"C {middle_part} {random_end(rng)}")
    return [(text, parse_path(text)) for text in dict.fromkeys(texts)]


Pool = list[tuple[str, list[Event]]]


def near(text: str, rng: random.Random) -> str:
    """The path with one event more, less or other: a small difference tests more than a large one."""
    events = text.split(" ")
    at = rng.randrange(1, len(events))
    if at == len(events) - 1:
        events[at] = random_end(rng)
    elif rng.random() < 0.4:
        events[at] = random_event(rng)
    elif rng.random() < 0.5:
        events.insert(at, random_event(rng))
    else:
        del events[at]
    return " ".join(events)


def verdicts(node: Node, pool: Pool, rng: random.Random) -> tuple[list[str], list[str]]:
    """Some paths that it takes, and some that it does not though they differ little from these."""
    taken: list[str] = []
    for text, path in rng.sample(pool, N_TRIED):
        if takes(node, path):
            taken.append(text)
        if len(taken) == N_PATHS:
            break
    left: list[str] = []
    for _ in range(8 * N_PATHS if taken else 0):
        text = near(rng.choice(taken), rng)
        path = parse_path(text)
        if text not in left and is_path(path) and not takes(node, path):
            left.append(text)
        if len(left) == N_PATHS:
            break
    return sorted(taken, key=len), sorted(left, key=len)


def strings(values: list[str]) -> str:
    """A TOML array."""
    return "[" + ", ".join(json.dumps(value) for value in values) + "]"


def cases(
    make: Callable[[random.Random], str], count: int, pool: Pool, seed: int, *lines: str
) -> list[str]:
    """So many cases of that sort, each with paths of both verdicts."""
    rng = random.Random(seed)
    out: dict[str, str] = {}
    while len(out) < count:
        text = make(rng)
        if text in out or len(text) > 56:
            continue
        taken, left = verdicts(compile_text(text), pool, rng)
        if not taken or not left:
            continue
        entry = ["[[case]]", f"expression = {json.dumps(text)}", "generated = true", *lines]
        entry += [f"accepts = {strings(taken)}", f"rejects = {strings(left)}", ""]
        out[text] = "\n".join(entry)
    return list(out.values())


def errors(count: int, seed: int) -> list[str]:
    """So many texts that are refused, with their first error."""
    rng = random.Random(seed)
    out: dict[str, str] = {}
    while len(out) < count:
        text = broken(rng)
        if len(text) > 60:
            continue
        try:
            compile_text(text)
        except RefusedError as error:
            report = f"{{code = {json.dumps(error.code)}, column = {error.column}}}"
            entry = ["[[case]]", f"expression = {json.dumps(text)}", "generated = true"]
            out[text] = "\n".join([*entry, f"errors = [{report}]", ""])
    return list(out.values())


def generate() -> str:
    """The text of the file."""
    pool = path_pool(random.Random(SEED))
    head = [
        "# Written by tools/make_corpus.py, verdicts by tests/lpe/reference_engine.py: do not edit.",
        "# A case of errors names the first one only, without its hint.",
        "",
    ]
    parts = [
        ("light", cases(light, N_STANDARD, pool, SEED + 1)),
        ("our extensions", cases(extended, N_EXTENDED, pool, SEED + 2, "extension = true")),
        ("probes", cases(probe, N_PROBES, pool, SEED + 3)),
        ("what is refused", errors(N_ERRORS, SEED + 4)),
    ]
    for title, entries in parts:
        head += [f"# {title}", "", *entries]
    return "\n".join(head)


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="writes tests/lpe/corpus/generated.toml")
    parser.add_argument("--check", action="store_true", help="compare, do not write")
    text = generate()
    if parser.parse_args().check:
        current = TARGET.read_text(encoding="utf-8") if TARGET.exists() else ""
        return 0 if current == text else 1
    TARGET.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
