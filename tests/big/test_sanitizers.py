"""The C++ unit tests and whole renders under the address and undefined-behaviour sanitizers."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from tests.conftest import ROOT

pytestmark = pytest.mark.big

BUILD = ROOT / "build/sanitize"
SCENES = sorted([*(ROOT / "tests/broken").glob("*.ass"), *(ROOT / "tests/scenes").glob("*.ass")])


def run(
    *command: str | Path, cwd: Path = ROOT, environment: Mapping[str, str] = os.environ
) -> subprocess.CompletedProcess[str]:
    options = {
        # What libraries keep until the end of the process is not for us to free.
        "detect_leaks": 0,
        # OpenImageIO 2.4 frees its texture system with the size of its base class: harmless, and
        # not ours to mend.
        "new_delete_type_mismatch": 0,
        # Bad scenes end with 1: what a sanitizer finds must not look the same.
        "exitcode": 99,
    }
    setting = ":".join(f"{key}={value}" for key, value in options.items())
    return subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env={**environment, "ASAN_OPTIONS": setting, "UBSAN_OPTIONS": "print_stacktrace=1"},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture(scope="module")
def build() -> Path:
    for command in (
        ("cmake", "--preset", "sanitize"),
        ("cmake", "--build", "--preset", "sanitize"),
    ):
        done = run(*command)
        assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]
    return BUILD


def test_unit_tests(build: Path) -> None:
    done = run("ctest", "--test-dir", build, "--output-on-failure")
    assert done.returncode == 0, done.stdout[-8000:]


def test_damaged_volumes(build: Path) -> None:
    """A thousand flipped bits, in files and in what the reader says of one."""
    environment = {**os.environ, "LIGHTSIEVE_DAMAGE_ROUNDS": "20"}
    done = run(build / "src/io_test", "--gtest_filter=Damage.*", environment=environment)
    assert done.returncode == 0, done.stdout[-8000:]


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.stem)
def test_renders(build: Path, scene: Path, tmp_path: Path) -> None:
    tool = build / "src/tool/lightsieve_tool"
    picture = tmp_path / "picture.exr"
    done = run(tool, "render", scene, "-o", picture, "--spp", "4", "--size", "32x24", cwd=tmp_path)
    assert done.returncode in (0, 1), done.stderr[-8000:]
    for report in ("AddressSanitizer", "runtime error"):
        assert report not in done.stderr, done.stderr[-8000:]
