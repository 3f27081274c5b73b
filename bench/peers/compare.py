#!/usr/bin/env python3
"""Three scenes of bench/scenes in Lightsieve, Mitsuba 3, Cycles and LuxCore.

    python3 -m venv out/peers
    out/peers/bin/pip install -r bench/peers/requirements.txt
    python bench/peers/compare.py --peers-python out/peers/bin/python [--quick] [--json] [--only cornell]

Run it with the Python that has Lightsieve; the peers live in an environment of their own. Each line of the tables is a process of its own
(worker.py). All renderers trace with the same number of bounces, a box filter, without roulette,
clamping, adaptive sampling and denoising. A renderer's error is measured against its own converged picture: layered
surfaces are not the same in any two of them (the column `mean` says how far apart the pictures are).
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from worker import RENDERERS, Job

HERE = Path(__file__).resolve().parent
SCENES = ("cornell", "terrain", "panels")
TITLES = {
    "cornell": "Cornell box: mirror, glass, rough metal; the lamp in 8 light groups",
    "terrain": "2 million triangles under a dome",
    "panels": "64 ceiling panels in 8 light groups, layered materials",
}
# Of Mitsuba's LLVM variant; see --llvm.
LLVM_VARIABLE = "DRJIT_LIBLLVM_PATH"


def measured(job: Job, python: str, llvm: str) -> dict[str, Any] | None:
    """What worker.py says of a job; nothing if the renderer is not there or fails, which it says itself."""
    environment = os.environ | ({LLVM_VARIABLE: llvm} if llvm else {})
    command = [python, str(HERE / "worker.py"), json.dumps(asdict(job))]
    # Some of them write a log to both streams.
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode != 0 or not lines:
        said = [line for line in done.stderr.splitlines() if line.strip()]
        print(f"{job.renderer} failed on {job.scene}:", *said[-5:], sep="\n  ", file=sys.stderr)
        return None
    return json.loads(lines[-1])  # type: ignore[no-any-return]


def row(job: Job, python: str, llvm: str) -> dict[str, Any] | None:
    """One renderer on one scene: the beauty alone, then with all its layers."""
    print(f"{job.renderer}, {job.scene} ...", file=sys.stderr)
    plain = measured(job, python, llvm)
    if plain is None:
        return None
    with_layers = replace(job, layers=True, reference_spp=0)
    layered = measured(with_layers, python, llvm)
    cost = peak = None
    if layered is not None:
        cost = plain["samples_per_second"] / layered["samples_per_second"] - 1
        peak = layered["peak_mb"]
    rate = plain["samples_per_second"] / (job.resolution**2 * job.spp)  # renders a second
    return {
        "renderer": job.renderer,
        **plain,
        "efficiency": rate / plain["mse"] if plain["mse"] else 0,
        "layer_count": layered["layer_count"] if layered else None,
        "layer_cost": cost,
        "layered_peak_mb": peak,
    }


def print_table(scene: str, rows: list[dict[str, Any]], spp: int) -> None:
    """The rows for people."""
    print(f"\n{TITLES[scene]}\n")
    print(
        f"{'':20}{'samples/s':>12}{f'MSE at {spp}':>13}{'1/(MSE s)':>11}{'mean':>9}"
        f"{'set-up':>9}{'memory':>9}{'layers':>8}{'cost':>8}{'memory':>9}"
    )
    for r in rows:
        cost = "-" if r["layer_cost"] is None else f"{r['layer_cost']:+.1%}"
        memory = "-" if r["layered_peak_mb"] is None else f"{r['layered_peak_mb']:.0f} MB"
        print(
            f"{r['renderer']:20}{r['samples_per_second']:12,.0f}{r['mse']:13.3e}"
            f"{r['efficiency']:11,.1f}{sum(r['mean']) / 3:9.4f}{r['setup_seconds']:7.1f} s"
            f"{r['peak_mb']:6.0f} MB{r['layer_count'] or '-':>8}{cost:>8}{memory:>9}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--peers-python", required=True, help="the Python that has the peers")
    parser.add_argument("--llvm", default="", help="LLVM's library, if Mitsuba should not look")
    parser.add_argument("--resolution", type=int, default=128)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--reference-spp", type=int, default=2048)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--only", nargs="*", default=SCENES, choices=SCENES)
    parser.add_argument("--renderers", nargs="*", default=list(RENDERERS), choices=RENDERERS)
    parser.add_argument("--quick", action="store_true", help="small: is it alive?")
    parser.add_argument("--json", action="store_true", help="one JSON document")
    args = parser.parse_args()
    base = Job("", "", args.resolution, args.spp, args.rounds, args.threads)
    base = replace(base, reference_spp=args.reference_spp)
    if args.quick:
        base = replace(base, resolution=32, spp=8, rounds=1, reference_spp=64, n_triangles=20_000)
    document: dict[str, Any] = {**asdict(base), "scenes": {}}
    for scene in args.only:
        rows = []
        for name in args.renderers:
            python = sys.executable if name.startswith("lightsieve") else args.peers_python
            found = row(replace(base, renderer=name, scene=scene), python, args.llvm)
            if found is not None:
                rows.append(found)
        document["scenes"][scene] = rows
        if not args.json:
            print_table(scene, rows, base.spp)
    if args.json:
        print(json.dumps(document, indent=2))


if __name__ == "__main__":
    main()
