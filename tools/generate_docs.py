"""Writes the pages that follow from the code: docs/cli.md and docs/reference/*.md.

    python tools/generate_docs.py            rewrites them
    python tools/generate_docs.py --check    exits 1 and names those that are out of date

A test runs the check, so a page cannot fall behind.
"""

from __future__ import annotations

import os
import pkgutil
import sys
from collections import Counter
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

# Help texts wrap at the terminal's width.
os.environ["COLUMNS"] = "100"

from typer.testing import CliRunner

from lightsieve import _lpe, cli, lpe
from lightsieve.cli.main import build_app
from lightsieve.cli.nodes import default_text, parameter_notes
from lightsieve.scene import Node, nodes

ROOT = Path(__file__).resolve().parent.parent
CLI_INTRODUCTION = """\
Results go to standard output, progress and diagnostics to standard error. Exit codes: 0 ok, 1 bad
input or a check that failed, 2 usage, 3 a bug of ours, 130 Ctrl-C. With `--json` a command prints
one JSON document instead of text; its keys stay as they are listed here. If the input is so bad
that there is nothing else to say, the document has one key, `errors`. Errors, warnings and lints
are objects with `severity`, `code`, `message`, `hint`, `file`, `line`, `column`, `rendered` and
`notes`.
"""
FEATURES_INTRODUCTION = """\
A parameter is *honoured* if the picture changes as predicted when it does. Each of them has a probe: a small scene in which it
acts, two values, and what the step between them must do (tests/probes). A parameter that is *ignored with a warning* would
change the picture and does not yet; setting it is reported. One *without effect* steers Arnold's own sampling, its log or its
host, or acts only together with another that is reported: tests/probes/tables/unused.toml has the reason for each.
The parameters themselves are in [nodes.md](nodes.md).
"""
STATUSES = {
    "supported": "honoured",
    "pending": "ignored with a warning",
    "ignored": "without effect",
}
NOTICE = "<!-- Written by tools/generate_docs.py: change the code, then run `make docs`. -->\n"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def _table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(map(_cell, line)) + " |\n" for line in lines)


def _commands() -> Iterator[tuple[list[str], Any]]:
    """The words of each command and its module."""
    for found in pkgutil.iter_modules(cli.__path__):
        if not found.name.startswith("_") and found.name != "main":
            module = import_module(f"lightsieve.cli.{found.name}")
            yield [word for word in found.name.rpartition("_") if word not in ("", "_")], module


def cli_page() -> str:
    """The command line: every command's help, and what `--json` prints."""
    runner, app = CliRunner(), build_app(pretty=False)

    def help_of(words: list[str]) -> str:
        result = runner.invoke(app, [*words, "--help"], prog_name="lightsieve")
        assert result.exit_code == 0, result.output
        return "```\n" + result.output.strip() + "\n```\n"

    parts = [
        NOTICE,
        "# The command line\n",
        CLI_INTRODUCTION,
        help_of([]),
    ]
    for words, module in _commands():
        rows = [[f"`{key}`", meaning] for key, meaning in module.JSON.items()]
        parts += [
            f"## lightsieve {' '.join(words)}\n",
            help_of(words),
            "With `--json`:\n",
            _table(["key", "is"], rows),
        ]
    return "\n".join(parts)


def errors_page() -> str:
    """Every code of an error, a warning or a lint."""
    rows = [[f"`{code}`", meaning] for code, meaning in _lpe.error_codes()]
    return "\n".join(
        [
            NOTICE,
            "# Errors, warnings and lints\n",
            "The code stands in brackets: `shot.ass:14:3: warning[unknown-param]`.\n",
            _table(["code", "means"], rows),
        ]
    )


def aovs_page() -> str:
    """The built-in AOVs in both tables, and the sums."""
    arnold7 = {row.name: row.expression for row in lpe.builtins("arnold7")}
    rows = [
        [
            f"`{row.name}`",
            f"`{row.expression}`",
            f"`{arnold7[row.name]}`" if arnold7[row.name] != row.expression else "the same",
            row.meaning,
        ]
        for row in lpe.builtins()
    ]
    sums = [
        f"- {table}: {' + '.join(names)}"
        for table in ("reference", "arnold7")
        for names in _lpe.additive_sets(table)
    ]
    return "\n".join(
        [
            NOTICE,
            "# Built-in AOVs\n",
            _table(["name", "expression", "with --lpe-table arnold7", "meaning"], rows),
            "Sets that add up to the beauty, proved over all paths:\n",
            *sums,
            "",
        ]
    )


def _node_section(node: Node) -> str:
    parts = [f"## {node.name}\n", f"{node.kind.capitalize()}. {node.doc}\n"]
    if node.params:
        rows = [
            [
                f"`{param.name}`",
                param.type + ("[]" if param.array else ""),
                f"`{text}`" if (text := default_text(param)) else "",
                parameter_notes(param),
            ]
            for param in node.params
        ]
        parts.append(_table(["parameter", "type", "default", ""], rows))
    if node.lobes:
        rows = [[f"`{lobe.event}`", lobe.doc] for lobe in node.lobes]
        parts.append(_table(["lobe's event", ""], rows))
    return "\n".join(parts)


def nodes_page() -> str:
    """Every node with its parameters and lobes, by kind."""
    known = sorted(nodes().values(), key=lambda node: (node.kind, node.name))
    return "\n".join([NOTICE, "# Nodes\n", *map(_node_section, known)])


def _status_counts(known: list[Node]) -> list[str]:
    """Nodes, parameters, those of each status, and the honoured part of those that change a picture."""
    counts = Counter(param.status for node in known for param in node.params)
    acting = counts["supported"] + counts["pending"]
    part = f"{100 * counts['supported'] / acting:.1f} %" if acting else ""
    numbers = [len(known), counts.total(), *(counts[status] for status in STATUSES)]
    return [*map(str, numbers), part]


def features_page() -> str:
    """How much of every node is honoured, and what is not."""
    known = sorted(nodes().values(), key=lambda node: (node.kind, node.name))
    kinds = list(dict.fromkeys(node.kind for node in known))
    summary = [[kind, *_status_counts([n for n in known if n.kind == kind])] for kind in kinds]
    summary.append(["all", *_status_counts(known)])
    columns = ["nodes", "parameters", *STATUSES.values(), "honoured of those that act"]
    rows = []
    for node in known:
        named = [[f"`{p.name}`" for p in node.params if p.status == s] for s in STATUSES]
        honoured = "all" if len(named[0]) == len(node.params) else str(len(named[0]))
        rows.append([f"`{node.name}`", node.kind, honoured, *map(", ".join, named[1:])])
    return "\n".join(
        [
            NOTICE,
            "# What is honoured\n",
            FEATURES_INTRODUCTION,
            _table(["kind", *columns], summary),
            _table(["node", "kind", *STATUSES.values()], rows),
        ]
    )


PAGES = {
    "docs/cli.md": cli_page,
    "docs/reference/aovs.md": aovs_page,
    "docs/reference/errors.md": errors_page,
    "docs/reference/features.md": features_page,
    "docs/reference/nodes.md": nodes_page,
}


def main() -> int:
    """Writes or checks the pages."""
    check = sys.argv[1:] == ["--check"]
    old = 0
    for name, page in PAGES.items():
        path, text = ROOT / name, page()
        if path.is_file() and path.read_text() == text:
            continue
        old += 1
        print(f"{name} is out of date: run `make docs`" if check else f"wrote {name}")
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
    return 1 if check and old else 0


if __name__ == "__main__":
    sys.exit(main())
