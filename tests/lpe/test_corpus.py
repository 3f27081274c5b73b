"""The conformance corpus: what it holds, that the reference engine agrees, that mistakes show."""

from __future__ import annotations

import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from tests.lpe import lightsieve_engine, reference_engine
from tests.lpe.reference_parser import Fault
from tests.lpe.run_corpus import FOLDER, Case, judge, read_corpus, run
from tests.lpe.run_corpus import Report as RunReport

CASES = list(read_corpus([FOLDER / "corpus", FOLDER / "dialects"]))
ASKED = [case for case in CASES if case.file.startswith("corpus/")]
BY_HAND = [case for case in ASKED if case.by_hand]
REFERENCE = [sys.executable, "-m", "tests.lpe.reference_engine"]


def test_it_is_large_and_explained() -> None:
    rows = sum(case.n_rows for case in CASES)
    explained = [case for case in CASES if case.by_hand and case.why]
    assert len(CASES) >= 2000
    assert rows >= 8000
    assert len(explained) >= 300
    # A reason is not one phrase for all.
    assert len({case.why for case in explained}) >= 0.95 * len(explained)
    dialects = Counter(case.dialect for case in CASES)
    assert set(dialects) >= {"arnold", "osl", "moonray", "renderman", "karma"}


def test_verdicts_are_balanced() -> None:
    verdicts = Counter(verdict for case in ASKED for verdict in case.verdicts)
    assert 0.4 < verdicts[True] / verdicts.total() < 0.6
    assert sum(case.error is not None for case in ASKED) >= 300


def test_no_path_has_two_verdicts() -> None:
    said: dict[tuple[str, str, str, bool, str], bool] = {}
    for case in CASES:
        for path, verdict in zip(case.paths, case.verdicts, strict=True):
            key = (case.dialect, case.notation, case.expression, case.standard, path)
            assert said.setdefault(key, verdict) == verdict, key


def test_the_reference_engine_agrees_on_every_row() -> None:
    report = run(ASKED, reference_engine.answer, codes=True)
    assert report.wrong == []
    assert report.counts["unsupported"] == 0


def test_lightsieve_agrees_on_every_row() -> None:
    report = run(ASKED, lightsieve_engine.answer, codes=True)
    assert report.wrong == []
    assert report.counts["unsupported"] == 0


def first_wrong(fault: Fault) -> list[dict[str, Any]]:
    """What the first row that notices the fault says; nothing if none does."""
    for case in BY_HAND:
        report = RunReport()
        judge(case, reference_engine.answer(case.request(1), [fault]), False, report)
        if report.wrong:
            return report.wrong
    return []


@pytest.mark.parametrize("fault", list(Fault), ids=lambda fault: fault.name.lower())
def test_a_seeded_mistake_is_caught_by_a_row_written_by_hand(fault: Fault) -> None:
    assert first_wrong(fault), f"no row notices that {fault.value}"


def test_there_are_twenty_seeded_mistakes_and_more() -> None:
    assert len(Fault) >= 20


def test_generated_rows_are_in_step_with_their_script(root: Path) -> None:
    command = [sys.executable, str(root / "tools/make_corpus.py"), "--check"]
    assert subprocess.run(command, check=False).returncode == 0, "run tools/make_corpus.py"


def run_corpus(root: Path, engine: list[str], *arguments: str) -> subprocess.CompletedProcess[str]:
    script = root / "tests/lpe/run_corpus.py"
    traps = root / "tests/lpe/corpus/traps.toml"
    command = [sys.executable, str(script), "--engine", " ".join(engine), *arguments, str(traps)]
    return subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)


def test_the_runner_asks_a_program(root: Path) -> None:
    done = run_corpus(root, REFERENCE, "--codes")
    assert (done.returncode, done.stderr) == (0, "")
    rows = sum(case.n_rows for case in ASKED if case.file == "corpus/traps.toml")
    assert done.stdout == f"{rows} right, 0 wrong, 0 not supported\n"


def test_the_runner_reports_what_is_wrong_and_why(root: Path) -> None:
    done = run_corpus(root, [*REFERENCE, "--fault", "label-prefix"])
    assert done.returncode == 1
    assert "C<RS'coat'>L: C RS'coat2' L: expected False, got True\n    because" in done.stdout


def test_the_runner_says_when_an_engine_dies(root: Path) -> None:
    done = run_corpus(root, [sys.executable, "-c", "pass"])
    assert done.returncode == 2
    assert done.stderr.startswith("error: no answer to")


def test_a_standard_engine_can_be_asked_without_extensions(root: Path) -> None:
    asked = [case for case in ASKED if not case.extension]
    refused = run(asked, lambda request: reference_engine.answer({**request, "standard": True}))
    named = {row["expression"] for row in refused.wrong}
    # All that a standard engine cannot read is marked; nothing else is.
    assert named == set()
    marked: list[Case] = [case for case in ASKED if case.extension]
    for case in marked:
        assert "error" in reference_engine.answer({**case.request(1), "standard": True})
