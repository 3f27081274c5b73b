"""Asks any engine for light path expressions every row of the conformance corpus.

`run_corpus.py --engine "COMMAND"` starts the command, writes it one JSON request a line and reads
one JSON answer a line; `corpus/README.md` describes both. Needs nothing but Python 3.11. Exit code
0 if nothing is wrong, 1 if something is, 2 if the engine cannot be run.
"""

from __future__ import annotations

import argparse
import json
import shlex
import subprocess
import sys
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parent
#: Keys of a case that hold paths, and the verdict on them.
VERDICTS = {"accepts": True, "takes": True, "rejects": False, "leaves": False}

Engine = Callable[[dict[str, Any]], dict[str, Any]]


class EngineError(Exception):
    """The engine ended, or answered what is no answer."""


@dataclass(frozen=True)
class Case:
    """One expression of the corpus: what to ask and what to expect."""

    file: str
    line: int
    dialect: str
    notation: str
    expression: str
    why: str
    standard: bool
    extension: bool
    by_hand: bool
    paths: tuple[str, ...]
    verdicts: tuple[bool, ...]
    error: tuple[str, int] | None

    @property
    def n_rows(self) -> int:
        """Verdicts and errors: a row is one of them."""
        return len(self.paths) + (self.error is not None)

    def request(self, number: int) -> dict[str, Any]:
        """What the engine is asked."""
        return {
            "id": number,
            "dialect": self.dialect,
            "notation": self.notation,
            "expression": self.expression,
            "standard": self.standard,
            "paths": list(self.paths),
        }


@dataclass
class Report:
    """What came out."""

    counts: Counter[str] = field(default_factory=Counter)
    wrong: list[dict[str, Any]] = field(default_factory=list)


def read_case(file: Path, line: int, entry: dict[str, Any]) -> Case:
    """One `[[case]]` table."""
    rows = [(path, verdict) for key, verdict in VERDICTS.items() for path in entry.get(key, [])]
    errors = entry.get("errors", [])
    return Case(
        file=f"{file.parent.name}/{file.name}",
        line=line,
        dialect=entry.get("dialect", "arnold"),
        notation="common" if "takes" in entry or "leaves" in entry else "arnold",
        expression=entry["expression"],
        why=entry.get("why", ""),
        standard=entry.get("standard", False),
        extension=entry.get("extension", False),
        by_hand=not entry.get("generated", False),
        paths=tuple(path for path, _ in rows),
        verdicts=tuple(verdict for _, verdict in rows),
        error=(errors[0]["code"], errors[0]["column"]) if errors else None,
    )


def read_corpus(folders: list[Path]) -> Iterator[Case]:
    """Every `[[case]]` of the .toml files in these folders (or of these files), in order."""
    for folder in folders:
        files = sorted(folder.glob("*.toml")) if folder.is_dir() else [folder]
        for file in files:
            text = file.read_text(encoding="utf-8")
            entries = tomllib.loads(text).get("case", [])
            heads = enumerate(text.splitlines(), 1)
            lines = [n for n, line in heads if line.startswith("[[case]]")]
            for line, entry in zip(lines, entries, strict=True):
                yield read_case(file, line, entry)


def judge(case: Case, reply: dict[str, Any], codes: bool, report: Report) -> None:
    """Compares one answer with what the corpus says."""

    def wrong(what: str, expected: Any, got: Any) -> None:
        report.counts["wrong"] += 1
        where = {"file": case.file, "line": case.line, "expression": case.expression}
        report.wrong.append(
            {**where, "what": what, "expected": expected, "got": got, "why": case.why}
        )

    if "unsupported" in reply:
        report.counts["unsupported"] += case.n_rows
        return
    error = reply.get("error")
    if case.error is not None:
        found = (error.get("code"), error.get("column")) if error else None
        if error is None or (codes and found != case.error):
            wrong("error", list(case.error), list(found) if found else "accepted")
        else:
            report.counts["right"] += 1
        return
    verdicts = reply.get("verdicts", [])
    if error is None and len(verdicts) != len(case.paths):
        raise EngineError(f"{len(verdicts)} verdicts for {len(case.paths)} paths: {reply}")
    for n, (path, expected) in enumerate(zip(case.paths, case.verdicts, strict=True)):
        got = f"refused: {error}" if error is not None else verdicts[n]
        if got is expected:
            report.counts["right"] += 1
        else:
            wrong(path, expected, got)


def run(cases: list[Case], engine: Engine, codes: bool = False) -> Report:
    """Asks all of these."""
    report = Report()
    for number, case in enumerate(cases, 1):
        reply = engine(case.request(number))
        if reply.get("id") != number:
            raise EngineError(f"request {number} was answered by {reply}")
        judge(case, reply, codes, report)
    return report


def run_command(command: str, cases: list[Case], codes: bool) -> Report:
    """Asks a program."""
    with subprocess.Popen(
        shlex.split(command),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        encoding="utf-8",
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        to_engine, from_engine = process.stdin, process.stdout

        def ask(request: dict[str, Any]) -> dict[str, Any]:
            try:
                to_engine.write(json.dumps(request) + "\n")
                to_engine.flush()
                reply = json.loads(from_engine.readline())
            except (BrokenPipeError, json.JSONDecodeError) as error:
                process.kill()
                raise EngineError(f"no answer to {request}: {error}") from error
            if not isinstance(reply, dict):
                process.kill()
                raise EngineError(f"no object: {reply}")
            return reply

        return run(cases, ask, codes)


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="asks an engine every row of the corpus")
    parser.add_argument("--engine", required=True, help="a command that answers JSON lines")
    parser.add_argument(
        "--codes", action="store_true", help="also compare error codes and columns"
    )
    parser.add_argument("--standard", action="store_true", help="leave out our extensions")
    parser.add_argument("--json", action="store_true", help="print wrong rows as JSON lines")
    parser.add_argument("corpus", nargs="*", type=Path, help="files or folders (default: all)")
    options = parser.parse_args()
    folders = options.corpus or [FOLDER / "corpus", FOLDER / "dialects"]
    cases = [case for case in read_corpus(folders) if not (options.standard and case.extension)]
    try:
        report = run_command(options.engine, cases, options.codes)
    except (EngineError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    for row in report.wrong:
        if options.json:
            print(json.dumps(row, ensure_ascii=False))
        else:
            place = f"{row['file']}:{row['line']}: {row['expression']}"
            print(f"{place}: {row['what']}: expected {row['expected']}, got {row['got']}")
            if row["why"]:
                print(f"    because {row['why']}")
    counts = report.counts
    summary = (
        f"{counts['right']} right, {counts['wrong']} wrong, {counts['unsupported']} not supported"
    )
    print(summary, file=sys.stderr if options.json else sys.stdout)
    return 1 if counts["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
