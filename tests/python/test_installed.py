"""What the package needs beside its modules is there."""

from __future__ import annotations

import os
from pathlib import Path

import lightsieve._core


def test_the_reader_of_volumes_lies_beside_the_module() -> None:
    reader = Path(lightsieve._core.__file__).parent / "lightsieve_vdb_reader"
    assert os.access(reader, os.X_OK)
