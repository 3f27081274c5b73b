"""Small pictures are as they were; and the test of that: it does not cry wolf, and it sees 2 %."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.golden.golden import (
    BLOCK_LIMIT,
    FALSE_ALARM,
    STORED,
    TABLE,
    TESTED_RUNS,
    TESTED_SEEDS,
    WHOLE_LIMIT,
    runs,
    scores,
    threshold,
)

pytestmark = pytest.mark.big

RULE = "tests/golden/README.md says when `python -m tests.golden.golden --write NAME` is allowed"


@pytest.mark.parametrize("name", list(TABLE))
def test_the_picture_is_as_stored(name: str, tmp_path: Path) -> None:
    alarm = scores(name, runs(name, TESTED_SEEDS, tmp_path)).alarm()
    assert alarm <= 1, f"{name} has changed: z is {alarm:.2f} of what is allowed; {RULE}"


def test_every_scene_is_stored_and_nothing_else() -> None:
    assert {path.stem for path in STORED.iterdir()} == set(TABLE)
    assert sum(path.stat().st_size for path in STORED.iterdir()) < 500_000


@pytest.mark.parametrize(
    ("name", "brighter"),
    [
        ("bulb", "probe.intensity=51"),
        ("slide", "lamp.intensity=61.2"),
        ("window", "probe.intensity=61.2"),
        ("daylight", "probe.intensity=1.02"),
        ("mesh", "lamp.intensity=204"),
        ("lambert", "key.intensity=61.2"),
        ("plastic", "key.intensity=61.2"),
        ("hair", "lamp.intensity=204"),
        ("haze", "key.intensity=102"),
    ],
)
def test_a_light_that_is_two_percent_brighter_is_seen(
    name: str, brighter: str, tmp_path: Path
) -> None:
    assert scores(name, runs(name, TESTED_SEEDS, tmp_path, [brighter])).alarm() > 1


@pytest.mark.parametrize("name", ["plastic", "bulb", "haze", "clouds", "motion"])
def test_other_random_numbers_are_no_change(name: str, tmp_path: Path) -> None:
    """Scores of ten other sets of seeds are spread as a normal variable, and none is an alarm."""
    sets_of_seeds = [range(i, i + TESTED_RUNS) for i in range(5000, 6000, 100)]
    found = [scores(name, runs(name, seeds, tmp_path)) for seeds in sets_of_seeds]
    assert max(each.alarm() for each in found) <= 1
    z = np.array([each.blocks for each in found])
    noisy = z[:, np.abs(z).max(axis=0) > 0]
    # The larger one of two variances is used, which makes scores smaller; the stored mean's own
    # error is the same in all ten, which may make all of them larger.
    assert 0.8 < np.sqrt((noisy**2).mean()) < 1.15
    assert (np.abs(noisy) > 2.576).mean() < 0.03


def test_the_limit_is_that_of_students_distribution() -> None:
    # One test with probability 0.5e-4, both tails: tabulated t(0.999975, 63) is 4.36.
    assert threshold(1) == pytest.approx(4.36, abs=0.02)
    assert BLOCK_LIMIT > WHOLE_LIMIT > threshold(1)
    assert FALSE_ALARM <= 1e-4
