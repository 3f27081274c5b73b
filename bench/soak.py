#!/usr/bin/env python3
"""Renders again and again in one process, and prints how its memory goes.

    python bench/soak.py [--minutes N] [--threads N]

A round renders every scene of tests/scenes and scenes once, small and with another seed each time: with several AOVs,
files, checkpoints, adaptive samples, and one render in each round that is stopped halfway. Memory is what the process itself has resident at the
end of a round: not its libraries, of which the system keeps more or less in memory as it likes. The first rounds fill caches (textures, tables, the allocator's own); after them it should stay. Prints a line a
minute, and at the end the trend of the later half in MB an hour (least squares).
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import resource
import tempfile
import time
from pathlib import Path

import lightsieve

ROOT = Path(__file__).resolve().parent.parent
AOVS = ["direct", "indirect", "diffuse", "specular", "sss", "albedo", "N VECTOR", "Z FLOAT"]
SCENES = [ROOT / "scenes" / "showcase.ass", *sorted((ROOT / "tests" / "scenes").glob("*.ass"))]


def resident() -> float:
    """Memory that the process has now, without what is a file's [MB]."""
    resident_pages, file_pages = Path("/proc/self/statm").read_text().split()[1:3]
    return (int(resident_pages) - int(file_pages)) * resource.getpagesize() / 1e6


def one_round(seed: int, folder: Path, threads: int) -> None:
    """Renders every scene once; the first of them once more, stopped on the way."""
    for scene in SCENES:
        lightsieve.render(
            scene,
            output=f"{folder}/",
            seed=seed,
            spp=2,
            size=(64, 48),
            threads=threads,
            aovs=AOVS,
            checkpoint=0.0,
            set={"options.enable_adaptive_sampling": "on", "options.AA_samples_max": "3"},
        )

    def stop(now: lightsieve.RenderProgress) -> None:
        if now.samples_done > 0:
            raise KeyboardInterrupt

    with contextlib.suppress(KeyboardInterrupt):
        lightsieve.render(
            SCENES[0], progress=stop, seed=seed, spp=64, size=(64, 48), threads=threads
        )


def trend(points: list[tuple[float, float]]) -> float:
    """Slope of the later half of (seconds, MB) in MB an hour, by least squares."""
    later = points[len(points) // 2 :]
    mean_t = sum(t for t, _ in later) / len(later)
    mean_m = sum(m for _, m in later) / len(later)
    spread = sum((t - mean_t) ** 2 for t, _ in later)
    return 3600 * sum((t - mean_t) * (m - mean_m) for t, m in later) / spread if spread else 0


def main() -> None:
    """Rounds until the time is over."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    start = time.monotonic()
    points: list[tuple[float, float]] = []
    said = -1
    with tempfile.TemporaryDirectory() as folder:
        for n in itertools.count(1):
            one_round(n, Path(folder), options.threads)
            now = time.monotonic() - start
            points.append((now, resident()))
            if int(now // 60) > said:
                said = int(now // 60)
                print(f"{now / 60:5.1f} min  round {n:5}  {points[-1][1]:.1f} MB", flush=True)
            if now > 60 * options.minutes:
                break
    print(f"{len(points)} rounds of {len(SCENES) + 1} renders: ", end="")
    print(
        f"{points[0][1]:.1f} MB after the first, {points[-1][1]:.1f} MB after the last, ", end=""
    )
    print(f"{trend(points):+.2f} MB an hour over the later half")


if __name__ == "__main__":
    main()
