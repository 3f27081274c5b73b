"""The fuzzers of fuzz/, a minute each, from their corpora."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.conftest import ROOT

pytestmark = pytest.mark.big

BUILD = ROOT / "build/fuzz"
COMPILER = "clang++-16"
PACKAGES = ("clang-16", "libclang-rt-16-dev")
DICTIONARIES = {"ass": "ass.dict", "packed": "ass.dict"}
TARGETS = sorted(path.stem.removesuffix("_fuzz") for path in (ROOT / "fuzz").glob("*_fuzz.cpp"))


def run(*command: str | Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(part) for part in command],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )


def install_compiler() -> None:
    """Only these tests need it."""
    if shutil.which("apt-get") is None:
        return
    as_root = [] if os.geteuid() == 0 else ["sudo", "-n"]
    apt = (*as_root, "apt-get", "install", "-y", "-qq", "--no-install-recommends", *PACKAGES)
    run(*apt, DEBIAN_FRONTEND="noninteractive")


@pytest.fixture(scope="module")
def build() -> Path:
    if shutil.which(COMPILER) is None:
        install_compiler()
    if shutil.which(COMPILER) is None:
        pytest.skip(f"libFuzzer needs {' and '.join(PACKAGES)}")
    for command in (
        ("cmake", "-S", "fuzz", "-B", BUILD, "-G", "Ninja", f"-DCMAKE_CXX_COMPILER={COMPILER}"),
        ("cmake", "--build", BUILD),
    ):
        done = run(*command)
        assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-4000:]
    return BUILD


@pytest.mark.parametrize("target", TARGETS)
def test_a_minute_without_a_finding(build: Path, target: str, tmp_path: Path) -> None:
    done = run(
        build / f"{target}_fuzz",
        f"-dict=fuzz/{DICTIONARIES.get(target, 'lpe.dict')}",
        f"-max_len={2000 if target == 'ass' else 200}",
        "-timeout=30",
        "-max_total_time=60",
        f"-artifact_prefix={tmp_path}/",
        tmp_path,
        ROOT / "fuzz/corpus" / target,
    )
    assert done.returncode == 0, done.stderr[-8000:]
