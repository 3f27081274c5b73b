"""What the pages of documentation show is what the program prints, to the letter.

A line `$ lightsieve lpe ...` in a code block is run, and `check` of a scene of examples/aovs; the
lines after it, up to the next command or the end of the block, must be what it says, but for the
memory of this machine.
LIGHTSIEVE_UPDATE=1 rewrites the pages: read the difference.
"""

from __future__ import annotations

import os
import shlex
from pathlib import Path

import pytest

from tests.conftest import ROOT, Run

SCENES = ROOT / "examples/aovs"
# What `check` foretells depends on the machine: pages leave it out.
OF_THE_MACHINE = ("memory  ", "files  ")
PAGES = ["README.md", "docs/aov-setups.md", "docs/dialects.md", "docs/proofs.md"]


def is_ours(line: str) -> bool:
    """Is it a command that can be run here?"""
    words = shlex.split(line)[2:]
    return words[0] == "lpe" or (words[0] == "check" and (SCENES / words[1]).is_file())


def expected_page(page: str, run: Run) -> str:
    """The page with every command's output as it is now."""
    out: list[str] = []
    in_block = in_output = False
    for line in page.splitlines():
        if line.startswith("```"):
            in_block, in_output = not in_block, False
        is_command = line.startswith("$ lightsieve ")
        if is_command:
            in_output = False
        if in_block and is_command and is_ours(line):
            done = run(*shlex.split(line)[2:])
            assert done.code in (0, 1), done.err
            said = (done.err + done.out).splitlines()
            out += [line, *(one for one in said if not one.startswith(OF_THE_MACHINE))]
            in_output = True
        elif not in_output:
            out.append(line)
    return "\n".join(out) + "\n"


@pytest.mark.parametrize("name", PAGES)
def test_page(name: str, run: Run, tmp_path: Path) -> None:
    for scene in SCENES.glob("*.ass"):
        (tmp_path / scene.name).write_text(scene.read_text())
    page = ROOT / name
    expected = expected_page(page.read_text(), run)
    if os.environ.get("LIGHTSIEVE_UPDATE"):
        page.write_text(expected)
    assert page.read_text() == expected
    assert expected.count("\n$ lightsieve lpe ") > 1


def test_every_set_up_is_on_the_page() -> None:
    page = (ROOT / "docs/aov-setups.md").read_text()
    scenes = [scene.name for scene in SCENES.glob("*.ass")]
    assert len(scenes) == 5
    assert [name for name in scenes if f"check {name}" not in page] == []
