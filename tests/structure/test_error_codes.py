"""Every error code is used, documented and tested."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROW = re.compile(r'^X\((\w+), "([a-z0-9-]+)", "([^"]+)"\)', re.MULTILINE)


def codes(root: Path) -> list[tuple[str, str, str]]:
    return [
        (m[1], m[2], m[3]) for m in ROW.finditer((root / "src/core/error_codes.def").read_text())
    ]


def source_text(root: Path, *, tests: bool) -> str:
    files = [p for p in (root / "src").rglob("*.cpp") if p.name.endswith("_test.cpp") == tests]
    if not tests:
        files += (root / "src").rglob("*.h")
    else:
        files += [
            p for p in (root / "tests").rglob("*") if p.suffix in {".py", ".toml", ".ass", ".txt"}
        ]
        files.remove(Path(__file__).resolve())
    return "\n".join(p.read_text(errors="replace") for p in files)


def test_all_rows_are_read(root: Path) -> None:
    text = (root / "src/core/error_codes.def").read_text()
    assert len(codes(root)) == len(re.findall(r"^X\(", text, re.MULTILINE)) > 0


def test_groups_are_in_alphabetical_order(root: Path) -> None:
    groups = re.split(r"\n\s*\n", (root / "src/core/error_codes.def").read_text())
    for group in groups:
        names = [m[1] for m in ROW.finditer(group)]
        assert names == sorted(names)


def test_every_code_is_reported_somewhere(root: Path) -> None:
    text = source_text(root, tests=False)
    python = "\n".join(p.read_text() for p in (root / "python").rglob("*.py"))
    unused = [
        name
        for name, shown, _ in codes(root)
        if not re.search(rf"\bCode::{name}\b", text) and f'"{shown}"' not in python
    ]
    assert not unused


def test_every_code_has_a_test(root: Path) -> None:
    text = source_text(root, tests=True)
    untested = [
        f"{name} ({shown})"
        for name, shown, _ in codes(root)
        if not re.search(rf"\bCode::{name}\b|\b{shown}\b", text)
    ]
    assert not untested


@pytest.mark.parametrize("forbidden", [r"\.$", r"^[A-Z][a-z]", r"please"])
def test_meanings_follow_the_style_of_messages(root: Path, forbidden: str) -> None:
    assert [row for row in codes(root) if re.search(forbidden, row[2])] == []
