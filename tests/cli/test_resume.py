"""`render --resume`: whatever ends a render, what was saved is safe and the rest follows."""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import ROOT, Run

STILL = ROOT / "tests/scenes/still.ass"
SIZE = ("--size", "64x48", "--set", "options.bucket_size=16", "--aov", "diffuse_*")
FEW, MANY, VERY_MANY = 40, 100, 400
N_PIXELS = 64 * 48

# Renders as the command line does, and kills itself once so many samples are done.
KILLED = """
import os, signal, sys
from lightsieve.rendering import compile_scene
samples = int(sys.argv[1])
def kill(now):
    if now.samples_done >= samples:
        os.kill(os.getpid(), signal.SIGKILL)
compile_scene("still.ass", capture=False, write_files=True, size=(64, 48), spp=int(sys.argv[2]),
              set={"options.bucket_size": 16}, aovs=["diffuse_*"],
              checkpoint=1e-9, resume=True, threads=2).render(kill)
"""


@pytest.fixture
def still(tmp_path: Path) -> Path:
    """The scene in the folder where commands run."""
    return Path(shutil.copy(STILL, tmp_path))


def pixels(folder: Path, name: str) -> bytes:
    """The picture's pixels as bytes: files differ in when they were made."""
    import OpenImageIO

    values = OpenImageIO.ImageBuf(str(folder / name)).get_pixels(OpenImageIO.FLOAT)
    assert values is not None
    return bytes(values.tobytes())


def test_killed_twenty_times_and_still_the_same_bits(
    run: Run, still: Path, tmp_path: Path
) -> None:
    assert run("render", still.name, *SIZE, "--spp", VERY_MANY, "-o", "whole.exr").code == 0
    n_saved = 0
    for step in range(20):
        # Up to twice what two threads take before their first buckets are saved.
        samples = (step * 7919) % 65536
        ended = subprocess.run(
            [sys.executable, "-c", KILLED, str(samples), str(VERY_MANY)],
            cwd=tmp_path,
            capture_output=True,
            timeout=120,
            check=False,
        )
        # A quick machine may be done before its time comes; the next one begins anew.
        assert ended.returncode in (0, -9), ended.stderr
        n_saved += (tmp_path / "still.exr.checkpoint").exists()
    assert n_saved > 0
    done = run("render", still.name, *SIZE, "--spp", VERY_MANY, "--resume")
    assert done.code == 0, done.err
    assert pixels(tmp_path, "still.exr") == pixels(tmp_path, "whole.exr")
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {"still.ass", "still.exr", "whole.exr"}


def test_goes_on_with_more_samples(run: Run, still: Path, tmp_path: Path) -> None:
    assert run("render", still.name, *SIZE, "--spp", MANY, "-o", "whole.exr").code == 0
    assert run("render", still.name, *SIZE, "--spp", FEW, "--keep-checkpoint").code == 0
    done = run("render", still.name, *SIZE, "--spp", MANY, "--resume", "--json").json
    assert done["resumed_samples"] == FEW * N_PIXELS
    assert done["samples"] == (MANY - FEW) * N_PIXELS
    assert done["checkpoint"] is None
    assert pixels(tmp_path, "still.exr") == pixels(tmp_path, "whole.exr")


def test_a_guide_is_learned_anew_from_as_many_samples(
    run: Run, still: Path, tmp_path: Path
) -> None:
    guided = ("render", still.name, *SIZE, "--guiding", "--json")
    first = run(*guided, "--spp", FEW, "--keep-checkpoint").json
    assert first["training_samples"] > 0
    before = pixels(tmp_path, "still.exr")
    again = run(*guided, "--spp", FEW, "--resume", "--keep-checkpoint").json
    assert again["samples"] == 0
    assert pixels(tmp_path, "still.exr") == before
    more = run(*guided, "--spp", MANY, "--resume")
    assert more.code == 1
    assert "guiding: then" in more.out


def test_another_render_is_refused_and_says_why(run: Run, still: Path, tmp_path: Path) -> None:
    assert run("render", still.name, *SIZE, "--spp", FEW, "--keep-checkpoint").code == 0
    before = (tmp_path / "still.exr.checkpoint").read_bytes()
    for changes, reason in (
        (("--aov", "specular"), "layers: then"),
        (("--seed", "7"), "seed: then"),
        (("--set", "options.GI_diffuse_depth=1"), "scene: then"),
        (("--spp", "4"), f"up to {FEW} samples a pixel"),
    ):
        done = run("render", still.name, *SIZE, "--spp", FEW, *changes, "--resume")
        assert done.code == 1
        assert "error[checkpoint-other]" in done.err
        assert reason in done.err
        assert "render without --resume" in done.err
    assert (tmp_path / "still.exr.checkpoint").read_bytes() == before


def test_nothing_to_resume_is_a_render_from_the_beginning(run: Run, still: Path) -> None:
    done = run("render", still.name, *SIZE, "--spp", "1", "--resume", "--json")
    assert done.code == 0
    assert done.json["resumed_samples"] == 0


def test_asking_for_one_and_forbidding_it(run: Run, still: Path) -> None:
    done = run("render", still.name, "--no-checkpoint", "--resume")
    assert done.code == 2
    assert "--no-checkpoint forbids" in done.err


def test_no_room_for_a_checkpoint_is_a_warning(run: Run, still: Path, tmp_path: Path) -> None:
    first = run("render", still.name, *SIZE, "--spp", "2", "--keep-checkpoint")
    assert first.code == 0
    saved = tmp_path / "still.exr.checkpoint"
    # Files may be no larger than this, as on a full disk.
    limit = saved.stat().st_size * 2 // 3
    saved.unlink()
    program = (
        "import resource, signal, sys; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {resource.RLIM_INFINITY})); "
        "from lightsieve.cli.main import main; main()"
    )
    done = subprocess.run(
        [
            *(sys.executable, "-c", program, "render", still.name, *SIZE, "--spp", "2"),
            *("--checkpoint", "1e-9", "--keep-checkpoint"),
        ],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "could not be written: File too large" in done.stderr
    assert (tmp_path / "still.exr").is_file()
    # What it had before is whole: a render goes on from it.
    rest = run("render", still.name, *SIZE, "--spp", "2", "--resume", "--json").json
    assert 0 < rest["resumed_samples"] < 2 * N_PIXELS
