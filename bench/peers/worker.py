"""One scene in one renderer, measured in a process of its own: compare.py calls it.

    python worker.py '{"renderer": "cycles", "scene": "cornell", ...}'

prints one JSON object as its last line.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import time
from dataclasses import asdict, dataclass, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import measure
import numpy as np
from renderer import Renderer, Setting
from scenes.description import Scene

from scenes import ceiling_panels, cornell_box, terrain

RENDERERS = {
    "lightsieve": ("with_lightsieve", "Lightsieve", ""),
    "lightsieve guided": ("with_lightsieve", "GuidedLightsieve", ""),
    "mitsuba scalar_rgb": ("with_mitsuba", "Mitsuba", "scalar_rgb"),
    "mitsuba llvm_ad_rgb": ("with_mitsuba", "Mitsuba", "llvm_ad_rgb"),
    "cycles": ("with_cycles", "Cycles", ""),
    "luxcore": ("with_luxcore", "LuxCore", ""),
}
# Fireflies of a few pixels decide nothing: of the squared errors the largest 0.1 % are left out.
KEPT = 0.999


@dataclass
class Job:
    """What to measure.

    Args:
        renderer: key of RENDERERS.
        scene: "cornell", "terrain" or "panels".
        resolution: width and height [pixels].
        spp: samples a pixel.
        rounds: renders, each with a seed of its own.
        threads: of the renderer.
        layers: whether to make all layers and light groups that the renderer has.
        reference_spp: samples a pixel of the converged picture; 0: no error is measured.
        n_triangles: of the terrain.
    """

    renderer: str
    scene: str
    resolution: int = 128
    spp: int = 64
    rounds: int = 3
    threads: int = 2
    layers: bool = False
    reference_spp: int = 0
    n_triangles: int = 2_000_000


@dataclass
class Measured:
    """What one process found.

    Args:
        samples_per_second: camera samples, without what does not grow with their number.
        setup_seconds: from the scene's data to a picture of one sample a pixel [s].
        peak_mb: most memory of the process until the renders were done [MB].
        mse: of a pixel's channel at `spp` samples against the converged picture; 0: not measured.
        mean: of the converged picture by channel.
        layer_count: layers beside the beauty.
    """

    samples_per_second: float
    setup_seconds: float
    peak_mb: float
    mse: float
    mean: list[float]
    layer_count: int


def describe(job: Job) -> Scene:
    """The scene; its lamps are seen in all renderers, as some cannot hide them."""
    if job.scene == "terrain":
        return terrain.scene(job.n_triangles)
    scene = cornell_box.scene(n_groups=8) if job.scene == "cornell" else ceiling_panels.scene()
    return replace(scene, panels=tuple(replace(p, visible=True) for p in scene.panels))


def load(job: Job) -> Renderer:
    """Imports the renderer and gives it the scene."""
    module, name, variant = RENDERERS[job.renderer]
    if variant:
        import mitsuba

        mitsuba.set_variant(variant)
    setting = Setting(job.resolution, job.threads, job.layers)
    return getattr(importlib.import_module(module), name)(describe(job), setting)  # type: ignore[no-any-return]


def converged(renderer: Renderer, job: Job) -> np.ndarray:
    """A picture of other seeds than the measured ones, in double precision."""
    parts = -(-job.reference_spp // (4 * job.spp))
    total = 0.0
    for i in range(parts):
        total = total + renderer.render(4 * job.spp, 1000 + i).picture.astype(np.float64)
    return np.asarray(total / parts)


def trimmed_mse(picture: np.ndarray, reference: np.ndarray) -> float:
    """Mean squared error of a pixel's channel; see KEPT."""
    squares = np.sort(((picture - reference) ** 2).mean(axis=2).ravel())
    return float(squares[: int(KEPT * squares.size)].mean())


def run(job: Job) -> Measured:
    """Loads, renders `rounds` times, then once for long."""
    start = time.perf_counter()
    renderer = load(job)
    renderer.render(1, 1)
    setup = time.perf_counter() - start
    renderer.render(job.spp, 2)  # kernels are compiled, caches filled
    singles, renders = [], []
    for i in range(job.rounds):
        singles.append(renderer.render(1, 3 + i))
        renders.append(renderer.render(job.spp, 3 + i))
    least = min(r.seconds / r.spp for r in renders)
    single = min(r.seconds for r in singles)
    first = renders[0]
    # What a render takes even for one sample is no part of the rate, unless renders are so short that it is most of them.
    grows = (least * first.spp - single) / (first.spp - singles[0].spp)
    if grows < 0.5 * least:
        grows = least
    peak = measure.peak_mb()
    mse, mean = 0.0, [0.0, 0.0, 0.0]
    if job.reference_spp:
        reference = converged(renderer, job)
        mean = [float(x) for x in reference.mean(axis=(0, 1))]
        errors = [trimmed_mse(r.picture, reference) * r.spp / job.spp for r in renders]
        # The converged picture has noise of its own, that of its samples.
        mse = float(np.mean(errors)) / (1 + job.spp / job.reference_spp)
    pixels = job.resolution**2
    return Measured(pixels / grows, setup, peak, mse, mean, renderer.layer_count)


if __name__ == "__main__":
    print("\n" + json.dumps(asdict(run(Job(**json.loads(sys.argv[1]))))), flush=True)
    os._exit(0)  # some of the libraries crash as they are unloaded
