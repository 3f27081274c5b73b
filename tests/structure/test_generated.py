"""Pages and stubs that follow from the code are up to date."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path


def check(root: Path, *command: str | Path) -> None:
    environment = {**os.environ, "LIGHTSIEVE_BIN": str(Path(sys.executable).parent)}
    done = subprocess.run(
        [str(part) for part in command],
        cwd=root,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_generated_pages_are_up_to_date(root: Path) -> None:
    check(root, sys.executable, "tools/generate_docs.py", "--check")


def test_type_stubs_are_up_to_date(root: Path) -> None:
    check(root, "tools/stubs", "--check")
