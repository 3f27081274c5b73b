#!/usr/bin/env python3
"""The Cornell box of bench/scenes, rendered by Lightsieve and by Mitsuba 3 (scalar_rgb) in one run.

    python bench/compare_mitsuba.py [--resolution 512] [--spp 64] [--rounds 3] [--threads 2]

Needs Lightsieve and what bench/requirements.txt names in the Python that runs it. The renderers take turns; the least of
several times is kept. Both trace the same integrand: eight bounces, no roulette, box filter. Variance is half
the mean squared difference of two independent renders, its mean over the picture, as a ratio of the two renderers.
"""

from __future__ import annotations

import argparse
import itertools
import pathlib
import sys
import tempfile
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import measure  # noqa: E402

from scenes import cornell_box  # noqa: E402


def ours(scene: str, spp: int, seed: int, threads: int) -> tuple[float, np.ndarray]:
    """Seconds of sampling and the picture."""
    compiled = measure.compile_scene(scene, [], threads=threads, spp=spp, roulette=-1, seed=seed)
    outcome = compiled.render()  # type: ignore[attr-defined]
    return outcome.seconds, np.array(measure.beauty(outcome))


def variance(pairs: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """Of a pixel's channel, mean over pixels and pairs; the brightest 0.1 % are left out: fireflies decide nothing."""
    squares = np.mean([0.5 * (a - b) ** 2 for a, b in pairs], axis=0).mean(axis=2).ravel()
    return float(np.sort(squares)[: int(0.999 * squares.size)].mean())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--resolution", type=int, default=512)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=2)
    args = parser.parse_args()

    import drjit as dr
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    dr.set_thread_count(args.threads)
    from scenes import cornell_mitsuba

    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "cornell.ass"
        path.write_text(cornell_box.ass(resolution=args.resolution))
        samplers = ("independent", "multijitter")
        theirs = {s: cornell_mitsuba.load(s, args.spp, args.resolution) for s in samplers}
        seconds: dict[str, list[float]] = {"lightsieve": [], **{s: [] for s in samplers}}
        pictures: dict[str, list[np.ndarray]] = {name: [] for name in seconds}
        for round_index in range(max(2, args.rounds)):
            spent, picture = ours(str(path), args.spp, 100 + round_index, args.threads)
            seconds["lightsieve"].append(spent)
            pictures["lightsieve"].append(picture)
            for sampler, scene in theirs.items():
                start = time.perf_counter()
                image = np.array(mi.render(scene, spp=args.spp, seed=100 + round_index))
                seconds[sampler].append(time.perf_counter() - start)
                pictures[sampler].append(image[..., :3])

    least = {name: min(values) for name, values in seconds.items()}
    noise = {name: variance(list(itertools.pairwise(p))) for name, p in pictures.items()}
    mean = {name: float(np.mean(p)) for name, p in pictures.items()}
    print(f"{'':24} {'seconds':>9} {'variance':>11} {'mean':>9}")
    for name in seconds:
        label = name if name == "lightsieve" else f"mitsuba {name}"
        print(f"{label:24} {least[name]:9.2f} {noise[name]:11.3e} {mean[name]:9.5f}")
    for sampler in samplers:
        print(
            f"against mitsuba {sampler}: {least[sampler] / least['lightsieve']:.2f} times as fast, "
            f"{noise['lightsieve'] / noise[sampler]:.2f} of its variance a sample"
        )


if __name__ == "__main__":
    main()
