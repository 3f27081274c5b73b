"""One scene rendered several times in a process of its own: times, rays, memory.

    python measure.py '{"scene": "cornell.ass", "variants": [[], ["diffuse RGB"]], "rounds": 3}'

prints one JSON object a variant. A variant is a list of AOVs beside the beauty; the variants take
turns, so that what else the machine does hits all of them alike, and the least of several times is
kept. Nothing is written to files.
"""

from __future__ import annotations

import json
import resource
import sys
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np


@dataclass
class Job:
    """What to measure.

    Args:
        scene: .ass file.
        variants: lists of AOVs ("NAME TYPE") that are asked for beside the beauty.
        rounds: renders of each variant.
        threads: 0: as many as the machine has.
        spp: samples a pixel; 0: as the scene says.
        roulette: scatterings before Russian roulette; negative: never.
        noise: whether to measure the variance, too.
    """

    scene: str
    variants: list[list[str]] = field(default_factory=lambda: [[]])
    rounds: int = 3
    threads: int = 0
    spp: int = 0
    roulette: int = -1
    noise: bool = False


@dataclass
class Measured:
    """Figures of one variant.

    Args:
        seconds: least sampling time of the rounds, without compile and output [s].
        cpu_seconds: least processor time of all threads [s].
        all_cpu_seconds: processor time of each round [s].
        samples: camera samples of a render.
        rays: closest-hit and shadow rays of a render.
        peak_mb: most memory of the process so far [MB].
        start_mb: the same before the scene was read [MB].
        compile_seconds: reading and compiling [s].
        n_aovs: expressions with their groups.
        variance: of a pixel's channel, from two renders with other seeds; 0 if it was not asked for.
    """

    seconds: float
    cpu_seconds: float
    all_cpu_seconds: list[float]
    samples: int
    rays: int
    peak_mb: float
    start_mb: float
    compile_seconds: float
    n_aovs: int
    variance: float = 0


def peak_mb() -> float:
    """Most memory that this program has used [MB]."""
    # Not ru_maxrss: that starts with the peak of the process which started this one.
    (line,) = [x for x in Path("/proc/self/status").read_text().splitlines() if "VmHWM" in x]
    return int(line.split()[1]) / 1024


def cpu_seconds() -> float:
    """Processor time of all threads of this process in user mode [s]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def compile_scene(
    scene: str,
    aovs: list[str],
    *,
    threads: int,
    spp: int,
    roulette: int,
    seed: int | None = None,
    guiding: bool = False,
) -> object:
    """Reads and compiles a scene.

    Returns:
        The compiled scene, to render in memory; see `render`.
    Raises:
        RuntimeError: the scene has errors.
    """
    from lightsieve import _core

    options = _core.RenderOptions()
    options.aovs = aovs
    options.threads = threads
    options.spp = spp
    options.roulette_depth = roulette
    options.seed = seed
    options.guiding = guiding
    options.capture = True
    options.write_files = False
    compiled = _core.CompiledScene(scene, options)
    if not compiled.usable or compiled.n_errors:
        errors = [d.rendered for d in compiled.diagnostics if d.severity == "error"]
        raise RuntimeError("\n".join(errors))
    return compiled


def beauty(outcome: object) -> np.ndarray:
    """The first layer of a render as float32 of shape (height, width, 3)."""
    return outcome.layers[0][1][..., :3]  # type: ignore[attr-defined,no-any-return]


def all_builtins() -> list[str]:
    """Outputs for every built-in AOV and for each of its light groups."""
    import lightsieve

    out: list[str] = []
    for builtin in lightsieve.lpe.builtins():
        # The beauty is the scene's own output.
        if builtin.name != "RGBA":
            out.append(f"{builtin.name} RGB")
        # An albedo ends at no light: it has no groups.
        if "albedo" not in builtin.name:
            out.append(f"{builtin.name}_* RGB")
    return out


def variance(job: Job) -> float:
    """Half the mean squared difference of two renders; the brightest 0.1 % of the pixels are left out."""
    a, b = (
        beauty(
            compile_scene(  # type: ignore[attr-defined]
                job.scene, [], threads=job.threads, spp=job.spp, roulette=job.roulette, seed=seed
            ).render()
        )
        for seed in (11, 12)
    )
    squares = np.sort(0.5 * ((a - b) ** 2).mean(axis=2).ravel())
    return float(squares[: int(0.999 * squares.size)].mean())


def measure(job: Job) -> list[Measured]:
    """Renders every variant `rounds` times, in turn."""
    out: list[Measured] = []
    scenes = []
    start_mb = peak_mb()
    for aovs in job.variants:
        start = time.perf_counter()
        scene = compile_scene(
            job.scene, aovs, threads=job.threads, spp=job.spp, roulette=job.roulette
        )
        seconds = time.perf_counter() - start
        n_aovs = scene.summary().n_aovs  # type: ignore[attr-defined]
        scenes.append(scene)
        out.append(Measured(float("inf"), float("inf"), [], 0, 0, 0, start_mb, seconds, n_aovs))
    for _ in range(job.rounds):
        for scene, m in zip(scenes, out, strict=True):
            before = cpu_seconds()
            outcome = scene.render()  # type: ignore[attr-defined]
            spent = cpu_seconds() - before
            m.seconds = min(m.seconds, outcome.seconds)
            m.cpu_seconds = min(m.cpu_seconds, spent)
            m.all_cpu_seconds.append(spent)
            m.samples, m.rays, m.peak_mb = outcome.samples, outcome.rays, peak_mb()
    if job.noise:
        out[0].variance = variance(job)
    return out


if __name__ == "__main__":
    print(json.dumps([asdict(m) for m in measure(Job(**json.loads(sys.argv[1])))]))
