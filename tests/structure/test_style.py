"""Formatting, lint, types, and habits that a machine can check."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

BIN = Path(sys.executable).parent


def run(*command: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(part) for part in command], cwd=cwd, capture_output=True, text=True, check=False
    )


def tracked_text_files(root: Path) -> list[Path]:
    """Files of ours that are text, whether git knows them yet or not."""
    listed = run("git", "ls-files", "--cached", "--others", "--exclude-standard", cwd=root)
    if listed.returncode != 0:
        pytest.skip("no git repository: an unpacked archive")
    files = [root / name for name in listed.stdout.splitlines()]
    suffixes = {
        ".h",
        ".cpp",
        ".def",
        ".in",
        ".py",
        ".pyi",
        ".md",
        ".toml",
        ".txt",
        ".cmake",
        ".ass",
        "",
    }
    return [p for p in files if p.suffix in suffixes and p.is_file()]


def test_cpp_is_formatted(root: Path) -> None:
    done = run(root / "tools/format", "--check", "--cpp", cwd=root)
    files = sorted(set(re.findall(r"^(\S+?):\d+:", done.stdout + done.stderr, re.MULTILINE)))
    assert done.returncode == 0, f"run `make format`: {' '.join(files)}"


def test_python_is_formatted_and_lint_free(root: Path) -> None:
    done = run(root / "tools/format", "--check", "--python", cwd=root)
    assert done.returncode == 0, done.stdout + done.stderr


def test_python_is_typed(root: Path) -> None:
    done = run(BIN / "python", "-m", "mypy", cwd=root)
    assert done.returncode == 0, done.stdout + done.stderr


def test_todo_and_bug_comments_name_an_issue(root: Path) -> None:
    marks = [
        f"{path.relative_to(root)}:{number}: {line.strip()}"
        for path in tracked_text_files(root)
        if path.suffix in {".h", ".cpp", ".py", ".def"} and path != Path(__file__).resolve()
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if re.search(r"\b(TODO|FIXME|XXX|BUG)\b", line)
        and not re.search(r"\b(TODO|BUG)\(#\d+\)", line)
    ]
    assert not marks, "\n" + "\n".join(marks)


def test_no_code_is_switched_off(root: Path) -> None:
    disabled = [
        f"{path.relative_to(root)}:{number}"
        for path in tracked_text_files(root)
        if path.suffix in {".h", ".cpp"}
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if re.match(r"\s*#\s*if\s+0\b", line) or "DISABLED_" in line
    ]
    assert not disabled


def test_every_header_has_an_essay_and_a_guard(root: Path) -> None:
    bad = []
    for path in sorted((root / "src").rglob("*.h")) + sorted((root / "include").rglob("*.h")):
        text = path.read_text()
        essay = re.match(r"(//[^\n]*\n)+", text)
        if "#pragma once" not in text or essay is None:
            bad.append(str(path.relative_to(root)))
    assert not bad


def test_every_layer_has_a_short_readme(root: Path) -> None:
    for folder in sorted(p for p in (root / "src").iterdir() if p.is_dir()):
        readme = folder / "README.md"
        assert readme.is_file(), f"{folder.name} has no README.md"
        assert len(readme.read_text().splitlines()) <= 40, f"{readme} is longer than 40 lines"


def test_files_have_no_long_tail_of_lines(root: Path) -> None:
    """800 lines need a reason; tables of numbers are one."""
    long = [
        f"{path.relative_to(root)}: {n} lines"
        for path in tracked_text_files(root)
        if path.suffix in {".h", ".cpp", ".py"} and (n := len(path.read_text().splitlines())) > 800
    ]
    assert not long
