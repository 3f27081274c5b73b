#!/usr/bin/env python3
"""Renders every .ass scene below a folder with the sanitized build, and prints a table of what was found.

tools/sanitize_scenes.py FOLDER [--sanitized TOOL] [--release TOOL]

Each scene is checked, rendered with two threads into a small picture (both with leak detection), and rendered as it
is with one sample a pixel. Of the last the peak memory is compared with the release build's: leak detection, which
takes memory of its own at the end, is off there; freed memory is kept for detection up to 1 MB and call stacks two
calls deep: neither is the program's.

Both programs are lightsieve_tool: `cmake --preset sanitize && cmake --build --preset sanitize --target lightsieve_tool`,
and the same with `cpp` for `sanitize`. Files that other files include or read are found by having no outputs: they are
only checked. Exit code 1: a finding, or more than twice the memory.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOOL = "src/tool/lightsieve_tool"
FINDING = re.compile(r"Sanitizer|runtime error:|terminate called")
# OpenImageIO 2.4 frees its texture system with the size of its base class.
COMMON = "new_delete_type_mismatch=0:exitcode=99"
WITH_LEAKS = f"{COMMON}:detect_leaks=1"
LITTLE = "quarantine_size_mb=1:thread_local_quarantine_size_kb=64:malloc_context_size=2"
FOR_MEMORY = f"{COMMON}:detect_leaks=0:{LITTLE}"
SUPPRESSIONS = f"suppressions={ROOT}/tests/hostile/leaks.txt:print_suppressions=0"
MOST = 2.0


class Run:
    """A command that has ended: exit code, what it said, peak memory in MB."""

    def __init__(self, asan: str, tool: pathlib.Path, *arguments: object) -> None:
        settings = {
            "ASAN_OPTIONS": asan,
            "LSAN_OPTIONS": SUPPRESSIONS,
            "UBSAN_OPTIONS": "print_stacktrace=1",
        }
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile("w+") as said:
            process = subprocess.Popen(
                [str(tool), *map(str, arguments)],
                cwd=folder,
                env={**os.environ, **settings},
                stdout=said,
                stderr=said,
            )
            _, status, usage = os.wait4(process.pid, 0)
            said.seek(0)
            self.text = said.read()
        self.code = os.waitstatus_to_exitcode(status)
        self.megabytes = usage.ru_maxrss / 1024

    @property
    def found(self) -> bool:
        """Whether a sanitizer said something, or it ended in another way than it may."""
        return self.code not in (0, 1) or FINDING.search(self.text) is not None


def examine(scene: pathlib.Path, sanitized: pathlib.Path, release: pathlib.Path) -> dict:
    small = ("--aa", 1, "--size", "40x30", "--threads", 2, "-o", "small.exr")
    whole = ("--aa", 1, "--threads", 1, "-o", "whole.exr")
    runs = {
        "check": Run(WITH_LEAKS, sanitized, "check", scene),
        "two threads": Run(WITH_LEAKS, sanitized, "render", scene, *small),
        "whole": Run(FOR_MEMORY, sanitized, "render", scene, *whole),
    }
    before = Run("", release, "render", scene, *whole)
    return {
        "findings": {name: run.text for name, run in runs.items() if run.found},
        "ends": "picture" if runs["whole"].code == 0 else "message",
        "release": before.megabytes,
        "sanitized": runs["whole"].megabytes,
    }


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--sanitized", type=pathlib.Path, default=ROOT / "build/sanitize" / TOOL)
    parser.add_argument("--release", type=pathlib.Path, default=ROOT / "build/release" / TOOL)
    given = parser.parse_args()
    scenes = sorted(given.folder.resolve().rglob("*.ass"))
    print("| scene | ends in | findings | release MB | sanitized MB | ratio |")
    print("|---|---|---|---|---|---|")
    bad = 0
    for scene in scenes:
        row = examine(scene, given.sanitized.resolve(), given.release.resolve())
        ratio = row["sanitized"] / row["release"]
        print(
            f"| {scene.relative_to(given.folder.resolve())} | {row['ends']} | {len(row['findings'])} "
            f"| {row['release']:.0f} | {row['sanitized']:.0f} | {ratio:.2f} |",
            flush=True,
        )
        for name, text in row["findings"].items():
            print(f"{scene}: {name}\n{text}", file=sys.stderr)
        bad += bool(row["findings"]) or ratio > MOST
    return 1 if bad or not scenes else 0


if __name__ == "__main__":
    sys.exit(main())
