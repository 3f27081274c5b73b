"""What `lightsieve check` says of each broken scene of tests/broken, to the letter.

NAME.txt beside NAME.ass has the exit code and standard error. LIGHTSIEVE_UPDATE=1 rewrites them:
read the difference before you commit it, people will read every line at a bad moment.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT

SCENES = sorted((ROOT / "tests/broken").glob("*.ass"))


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.stem)
def test_broken_scene(scene: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "lightsieve", "check", scene.name],
        cwd=scene.parent,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    said = f"exit {done.returncode}\n{done.stderr}"
    expected = scene.with_suffix(".txt")
    if os.environ.get("LIGHTSIEVE_UPDATE"):
        expected.write_text(said)
    assert said == expected.read_text()


def test_every_expectation_has_a_scene() -> None:
    texts = {p.stem for p in (ROOT / "tests/broken").glob("*.txt")}
    assert texts == {p.stem for p in SCENES}
