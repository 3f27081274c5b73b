"""Scenes that are too much of something: an error that names the limit, no crash, no hang."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np

import lightsieve
from tests.conftest import ROOT

STILL = (ROOT / "tests/scenes/still.ass").read_text()


def codes(scene: Path, **settings: object) -> list[str]:
    report = lightsieve.check(scene, **settings)  # type: ignore[arg-type]
    return [item.code for item in report.diagnostics]


def test_a_chain_of_shaders_that_is_too_long(tmp_path: Path) -> None:
    links = "\n".join(f"checkerboard {{ name link{i} color1 link{i + 1} }}" for i in range(1000))
    scene = tmp_path / "chain.ass"
    scene.write_text(
        f"{STILL}\n{links}\ncheckerboard {{ name link1000 }}\n"
        "lambert { name chained Kd_color link0 }\nsphere { name other shader chained }\n"
    )
    assert codes(scene) == ["limit-shader-depth"]


def test_a_picture_that_is_too_large(tmp_path: Path) -> None:
    assert "limit-image-size" in codes(
        ROOT / "tests/scenes/still.ass", size=(2_000_000, 2_000_000)
    )


def test_deep_nesting_in_a_scene_file(tmp_path: Path) -> None:
    scene = tmp_path / "nested.ass"
    scene.write_text("options { " * 100_000)
    assert len(codes(scene)) >= 1


def test_a_file_that_includes_itself(tmp_path: Path) -> None:
    scene = tmp_path / "self.ass"
    scene.write_text('include "self.ass"\n' + STILL)
    assert len(codes(scene)) >= 1


def test_noise_is_no_scene(tmp_path: Path) -> None:
    scene = tmp_path / "noise.ass"
    scene.write_bytes(np.random.default_rng(1).integers(0, 256, 100_000, np.uint8).tobytes())
    assert len(codes(scene)) >= 1


def test_a_scene_that_does_not_fit_into_memory(tmp_path: Path) -> None:
    n = 4_000_000
    scene = tmp_path / "large.ass"
    scene.write_text(f"polymesh {{ name large vlist {n} 1 VECTOR\n" + "0 0 0\n" * n + "}\n")
    # Not from the start: the libraries themselves reserve more than a gigabyte of addresses.
    code = (
        "import resource, sys, lightsieve.rendering\n"
        "from lightsieve.cli.main import main\n"
        "now = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
        "resource.setrlimit(resource.RLIMIT_AS, (now + 64_000_000,) * 2)\n"
        f"sys.argv = ['lightsieve', 'check', {str(scene)!r}]\n"
        "main()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1, done.stderr
    assert done.stderr.startswith("error[limit-memory]: not enough memory\n")


def test_light_that_is_infinite_is_left_out_and_described(tmp_path: Path) -> None:
    scene = tmp_path / "infinite.ass"
    scene.write_text(
        'options { xres 8 yres 8 camera "c" outputs "RGBA RGBA f d" }\n'
        "persp_camera { name c exposure 10 }\nbox_filter { name f }\n"
        'driver_exr { name d filename "x.exr" }\nflat { name bright color 3e38 3e38 3e38 }\n'
        'sphere { name s center 0 0 -3 radius 0.3 shader "bright" }\n'
    )
    frame = lightsieve.render(scene)
    assert np.isfinite(frame.layer("RGBA")).all()
    (warning,) = [item for item in frame.diagnostics if item.code == "render-non-finite"]
    assert "arriving as O after 0 scattering events" in warning.rendered
