"""Damaged scenes and files, and scenes that are absurd: each ends in a picture or a message.

The whole (`big`) runs under the sanitizers, a slice of it in every test run. A group alone:
`python -m tests.hostile.sweep GROUP`.
"""

from __future__ import annotations

import contextlib
import itertools
import random
from pathlib import Path

import pytest

import lightsieve
from tests.conftest import ROOT
from tests.hostile import absurdities, damage
from tests.hostile.mutation import mutate_bytes, mutate_text
from tests.hostile.running import TOOL, judge, run_command, run_tool
from tests.hostile.sweep import PATIENCE, QUICK, SECONDS, Case, cases_of, run_case, sweep

GROUPS = [function.__name__ for function in absurdities.GROUPS]
EVERY = 40
"""One case of so many is in the slice of every day."""


def ends_well(scene: Path, **settings: object) -> None:
    """Renders in this process: a crash ends the tests, a hang their time."""
    with contextlib.suppress(lightsieve.LightsieveError):
        lightsieve.render(scene, threads=2, output=scene.parent, **settings)  # type: ignore[arg-type]


@pytest.mark.parametrize("number", range(12))
def test_a_damaged_scene(number: int, tmp_path: Path) -> None:
    texts = damage.originals()
    rng = random.Random(f"day {number}")
    text = mutate_text(texts[number * 17 % len(texts)], rng)
    ends_well(absurdities.write(text, tmp_path / "scene.ass"), spp=1, size=(8, 6))


@pytest.mark.parametrize("number", range(3))
def test_damaged_pictures_and_volumes(number: int, tmp_path: Path) -> None:
    for name, text in damage.files(tmp_path, n_pictures=6, n_volumes=1, seed=100 + number):
        ends_well(absurdities.write(text, tmp_path / f"{name}.ass"), spp=1, size=(8, 6))


@pytest.mark.parametrize("group", [group for group in GROUPS if group != "amounts"])
def test_an_absurd_scene(group: str, tmp_path: Path) -> None:
    cases = itertools.islice(absurdities.absurdities(group).values(), 7, None, EVERY)
    for number, text in enumerate(cases):
        folder = tmp_path / str(number)
        folder.mkdir()
        ends_well(absurdities.write(text, folder / "scene.ass"), spp=1, size=(8, 6))


def test_there_are_enough_of_them() -> None:
    assert damage.N_SCENES >= 500
    assert damage.N_PICTURES + damage.N_VOLUMES >= 200
    assert sum(len(absurdities.absurdities(group)) for group in GROUPS) >= 200


def test_damage_is_the_same_every_time_and_does_something() -> None:
    scenes = dict(damage.scenes(100))
    assert scenes == dict(damage.scenes(100))
    texts = damage.originals()
    changed = [text != texts[number % len(texts)] for number, text in enumerate(scenes.values())]
    assert sum(changed) > 90
    data = bytes(range(256)) * 8
    damaged = {mutate_bytes(data, random.Random(number)) for number in range(100)}
    assert len(damaged) > 90


@pytest.mark.parametrize(
    ("code", "err", "how"),
    [
        (0, "", "picture"),
        (0, "warning[param-range]: a is 3", "picture"),
        (1, "x.ass:1:1: error[bad-value]: no number", "message"),
        (1, "", "finding"),
        (-11, "", "finding"),
        (99, "==1==ERROR: LeakSanitizer: detected memory leaks", "finding"),
        (0, "x.cpp:3:4: runtime error: signed integer overflow", "finding"),
    ],
)
def test_endings_are_judged(code: int, err: str, how: str) -> None:
    assert judge(code, "", err).how == how


def test_what_never_ends_is_a_finding_unless_it_renders(tmp_path: Path) -> None:
    sleeps = tmp_path / "sleeps"
    sleeps.write_text("#!/bin/sh\nsleep 100\n")
    sleeps.chmod(0o700)
    assert run_tool(cwd=tmp_path, seconds=0.2, tool=sleeps).how == "finding"
    sleeps.write_text("#!/bin/sh\necho 1 shapes, 2 lights, 3 layers\nsleep 100\n")
    assert run_tool(cwd=tmp_path, seconds=2, tool=sleeps).how == "began"
    # The same for few pixels is a finding.
    case = Case("slow", "", QUICK)
    assert run_case(case, tmp_path, sleeps, 2).how == "finding"


@pytest.fixture(scope="module")
def tool() -> Path:
    for command in (
        ("cmake", "--preset", "sanitize"),
        ("cmake", "--build", "--preset", "sanitize", "--target", "lightsieve_tool"),
    ):
        done = run_command(*command, cwd=ROOT)
        assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]
    return TOOL


@pytest.mark.big
def test_the_sanitizers_watch(tool: Path, tmp_path: Path) -> None:
    """With hardly any memory allowed, even a good scene is a finding."""
    scene = absurdities.write(absurdities.scene(absurdities.BALL), tmp_path / "good.ass")
    assert run_tool("render", scene, cwd=tmp_path, seconds=120, tool=tool).how == "picture"
    starved = run_tool("render", scene, cwd=tmp_path, seconds=120, tool=tool, memory_mb=1)
    assert starved.how == "finding"


@pytest.mark.big
@pytest.mark.parametrize("group", ["damaged-scenes", "damaged-files", *GROUPS])
def test_every_case_ends_in_a_picture_or_a_message(tool: Path, group: str, tmp_path: Path) -> None:
    seconds = SECONDS * PATIENCE.get(group, 1)
    report = sweep(cases_of(group, tmp_path), tmp_path, tool=tool, seconds=seconds)
    assert not report.findings, str(report)
