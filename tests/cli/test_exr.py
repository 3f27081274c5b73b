"""`lightsieve exr info`, `verify`, `diff` and `sheet`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from PIL import Image

from lightsieve.cli import exr_diff, exr_info, exr_sheet, exr_verify
from tests.conftest import ROOT, Run

STILL = ROOT / "tests/scenes/still.ass"
AOVS = [
    word
    for name in ("diffuse RGB", "diffuse_direct RGB", "diffuse_indirect RGB", "Z FLOAT", "ID UINT")
    for word in ("--aov", name)
]
LAYERS = {"RGBA", "diffuse", "diffuse_direct", "diffuse_indirect", "mirrored", "Z", "ID"}


@pytest.fixture
def frame(run: Run) -> str:
    """An EXR file with a sum that was proved."""
    done = run(
        "render",
        STILL,
        "--spp",
        "2",
        "--size",
        "32x24",
        "-o",
        "frame.exr",
        *AOVS,
        "--lpe",
        "mirrored CS[LOB]",
    )
    assert done.code == 0, done.err
    return "frame.exr"


def spoil(path: Path, layer: str) -> None:
    """Adds light to one layer of a file, with another maker's library."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        header, channels = file.header(), dict(file.channels())
        channels[f"{layer}.R"].pixels[5, 7] += 0.25
        channels = {name: channel.pixels for name, channel in channels.items()}
        OpenEXR.File(header, channels).write(str(path))


def test_info_tells_layers_with_expressions(run: Run, frame: str) -> None:
    done = run("exr", "info", frame)
    assert done.code == 0
    assert done.out.startswith("frame.exr: 32 x 24, ")
    rows = {line.split()[0]: line for line in done.out.splitlines()[1:]}
    assert set(rows) == LAYERS
    assert "C<RD>.*" in rows["diffuse"]
    assert "CS[LOB]" in rows["mirrored"]


def test_info_as_json(run: Run, frame: str) -> None:
    document = run("exr", "info", frame, "--json").json
    assert list(document) == list(exr_info.JSON)
    layers = {layer["name"]: layer for layer in document["layers"]}
    assert layers["diffuse"]["channels"] == ["R", "G", "B"]
    assert layers["ID"]["type"] == "uint"


def test_verify_passes_an_honest_file(run: Run, frame: str) -> None:
    done = run("exr", "verify", frame)
    assert done.code == 0
    assert "diffuse = diffuse_direct + diffuse_indirect" in done.out
    document = run("exr", "verify", frame, "--json").json
    assert list(document) == list(exr_verify.JSON)
    assert document["passed"] is True


def test_verify_finds_a_pixel_that_was_changed(run: Run, frame: str, tmp_path: Path) -> None:
    spoil(tmp_path / frame, "diffuse")
    done = run("exr", "verify", frame)
    assert done.code == 1
    assert "DOES NOT ADD UP" in done.out
    worst = run("exr", "verify", frame, "--json").json["checks"][0]["worst"]
    assert (worst["x"], worst["y"], worst["channel"]) == (7, 5, "R")
    assert worst["residual"] == pytest.approx(0.25, rel=1e-4)


def test_diff_measures_each_layer(run: Run, frame: str, tmp_path: Path) -> None:
    (tmp_path / "other.exr").write_bytes((tmp_path / frame).read_bytes())
    assert run("exr", "diff", "other.exr", frame, "--max-rmse", "0").code == 0
    spoil(tmp_path / "other.exr", "mirrored")
    document = run("exr", "diff", "other.exr", frame, "--json").json
    assert list(document) == list(exr_diff.JSON)
    layers = {layer["name"]: layer for layer in document["layers"]}
    assert layers["diffuse"]["different"] == 0
    assert layers["mirrored"]["different"] == 1
    assert layers["mirrored"]["max_at"] == {"x": 7, "y": 5}
    assert layers["diffuse"]["flip"] == 0
    assert 0 < layers["mirrored"]["flip"] < 0.1
    assert layers["Z"]["flip"] is None
    assert layers["mirrored"]["rmse"] == pytest.approx(0.25 / np.sqrt(32 * 24 * 3), rel=1e-3)
    assert run("exr", "diff", "other.exr", frame, "--max-rmse", "1e-4").code == 1


def test_diff_writes_a_picture(run: Run, frame: str, tmp_path: Path) -> None:
    done = run("exr", "diff", frame, frame, "-o", "difference.png")
    assert done.code == 0, done.err
    with Image.open(tmp_path / "difference.png") as picture:
        assert picture.size == (32, 24)
        assert picture.convert("RGB").getextrema() == ((0, 0), (0, 0), (0, 0))


def test_sheet_shows_every_layer(run: Run, frame: str, tmp_path: Path) -> None:
    done = run("exr", "sheet", frame, "--columns", "2", "--json")
    assert done.code == 0, done.err
    assert list(done.json) == list(exr_sheet.JSON)
    assert set(done.json["layers"]) == LAYERS
    with Image.open(tmp_path / "frame.png") as sheet:
        assert sheet.width > 2 * 320
        assert len(sheet.getcolors(1 << 24) or []) > 100


@pytest.mark.parametrize("command", ["info", "verify", "sheet"])
@pytest.mark.parametrize(
    ("name", "code"), [("nowhere.exr", "file-not-found"), ("text.exr", "file-format")]
)
def test_bad_files(run: Run, tmp_path: Path, command: str, name: str, code: str) -> None:
    (tmp_path / "text.exr").write_text("this is no picture")
    done = run("exr", command, name)
    assert done.code == 1
    assert f"error[{code}]" in done.err


def test_diff_of_unlike_sizes(run: Run, frame: str) -> None:
    assert run("render", STILL, "--spp", "1", "--size", "8x6", "-o", "small.exr").code == 0
    done = run("exr", "diff", "small.exr", frame)
    assert done.code == 1
    assert "error[picture-size]" in done.err
    done = run("exr", "diff", frame, frame, "-o", "difference.png", "--layer", "difuse")
    assert done.code == 1
    assert "error[unknown-layer]" in done.err


def test_sheet_that_cannot_be_written(run: Run, frame: str) -> None:
    done = run("exr", "sheet", frame, "-o", "/proc/sheet.png")
    assert done.code == 1
    assert "error[file-unwritable]" in done.err
