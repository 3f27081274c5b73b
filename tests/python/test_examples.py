"""The programs of examples/ run on a scene of the tests."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.conftest import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example_writes_its_picture(example: Path, tmp_path: Path) -> None:
    scene, target = ROOT / "tests/scenes/still.ass", tmp_path / "picture.png"
    done = subprocess.run(
        [sys.executable, str(example), str(scene), str(target)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "RGBA_key, RGBA_default" in done.stdout
    with Image.open(target) as picture:
        # The key light is dim and blue now, and the other one is weak: no red ball is left.
        red, _, blue = np.asarray(picture).max(axis=(0, 1))
        assert blue > red / 2
