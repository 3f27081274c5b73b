"""`lightsieve render`: what it writes, what it says, how it stops."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from lightsieve.cli import render
from tests.conftest import ROOT, Run

STILL = ROOT / "tests/scenes/still.ass"
FAST = ("--spp", "1", "--size", "16x12")


@pytest.fixture
def still(tmp_path: Path) -> Path:
    """A scene without outputs in the folder where commands run."""
    return Path(shutil.copy(STILL, tmp_path))


def layers_of(run: Run, file: str) -> list[str]:
    return [layer["name"] for layer in run("exr", "info", file, "--json").json["layers"]]


def test_a_scene_without_outputs_writes_its_beauty(run: Run, still: Path, tmp_path: Path) -> None:
    done = run("render", still.name, *FAST)
    assert done.code == 0, done.err
    assert done.err == ""
    assert "wrote still.exr" in done.out
    assert "192 samples" in done.out
    assert "no errors, no warnings, no lints" in done.out
    assert layers_of(run, "still.exr") == ["RGBA"]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["still.ass", "still.exr"]


def test_json_has_what_the_text_says(run: Run, still: Path) -> None:
    document = run("render", still.name, *FAST, "--json").json
    assert list(document) == list(render.JSON)
    assert document["files"] == ["still.exr"]
    assert (document["width"], document["height"], document["samples"]) == (16, 12, 192)
    assert document["stopped"] is False
    assert (document["errors"], document["warnings"], document["lints"]) == (0, 0, 0)
    assert document["samples_per_second"] > 0


def test_output_may_be_a_file_or_a_folder(run: Run, still: Path, tmp_path: Path) -> None:
    (tmp_path / "pictures").mkdir()
    assert run("render", still.name, *FAST, "-o", "beauty.exr").code == 0
    assert run("render", still.name, *FAST, "-o", "pictures").code == 0
    assert (tmp_path / "beauty.exr").is_file()
    assert (tmp_path / "pictures/still.exr").is_file()


def test_aovs_and_expressions_of_the_command_line_become_layers(run: Run, still: Path) -> None:
    aovs = ["--aov", "diffuse RGB", "--aov", "diffuse_* RGB", "--aov", "Z FLOAT"]
    aovs += ["--lpe", "mirrored CS[LOB]"]
    done = run("render", still.name, *FAST, *aovs)
    assert done.code == 0, done.err
    expected = ["RGBA", "Z", "diffuse", "diffuse_default", "diffuse_key", "mirrored"]
    assert sorted(layers_of(run, "still.exr")) == expected
    assert run("exr", "verify", "still.exr").code == 0


def test_kick_spellings(run: Run, still: Path) -> None:
    as_kick = [
        "-i",
        "still.ass",
        "-o",
        "kick.exr",
        "-r",
        "8",
        "6",
        "-as",
        "2",
        "-t",
        "1",
        "-v",
        "0",
    ]
    document = run("render", *as_kick, "--json").json
    assert document["files"] == ["kick.exr"]
    assert (document["width"], document["height"], document["samples"]) == (8, 6, 8 * 6 * 4)


def test_region_is_a_part_of_the_frame(run: Run, still: Path) -> None:
    document = run("render", still.name, *FAST, "--region", "4,2,11,5", "--json").json
    assert (document["width"], document["height"], document["samples"]) == (8, 4, 32)
    info = run("exr", "info", "still.exr", "--json").json
    assert (info["width"], info["height"]) == (16, 12)
    assert info["data_window"] == {"x": 4, "y": 2, "width": 8, "height": 4}


def test_set_changes_a_parameter(run: Run, still: Path) -> None:
    assert run("render", still.name, *FAST, "-o", "a.exr").code == 0
    done = run(
        "render",
        still.name,
        *FAST,
        "-o",
        "b.exr",
        "--set",
        "key.intensity=0",
        "--set",
        "sun.intensity=0",
    )
    assert done.code == 0, done.err
    difference = run("exr", "diff", "b.exr", "a.exr", "--json").json
    assert difference["layers"][0]["rmse"] > 0.01
    assert run("render", still.name, *FAST, "--set", "key.intensiti=0").code == 1


def test_seed_changes_the_noise_and_nothing_else_does(run: Run, still: Path) -> None:
    for name, extra in {"a": [], "b": ["-t", "2"], "c": ["--seed", "7"]}.items():
        assert run("render", still.name, *FAST, "-o", f"{name}.exr", *extra).code == 0
    assert run("exr", "diff", "a.exr", "b.exr", "--json").json["layers"][0]["different"] == 0
    assert run("exr", "diff", "a.exr", "c.exr", "--json").json["layers"][0]["different"] > 0


def test_quiet_says_nothing(run: Run, still: Path) -> None:
    done = run("render", still.name, *FAST, "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")


def test_strict_makes_unknown_parameters_errors(run: Run, still: Path, tmp_path: Path) -> None:
    still.write_text(still.read_text() + "\nsphere { name extra radiuss 2 }\n")
    warned = run("render", still.name, *FAST)
    assert warned.code == 0
    assert "warning[unknown-param]" in warned.err
    assert "1 warning" in warned.out
    (tmp_path / "still.exr").unlink()
    refused = run("render", still.name, *FAST, "--strict")
    assert refused.code == 1
    assert "error[unknown-param]" in refused.err
    assert not (tmp_path / "still.exr").exists()


def test_an_instruction_set_that_does_not_exist_is_a_usage_error(run: Run, still: Path) -> None:
    done = run("render", still.name, *FAST, "--isa", "avx9")
    assert done.code == 2
    assert "'avx9' is not one of 'sse2', 'avx2', 'avx512'" in done.err


def test_missing_scene(run: Run) -> None:
    done = run("render", "nowhere.ass")
    assert done.code == 1
    assert "error[file-not-found]" in done.err
    assert "nowhere.ass" in done.err


@pytest.mark.parametrize("output", ["no/such/folder/a.exr", "/proc/a.exr", "still.ass/a.exr"])
def test_unwritable_output_is_found_before_the_first_ray(
    run: Run, still: Path, output: str
) -> None:
    # A render of these samples would take days.
    done = run("render", still.name, "--spp", "1000000000", "-o", output, timeout_s=60)
    assert done.code == 1
    assert "error[file-unwritable]" in done.err


def test_a_bad_expression_is_found_before_the_first_ray(run: Run, still: Path) -> None:
    done = run("render", still.name, "--spp", "1000000000", "--lpe", "glossy CGL", timeout_s=60)
    assert done.code == 1
    assert 'AOV "glossy": no event "G"' in done.err


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_a_render_and_keeps_what_was_done(
    still: Path, tmp_path: Path, number: signal.Signals, code: int
) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "lightsieve", "render", still.name, "--spp", "100000", "-t", "2"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        # The file under its temporary name tells that rendering has begun.
        while process.poll() is None and len(os.listdir(tmp_path)) < 2:
            time.sleep(0.02)
        process.send_signal(number)
        # Many minutes of work are left: an end at all shows that it was stopped.
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == code
    assert "stopped by" in err
    assert "what was done is in still.exr" in err
    assert "wrote still.exr" in out
    assert "--resume goes on from still.exr.checkpoint" in out
    assert sorted(os.listdir(tmp_path)) == ["still.ass", "still.exr", "still.exr.checkpoint"]


def test_names_need_not_be_utf8(run: Run, tmp_path: Path) -> None:
    # As exporters on older systems write them.
    scene = (
        'options { outputs 2 1 STRING "RGBA RGBA f d" "RGBA_* RGB f d" }\nbox_filter { name f }\n'
        'driver_exr { name d filename "café.exr" }\npoint_light { name "lumière" aov "clé" }\n'
        'persp_camera { name c }\nsphere { name "sphère" shader "là" }\n'
    )
    (tmp_path / "scene.ass").write_bytes(scene.encode("latin-1"))
    document = run("check", "scene.ass", "--json").json
    assert "RGBA_cl\\udce9" in json.dumps(document)
    done = subprocess.run(
        [sys.executable, "-m", "lightsieve", "render", "scene.ass", *FAST],
        cwd=tmp_path,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert b'"l\xe0"' in done.stderr, "the name of the missing shader"
    assert (tmp_path / os.fsdecode(b"caf\xe9.exr")).is_file()
