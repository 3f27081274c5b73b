"""A second engine for the conformance corpus: the language's definitions, tried out one by one.

Nothing here is shared with the engine in `src/lpe`: another parser (`reference_parser.py`), and a
matcher that tries every way to divide a path among the parts of an expression. It writes the
verdicts of `corpus/generated.toml`, and can be made to err by `--fault`.

As a program (`python3 -m tests.lpe.reference_engine`) it answers `run_corpus.py`: one JSON object
a line, see `corpus/README.md`.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Iterable
from typing import Any

from tests.lpe.reference_parser import UNBOUNDED, Event, Fault, Node, RefusedError, compile_text

EVENT = re.compile(r"<?\s*([CRTVLOBA])\s*([DS.]?)\s*((?:'[^']+'\s*)*)>?(?=\s|$)\s*")


def parse_path(text: str) -> list[Event]:
    """Reads a path such as `C RD'skin' L'key'`; raises ValueError on what is none."""
    events = []
    at = 0
    while at < len(text):
        found = EVENT.match(text, at)
        if found is None:
            raise ValueError(f"no event at {at} of {text!r}")
        kind, lobe, labels = found.groups()
        names = re.findall(r"'([^']+)'", labels)
        if kind == "L" and not names:
            names = ["default"]
        events.append(Event(kind, lobe.replace(".", ""), tuple(names)))
        at = found.end()
    return events


def is_path(path: list[Event]) -> bool:
    """C, scattering events, one end; a probe needs a vertex."""
    word = "".join(event.kind for event in path)
    return re.fullmatch(r"C[RTV]*[LOB]|C[RTV]+A", word) is not None


class Matcher:
    """Tries every way to divide one path among the parts of an expression."""

    def __init__(self, path: list[Event], faults: Iterable[Fault]) -> None:
        self.path = path
        self.faults = frozenset(faults)
        self.known: dict[tuple[int, int], list[int]] = {}

    def ends(self, node: Node, begin: int) -> list[int]:
        """Every place where a match that begins here can end, longest repeats first."""
        key = (id(node), begin)
        if key not in self.known:
            self.known[key] = list(dict.fromkeys(getattr(self, node.form)(node, begin)))
        return self.known[key]

    def after(self, node: Node, places: Iterable[int]) -> list[int]:
        """Where it can end when it begins at one of these."""
        return list(dict.fromkeys(end for at in places for end in self.ends(node, at)))

    def event(self, node: Node, begin: int) -> list[int]:
        """One event that passes the test."""
        if node.is_camera and begin > 0 and Fault.CAMERA_ANYWHERE in self.faults:
            return [begin]
        return [begin + 1] if begin < len(self.path) and node.test(self.path[begin]) else []

    def sequence(self, node: Node, begin: int) -> list[int]:
        """One part after the other."""
        places = [begin]
        for part in node.parts:
            places = self.after(part, places)
        return places

    def alternation(self, node: Node, begin: int) -> list[int]:
        """Any of the parts."""
        all_ends = [self.ends(part, begin) for part in node.parts]
        if Fault.FIRST_ALTERNATIVE in self.faults:
            return next((ends for ends in all_ends if ends), [])
        return [end for ends in all_ends for end in ends]

    def repeat(self, node: Node, begin: int) -> list[int]:
        """The body, `least` to `most` times."""
        rounds: list[list[int]] = []
        places = [begin]
        # Rounds beyond the least and the path's length can only be empty ones.
        for number in range(min(node.most, node.least + len(self.path) + 1) + 1):
            if number >= node.least:
                rounds.append(places)
            places = self.after(node.parts[0], places)
            if not places:
                break
        ends = list(dict.fromkeys(end for places in reversed(rounds) for end in places))
        optional = node.most == 1 and Fault.GREEDY_OPTIONAL in self.faults
        endless = node.most == UNBOUNDED and Fault.GREEDY_STAR in self.faults
        return ends[:1] if optional or endless else ends

    def nothing(self, node: Node, begin: int) -> list[int]:
        """An empty alternative, which only a faulty parser makes."""
        return [begin]

    def both(self, node: Node, begin: int) -> list[int]:
        """Taken by both parts."""
        right = self.ends(node.parts[1], begin)
        return [end for end in self.ends(node.parts[0], begin) if end in right]

    def minus(self, node: Node, begin: int) -> list[int]:
        """Taken by the first part and not by the second."""
        right = self.ends(node.parts[1], begin)
        return [end for end in self.ends(node.parts[0], begin) if end not in right]

    def complement(self, node: Node, begin: int) -> list[int]:
        """What `C.* - (a)` takes."""
        ends: list[int] = []
        if Fault.COMPLEMENT_OF_WORDS in self.faults:
            ends = list(range(begin, len(self.path) + 1))
        elif begin < len(self.path) and self.path[begin].kind == "C":
            ends = [begin + 1]
            while ends[-1] < len(self.path) and self.path[ends[-1]].kind not in "CA":
                ends.append(ends[-1] + 1)
        taken = self.ends(node.parts[0], begin)
        return [end for end in ends if end not in taken]


def takes(node: Node, path: list[Event], faults: Iterable[Fault] = ()) -> bool:
    """Does the expression take the path?"""
    ends = Matcher(path, faults).ends(node, 0)
    if Fault.UNANCHORED in frozenset(faults):
        return is_path(path) and bool(ends)
    return is_path(path) and len(path) in ends


def answer(request: dict[str, Any], faults: Iterable[Fault] = ()) -> dict[str, Any]:
    """The answer to one request of the runner."""
    reply: dict[str, Any] = {"id": request["id"]}
    if request["dialect"] != "arnold" or request["notation"] != "arnold":
        return {**reply, "unsupported": "other dialects and their notation of paths"}
    try:
        node = compile_text(request["expression"], request.get("standard", False), faults)
    except RefusedError as refused:
        return {**reply, "error": {"code": refused.code, "column": refused.column}}
    paths = [parse_path(text) for text in request["paths"]]
    return {**reply, "verdicts": [takes(node, path, faults) for path in paths]}


def main() -> None:
    """Answers requests until there are no more."""
    parser = argparse.ArgumentParser(description="answers run_corpus.py by the definitions")
    faults = {fault.name.lower().replace("_", "-"): fault for fault in Fault}
    parser.add_argument("--fault", choices=sorted(faults), action="append", default=[])
    chosen = [faults[name] for name in parser.parse_args().fault]
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line), chosen)), flush=True)


if __name__ == "__main__":
    main()
