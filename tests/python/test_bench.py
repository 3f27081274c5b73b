"""`make bench` prints what bench/README.md says, at its smallest size."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path


def test_the_driver_measures_every_scene_and_the_cost_of_aovs(root: Path) -> None:
    done = subprocess.run(
        [sys.executable, root / "bench/render_bench.py", "--quick", "--rounds", "1", "--json"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    document = json.loads(done.stdout)
    n_samples = document["resolution"] ** 2 * document["spp"]
    assert [s["samples"] for s in document["scenes"]] == [n_samples] * 7
    assert all(s["rays"] > n_samples for s in document["scenes"])
    # Each process starts afresh: none begins with what the one before it needed.
    assert all(s["peak_mb"] > s["start_mb"] + 5 for s in document["scenes"])
    # 35 built-ins, and 26 of them again in eight groups and `default`.
    assert [s["all"]["n_aovs"] for s in document["aov_cost"]] == [35 + 26 * 9] * 2


def test_denoising_is_measured_for_every_layer_of_light(root: Path) -> None:
    done = subprocess.run(
        [sys.executable, root / "bench/denoise_bench.py", "--quick", "--seeds", "1", "--json"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (table,) = json.loads(done.stdout).values()
    assert {"RGBA", "RGBA_group0", "diffuse", "diffuse_indirect", "indirect"} <= set(table)
    assert all(set(errors) == {"noisy", "alone", "together"} for errors in table.values())
    assert table["RGBA"]["together"] < table["RGBA"]["noisy"]
