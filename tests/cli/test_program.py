"""What all commands have in common: help, exit codes, streams."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT, Run

COMMANDS = sorted(
    tuple(p.stem.rpartition("_")[::2] if "_" in p.stem else (p.stem,))
    for p in (ROOT / "python/lightsieve/cli").glob("[a-z]*.py")
    if p.stem != "main"
)


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_every_command_has_help_with_an_example_and_json(run: Run, words: tuple[str, ...]) -> None:
    done = run(*words, "--help")
    assert done.code == 0
    assert f"Example: lightsieve {' '.join(words)}" in done.out
    assert "--json" in done.out


def test_without_a_command_it_prints_help(run: Run) -> None:
    done = run()
    assert done.code == 2
    assert "Usage: " in done.err


def test_version(run: Run) -> None:
    done = run("--version")
    assert done.code == 0
    assert done.out.startswith("lightsieve 0.")


@pytest.mark.parametrize(
    "arguments",
    [
        ("bake",),
        ("lpe", "list", "--colour"),
        ("lpe", "match", "C.*"),
        ("lpe", "list", "--lpe-table", "arnold6"),
        ("render",),
        ("render", "a.ass", "-i", "a.ass"),
        ("render", "a.ass", "--size", "640"),
        ("render", "a.ass", "--region", "9,0,3,4"),
        ("render", "a.ass", "--aa", "0"),
        ("render", "a.ass", "--lpe", "caustics"),
        ("render", "a.ass", "--lpe", "x CDL", "--lpe", "x CSL"),
    ],
    ids=" ".join,
)
def test_wrong_usage_exits_2_and_says_why(run: Run, arguments: tuple[str, ...]) -> None:
    done = run(*arguments)
    assert done.code == 2
    assert done.out == ""
    assert "Error" in done.err


def test_a_reader_that_leaves_early_is_no_bug(tmp_path: Path) -> None:
    command = f"{sys.executable} -m lightsieve lpe list | head -1"
    done = subprocess.run(
        ["bash", "-c", command], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.stdout.startswith("RGBA")
    assert done.stderr == ""


def test_a_bug_exits_3_and_asks_for_a_report(tmp_path: Path) -> None:
    """A command that fails in a way nobody foresaw."""
    code = (
        "from lightsieve import lpe\n"
        "def broken(table): raise ZeroDivisionError('unforeseen')\n"
        "lpe.builtins = broken\n"
        "import sys; sys.argv = ['lightsieve', 'lpe', 'list']\n"
        "from lightsieve.cli.main import main\n"
        "main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 3
    assert "unforeseen" in done.stderr
    assert "please report this" in done.stderr


def test_an_abort_of_the_compiled_part_exits_3(tmp_path: Path) -> None:
    code = "from lightsieve import _lpe; _lpe.exit_3_on_bug(); import os; os.abort()"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, check=False)
    assert done.returncode == 3


def test_the_engine_loads_neither_the_renderer_nor_other_libraries() -> None:
    """`lightsieve lpe` starts quickly because of this; no clock can test it on a busy machine."""
    code = (
        "import sys, lightsieve\n"
        "heavy = {'numpy', 'typer', 'lightsieve._core'}\n"
        "assert not (heavy | {'lightsieve._lpe'}) & set(sys.modules)\n"
        "lightsieve.lpe.match('C.*', 'C L')\n"
        "assert not heavy & set(sys.modules)\n"
        "import re\n"
        "maps = open('/proc/self/maps').read()\n"
        "print(*sorted(set(re.findall(r'lib(?:tbb|OpenEXR|OpenImageIO|embree|fmt)', maps))))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


def test_commands_of_the_engine_load_no_renderer() -> None:
    code = (
        "import sys; from lightsieve.cli.main import build_app; build_app(pretty=False)\n"
        "print([m for m in sys.modules if m in ('numpy', 'rich', 'PIL', 'lightsieve._core')])\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
