"""Runs the sanitized `lightsieve_tool` on one file, and judges how that ends."""

from __future__ import annotations

import os
import re
import signal
import subprocess
from dataclasses import dataclass
from pathlib import Path

from tests.conftest import ROOT

BUILD = ROOT / "build/sanitize"
TOOL = BUILD / "src/tool/lightsieve_tool"

MEMORY_MB = 6000

FINDING = 99
"""Exit code when a sanitizer has something to say: bad scenes end with 1."""

SETTINGS: dict[str, dict[str, object]] = {
    "ASAN_OPTIONS": {
        "detect_leaks": 1,
        # OpenImageIO 2.4 frees its texture system with the size of its base class.
        "new_delete_type_mismatch": 0,
        "exitcode": FINDING,
        "quarantine_size_mb": 16,
    },
    "LSAN_OPTIONS": {
        "suppressions": ROOT / "tests/hostile/leaks.txt",
        "print_suppressions": 0,
        "exitcode": FINDING,
    },
    "UBSAN_OPTIONS": {"print_stacktrace": 1, "exitcode": FINDING},
}

REPORT = re.compile(r"Sanitizer|runtime error:|LIGHTSIEVE_ASSERT|terminate called")
SAID_SOMETHING = re.compile(r"error\[[a-z0-9-]+\]: ")
BEGAN = re.compile(r"^\d+ shapes, \d+ lights, \d+ layers$", re.MULTILINE)
"""The line that the tool prints when the scene is compiled and rendering begins."""


@dataclass(frozen=True)
class Ending:
    """How a run ended."""

    how: str
    """`picture`, `message`, `began` (rendering when its time was up) or `finding`."""
    detail: str


def environment(memory_mb: int) -> dict[str, str]:
    """This process's environment with the sanitizers' settings."""
    settings = {
        name: ":".join(f"{key}={value}" for key, value in options.items())
        for name, options in SETTINGS.items()
    }
    settings["ASAN_OPTIONS"] += f":hard_rss_limit_mb={memory_mb}"
    return {**os.environ, **settings}


def run_command(*command: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Runs a command that is trusted."""
    return subprocess.run(
        [str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False
    )


def run_tool(
    *arguments: str | Path,
    cwd: Path,
    seconds: float,
    tool: Path = TOOL,
    memory_mb: int = MEMORY_MB,
) -> Ending:
    """Runs the tool; a run that takes longer than `seconds` is ended.

    Args:
        arguments: Of the tool.
        cwd: Where it runs; relative outputs go there.
        seconds: The limit on time.
        tool: Another build than the sanitized one.
        memory_mb: What would take more is a finding.
    """
    process = subprocess.Popen(
        [str(tool), *map(str, arguments)],
        cwd=cwd,
        env=environment(memory_mb),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        out, err = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        return Ending("began" if BEGAN.search(out) else "finding", "its time was up\n" + err)
    return judge(process.returncode, out, err)


def judge(code: int, out: str, err: str) -> Ending:
    """What an exit code and the texts mean."""
    if code not in (0, 1) or REPORT.search(err):
        return Ending("finding", f"exit code {code}\n{err[-6000:]}")
    if code == 1 and not SAID_SOMETHING.search(err):
        return Ending("finding", f"an error without a message\n{out}{err}")
    return Ending("picture" if code == 0 else "message", err)
