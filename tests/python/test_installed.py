"""What the package needs beside its modules is there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import lightsieve._core


@pytest.mark.parametrize("program", ["lightsieve_vdb_reader", "lightsieve_image_reader"])
def test_the_programs_that_read_files_lie_beside_the_module(program: str) -> None:
    assert os.access(Path(lightsieve._core.__file__).parent / program, os.X_OK)
