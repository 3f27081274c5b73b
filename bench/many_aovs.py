"""What a frame of hundreds of AOVs takes: the showcase with 300 layers, one sample a pixel.

    python bench/many_aovs.py [--layers 300] [--size 3840x2160] [OPTIONS OF render]

Prints the forecast, what was measured, and the size of the file. Half an hour at 4K on two cores.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

SCENE = Path(__file__).parent.parent / "scenes/showcase.ass"
GROUPS = ("key", "rim", "lamp", "default")
PARTS = ("diffuse", "specular", "coat", "sheen", "transmission", "sss", "volume")
LOBES = ("RD", "RS", "RS'coat'", "RS'sheen'", "TS", "TD", "V")


def outputs(n: int) -> list[str]:
    """Options that ask for `n` layers beside those of the scene: light groups, then bounces."""
    asked = [
        ["--aov", f"{part}{way}_{group} RGB"]
        for way, part, group in product(("", "_direct", "_indirect"), PARTS, GROUPS)
    ]
    asked += [
        ["--lpe", f"bounce{depth}_{i}_{group} C.{{{depth}}}<{lobe}><L.'{group}'>"]
        for depth, (i, lobe), group in product(range(8), enumerate(LOBES), GROUPS)
    ]
    return [text for option in asked[:n] for text in option]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--layers", type=int, default=300)
    parser.add_argument("--size", default="3840x2160")
    given, more = parser.parse_known_args()
    command = [sys.executable, "-m", "lightsieve"]
    checked = subprocess.run(
        [*command, "check", str(SCENE), "--json"], capture_output=True, text=True, check=True
    )
    n_there = sum(len(f["layers"]) for f in json.loads(checked.stdout)["summary"]["files"])
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [
                *command,
                *("render", str(SCENE), "--aa", "1", "--size", given.size, "--json"),
                *("-o", f"{folder}/many.exr", *more),
                *outputs(given.layers - n_there),
            ],
            stdout=subprocess.PIPE,
            text=True,
            check=True,
        )
        document = json.loads(done.stdout)
        n_bytes = (Path(folder) / "many.exr").stat().st_size
    aovs = document["aovs"]
    print(f"{aovs['layers']} layers, {aovs['states']} states, {aovs['atoms']} atoms")
    print(f"{document['seconds']:.0f} s, of the file {document['output_seconds']:.0f} s more")
    print(f"foretold {document['forecast']['total'] / 2**30:.2f} GiB of memory")
    print(f"measured {document['peak_memory'] / 2**30:.2f} GiB")
    for kind, size in document["memory"].items():
        told = document["forecast"]["memory"][kind]
        print(f"  {kind:12} {size / 2**20:8.0f} MiB, foretold {told / 2**20:8.0f}")
    (raw,) = document["forecast"]["file_bytes"].values()
    print(f"file {n_bytes / 2**30:.2f} GiB, {raw / 2**30:.2f} before compression")


if __name__ == "__main__":
    main()
