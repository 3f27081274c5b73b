#!/usr/bin/env python3
"""Turns the comparison tool's JSON into the table of docs/fidelity.md.

tools/fidelity_table.py RESULTS.json
"""

import json
import pathlib
import sys


def main() -> None:
    rows = json.loads(pathlib.Path(sys.argv[1]).read_text())
    print("| scene | verdict | rel | low | alpha | what it shows |\n|---|---|---|---|---|---|")
    for row in sorted(
        rows, key=lambda r: (["close", "near", "far", "FAIL"].index(r["verdict"]), r["id"])
    ):
        figures = " | ".join(f"{row[k]:.3f}" if k in row else "" for k in ("rel", "low", "alpha"))
        print(f"| {row['id']} | {row['verdict']} | {figures} | {row['desc']} |")


if __name__ == "__main__":
    main()
