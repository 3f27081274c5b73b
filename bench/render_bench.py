#!/usr/bin/env python3
"""Renders the scenes of bench/scenes and prints how fast that goes, what it takes and what AOVs cost.

    python bench/render_bench.py [--quick] [--json] [--rounds N] [--threads N]

First table: samples and rays a second, 1 / (mean squared error * processor time) and the peak memory of each scene, the beauty alone. Second table: all built-in AOVs in
all light groups against the beauty alone. Only sampling is timed, no file is written. Each line is a process of its own
(measure.py), so that its peak memory is that of its scene; the two variants of a line of the second table take turns in one
process. The least of the rounds counts: whatever else the machine does only ever adds.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from measure import Job, all_builtins  # noqa: E402

import lightsieve  # noqa: E402
from scenes import (  # noqa: E402
    as_ass,
    ceiling_panels,
    cornell_box,
    hair_ball,
    meadow,
    smoke_plume,
    terrain,
    wax_head,
)

N_GROUPS = 8


@dataclass(frozen=True)
class Size:
    """How much there is to do.

    Args:
        resolution: width and height [pixels].
        spp: samples a pixel.
        n_triangles: of the terrain.
        n_strands: of hair.
        n_plants: of the meadow.
        rounds: renders of each variant.
    """

    resolution: int
    spp: int
    n_triangles: int
    n_strands: int
    n_plants: int
    rounds: int


FULL = Size(512, 16, 2_000_000, 100_000, 1_000_000, 3)
QUICK = Size(128, 9, 100_000, 10_000, 50_000, 2)


@dataclass(frozen=True)
class Scene:
    """A scene of the first table, or of the second.

    Args:
        name: as the table prints it.
        write: makes the .ass file.
    """

    name: str
    write: Callable[[Path, Size], None]


def _cornell(n_groups: int) -> Callable[[Path, Size], None]:
    return lambda path, size: as_ass.write(path, cornell_box.scene(n_groups), size.resolution)


def _panels(path: Path, size: Size) -> None:
    as_ass.write(path, ceiling_panels.scene(), size.resolution)


def _terrain(path: Path, size: Size) -> None:
    as_ass.write(path, terrain.scene(size.n_triangles), size.resolution)


def _hair(path: Path, size: Size) -> None:
    hair_ball.write(path, size.n_strands, size.resolution)


def _meadow(path: Path, size: Size) -> None:
    meadow.write(path, size.n_plants, size.resolution)


def _head(path: Path, size: Size) -> None:
    wax_head.write(path, size.resolution)


def _smoke(path: Path, size: Size) -> None:
    smoke_plume.write(path, size.resolution)


SCENES = (
    Scene("Cornell box: mirror, glass, rough metal", _cornell(0)),
    Scene("terrain under a dome", _terrain),
    Scene("64 ceiling panels", _panels),
    Scene("ball of hair", _hair),
    Scene("head of wax", _head),
    Scene("plume of smoke", _smoke),
    Scene("meadow of instances", _meadow),
)
# The same lamp cut into eight groups: the same picture as with one.
AOV_SCENES = (
    Scene(f"Cornell box, {N_GROUPS} groups", _cornell(N_GROUPS)),
    Scene(f"64 ceiling panels, {ceiling_panels.N_GROUPS} groups", _panels),
)


def measured(job: Job) -> list[dict[str, Any]]:
    """What measure.py says of a job: one object a variant."""
    command = [sys.executable, str(HERE / "measure.py"), json.dumps(asdict(job))]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"measure.py failed on {job.scene}")  # it has said why
    return json.loads(done.stdout)  # type: ignore[no-any-return]


def run(size: Size, threads: int) -> dict[str, Any]:
    """Measures everything.

    Returns:
        The document that --json prints.
    """
    document: dict[str, Any] = {
        "version": lightsieve.__version__,
        "threads": threads or os.cpu_count(),
        **asdict(size),
        "scenes": [],
        "aov_cost": [],
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.ass"
        for scene in SCENES:
            print(f"{scene.name} ...", file=sys.stderr)
            scene.write(path, size)
            job = Job(str(path), rounds=size.rounds, threads=threads, spp=size.spp, noise=True)
            (beauty,) = measured(job)
            beauty["samples_per_second"] = beauty["samples"] / beauty["seconds"]
            beauty["rays_per_second"] = beauty["rays"] / beauty["seconds"]
            beauty["efficiency"] = 1 / (beauty["variance"] * beauty["cpu_seconds"])
            document["scenes"].append({"name": scene.name, **beauty})
        for scene in AOV_SCENES:
            print(f"{scene.name} ...", file=sys.stderr)
            scene.write(path, size)
            variants = [[], all_builtins()]
            job = Job(str(path), variants, size.rounds, threads, size.spp)
            beauty, all_aovs = measured(job)
            document["aov_cost"].append(
                {
                    "name": scene.name,
                    "beauty": beauty,
                    "all": all_aovs,
                    "cost": all_aovs["seconds"] / beauty["seconds"] - 1,
                    "processor_cost": all_aovs["cpu_seconds"] / beauty["cpu_seconds"] - 1,
                }
            )
    return document


def print_tables(document: dict[str, Any]) -> None:
    """The document for people."""
    size = f"{document['resolution']} x {document['resolution']}, {document['spp']} samples"
    print(
        f"lightsieve {document['version']}, {document['threads']} threads, {size} a pixel, "
        f"terrain of {document['n_triangles']:,} triangles, {document['n_strands']:,} strands, "
        f"{document['n_plants']:,} plants, "
        f"least of {document['rounds']} rounds\n"
    )
    print(
        f"{'':42}{'time':>9}{'samples/s':>12}{'rays/s':>13}{'1/(MSE s)':>11}"
        f"{'compile':>11}{'peak memory':>13}{'at start':>10}"
    )
    for s in document["scenes"]:
        print(
            f"{s['name']:42}{s['seconds']:7.2f} s{s['samples_per_second']:12,.0f}"
            f"{s['rays_per_second']:13,.0f}{s['efficiency']:11,.0f}{s['compile_seconds']:9.2f} s"
            f"{s['peak_mb']:10.0f} MB{s['start_mb']:7.0f} MB"
        )
    print(
        f"\n{'all built-ins in all groups':42}{'AOVs':>7}{'beauty':>11}{'with AOVs':>11}"
        f"{'cost':>9}{'cost, processor time':>23}"
    )
    for s in document["aov_cost"]:
        print(
            f"{s['name']:42}{s['all']['n_aovs']:7}{s['beauty']['seconds']:9.2f} s"
            f"{s['all']['seconds']:9.2f} s{s['cost']:9.1%}{s['processor_cost']:23.1%}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--quick", action="store_true", help="small, in half a minute: is it alive?"
    )
    parser.add_argument("--json", action="store_true", help="one JSON document")
    parser.add_argument("--rounds", type=int, default=0, help="renders of each variant")
    parser.add_argument("--threads", type=int, default=0, help="0: as many as the machine has")
    args = parser.parse_args()
    size = QUICK if args.quick else FULL
    if args.rounds > 0:
        size = replace(size, rounds=args.rounds)
    document = run(size, args.threads)
    if args.json:
        print(json.dumps(document, indent=2))
    else:
        print_tables(document)


if __name__ == "__main__":
    main()
