"""Runs many cases and gathers what is wrong with how they end.

python -m tests.hostile.sweep GROUP... [--tool PATH] [--seconds N]
"""

from __future__ import annotations

import argparse
import collections
import itertools
import os
import tempfile
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from tests.hostile import absurdities, damage
from tests.hostile.running import TOOL, Ending, run_tool

SECONDS = 120.0
"""For one case, with sanitizers, on a machine that does other things as well."""

PATIENCE = {"amounts": 10.0}
"""Groups whose cases may take so many times as long."""

QUICK = ("--spp", "1", "--size", "8x6", "--threads", "2")
"""Options for scenes whose size and samples are not the point."""


@dataclass(frozen=True)
class Case:
    """A scene to render."""

    name: str
    text: str
    options: tuple[str, ...] = ()


@dataclass
class Report:
    """How the cases of a sweep ended."""

    counts: collections.Counter[str] = field(default_factory=collections.Counter)
    findings: dict[str, str] = field(default_factory=dict)

    def __str__(self) -> str:
        lines = [", ".join(f"{n} {how}" for how, n in sorted(self.counts.items()))]
        lines += [f"== {name}\n{detail}" for name, detail in self.findings.items()]
        return "\n".join(lines)


def run_case(case: Case, folder: Path, tool: Path, seconds: float) -> Ending:
    """Renders a case in a folder of its own."""
    with tempfile.TemporaryDirectory(dir=folder) as name:
        place = Path(name)
        scene = absurdities.write(case.text, place / "scene.ass")
        ending = run_tool("render", scene, *case.options, cwd=place, seconds=seconds, tool=tool)
        if ending.how == "began" and "--size" in case.options:
            # Few pixels, and still too slow: much light to follow, or a path without an end?
            one = ("--spp", "1", "--size", "1x1", "--threads", "1")
            ending = run_tool("render", scene, *one, cwd=place, seconds=seconds, tool=tool)
            if ending.how == "began":
                return Ending("finding", "one sample takes for ever")
        return ending


def sweep(
    cases: Iterable[Case], folder: Path, *, tool: Path = TOOL, seconds: float = SECONDS
) -> Report:
    """Runs all cases, as many at a time as there are processors."""
    report = Report()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        tasks = [(case, pool.submit(run_case, case, folder, tool, seconds)) for case in cases]
        for case, task in tasks:
            ending = task.result()
            report.counts[ending.how] += 1
            if ending.how == "finding":
                report.findings[case.name] = ending.detail
    return report


def cases_of(group: str, folder: Path) -> Iterator[Case]:
    """The cases of a group: one of absurdities, `scenes` or `files` that are damaged."""
    if group == "damaged-scenes":
        for name, text in damage.scenes():
            yield Case(name, text, QUICK)
    elif group == "damaged-files":
        for name, text in damage.files(folder):
            yield Case(name, text, QUICK)
    else:
        for name, text in absurdities.absurdities(group).items():
            yield Case(name, text)


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("groups", nargs="+")
    parser.add_argument("--tool", type=Path, default=TOOL)
    parser.add_argument("--seconds", type=float, default=SECONDS)
    parser.add_argument("--first", type=int, default=None, help="only so many cases of each group")
    given = parser.parse_args()
    for group in given.groups:
        with tempfile.TemporaryDirectory() as folder:
            cases = itertools.islice(cases_of(group, Path(folder)), given.first)
            seconds = given.seconds * PATIENCE.get(group, 1)
            report = sweep(cases, Path(folder), tool=given.tool.resolve(), seconds=seconds)
            print(group, report, flush=True)


if __name__ == "__main__":
    main()
