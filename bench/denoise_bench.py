#!/usr/bin/env python3
"""What denoising layers so that they add up costs, or gains, against denoising each by itself.

    python bench/denoise_bench.py [--quick] [--json] [--seeds N] [--threads N]

Renders the showcase, the Cornell box and the hall of panels small and noisy, with several seeds, and twice with many samples. Prints for each
layer of light the mean squared error of the noisy picture, of each layer denoised alone, and of what `lightsieve.denoise`
makes of it, and the ratio of the last two. Errors are products of the differences to the two references, whose own noise
is independent and so averages out: nothing has to be converged altogether.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import lightsieve  # noqa: E402
from lightsieve.denoise_oidn import Denoiser  # noqa: E402
from scenes import as_ass, ceiling_panels, cornell_box  # noqa: E402

Picture = npt.NDArray[np.float64]

SHOWCASE = HERE.parent / "scenes/showcase.ass"
CORNELL_AOVS = [
    "RGBA_*",
    "direct",
    "indirect",
    "emission",
    "background",
    "diffuse",
    "diffuse_*",
    "diffuse_direct",
    "diffuse_indirect",
    "specular",
    "specular_direct",
    "specular_indirect",
    "transmission",
    "coat",
    "sss",
    "sheen",
    "volume",
    "albedo",
]
# References have these seeds, noisy pictures those from 1 on.
REFERENCE_SEEDS = (1001, 1002)


@dataclass(frozen=True)
class Case:
    """One picture.

    Args:
        name: printed.
        scene: file.
        aovs: outputs beside those of the scene.
        size: width and height [pixels].
        spp: samples a pixel of the noisy pictures.
        reference_spp: of each reference.
    """

    name: str
    scene: Path
    aovs: tuple[str, ...]
    size: tuple[int, int]
    spp: int
    reference_spp: int


@dataclass
class Errors:
    """Mean squared errors of one layer, summed over seeds."""

    noisy: float = 0.0
    alone: float = 0.0
    together: float = 0.0

    @property
    def ratio(self) -> float:
        return self.together / self.alone


def cases(folder: Path, quick: bool) -> list[Case]:
    as_ass.write(folder / "cornell.ass", cornell_box.scene(n_groups=3), resolution=512)
    as_ass.write(folder / "panels.ass", ceiling_panels.scene(), resolution=512)
    cornell, panels = folder / "cornell.ass", folder / "panels.ass"
    aovs = (*CORNELL_AOVS, "N VECTOR")
    if quick:
        return [Case("Cornell box", cornell, aovs, (32, 32), 2, 8)]
    return [
        Case("showcase", SHOWCASE, ("N VECTOR",), (192, 108), 2, 48),
        Case("showcase, more samples", SHOWCASE, ("N VECTOR",), (192, 108), 8, 48),
        Case("Cornell box", cornell, aovs, (128, 128), 4, 128),
        Case("Cornell box, more samples", cornell, aovs, (128, 128), 32, 128),
        Case("64 panels", panels, aovs, (128, 128), 4, 96),
        Case("64 panels, more samples", panels, aovs, (128, 128), 16, 96),
    ]


def light(frame: lightsieve.Frame, name: str) -> Picture:
    return frame.layer(name)[:, :, :3].astype(np.float64)


def rendered(case: Case, folder: Path, seed: int, spp: int, threads: int) -> Path:
    file = folder / f"{case.name.split(',')[0]}-{seed}-{spp}.exr"
    if not file.exists():
        lightsieve.render(
            case.scene,
            aovs=case.aovs,
            size=case.size,
            spp=spp,
            seed=seed,
            threads=threads,
            output=file,
        )
    return file


def measure(case: Case, folder: Path, n_seeds: int, threads: int) -> dict[str, Errors]:
    references = [
        lightsieve.exr.read(rendered(case, folder, seed, case.reference_spp, threads))
        for seed in REFERENCE_SEEDS
    ]

    def error(picture: Picture, name: str) -> float:
        a, b = (picture - light(reference, name) for reference in references)
        return float((a * b).mean())

    out: dict[str, Errors] = {}
    for seed in range(1, n_seeds + 1):
        file = rendered(case, folder, seed, case.spp, threads)
        done = lightsieve.denoise(file, folder / "denoised.exr", threads=threads)
        assert lightsieve.exr.verify(done.file).passed
        noisy, together = lightsieve.exr.read(file), lightsieve.exr.read(done.file)
        albedo = sum(noisy.layer(name)[:, :, :3] for name in done.albedo)
        denoiser = Denoiser(np.asarray(albedo), noisy.layer(done.normal), threads=threads)
        for name in done.layers:
            if not any(light(reference, name).any() for reference in references):
                continue
            alone = denoiser.denoise(light(noisy, name).astype(np.float32)).astype(np.float64)
            errors = out.setdefault(name, Errors())
            errors.noisy += error(light(noisy, name), name) / n_seeds
            errors.alone += error(alone, name) / n_seeds
            errors.together += error(light(together, name), name) / n_seeds
        denoiser.close()
    # The references are too noisy for what is left of such a layer.
    return {name: e for name, e in out.items() if min(e.noisy, e.alone, e.together) > 0}


def print_case(case: Case, table: dict[str, Errors]) -> None:
    width, height = case.size
    print(f"{case.name}: {width} x {height}, {case.spp} samples a pixel")
    print(f"  {'layer':24} {'noisy':>10} {'alone':>10} {'together':>10} {'ratio':>6}")
    for name, e in table.items():
        print(f"  {name:24} {e.noisy:10.3g} {e.alone:10.3g} {e.together:10.3g} {e.ratio:6.2f}")
    total = sum(e.together for e in table.values()) / sum(e.alone for e in table.values())
    worst = max(table, key=lambda name: table[name].ratio)
    median = statistics.median(e.ratio for e in table.values())
    print(
        f"  all layers {total:.2f}, median {median:.2f}, worst {worst} {table[worst].ratio:.2f}\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="one tiny picture")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--threads", type=int, default=0)
    arguments = parser.parse_args()
    document = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for case in cases(folder, arguments.quick):
            table = measure(case, folder, arguments.seeds, arguments.threads)
            document[case.name] = {
                layer: {"noisy": e.noisy, "alone": e.alone, "together": e.together}
                for layer, e in table.items()
            }
            if not arguments.json:
                print_case(case, table)
    if arguments.json:
        print(json.dumps(document, indent=2))


if __name__ == "__main__":
    main()
