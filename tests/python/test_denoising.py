"""`lightsieve.denoise`: what changes in a file, and that nothing else does."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
import pytest

import lightsieve
from lightsieve import exr
from lightsieve.denoise_oidn import Denoiser
from lightsieve.denoising import Denoised
from lightsieve.rendering import Settings
from tests.conftest import ROOT

STILL = (ROOT / "tests/scenes/still.ass").read_text()
LIGHT = [
    "RGBA RGBA",
    "RGBA_* RGB",
    "diffuse RGB",
    "diffuse_direct RGB",
    "diffuse_indirect RGB",
    "specular RGB",
    "coat RGB",
    "emission RGB",
    "background RGB",
]
DATA = ["albedo RGB", "N VECTOR", "Z FLOAT", "ID UINT", "volume_opacity RGB"]
SUMS = {
    "RGBA = RGBA_key + RGBA_default",
    "diffuse = diffuse_direct + diffuse_indirect",
}


def render(
    folder: Path,
    name: str,
    outputs: list[str],
    *,
    driver: str = "",
    more: tuple[str, ...] = (),
    spp: int = 2,
    seed: int = 1,
    size: tuple[int, int] = (48, 32),
    region: tuple[int, int, int, int] | None = None,
) -> Path:
    """Renders the still life with outputs of a Gaussian filter and a driver of that kind."""
    lines = [f'"{output} soft file"' for output in outputs] + [f'"{line}"' for line in more]
    scene = STILL.replace(
        'camera "cam" }', f'camera "cam" outputs {len(lines)} 1 STRING {" ".join(lines)} }}'
    )
    scene += f"""
    gaussian_filter {{ name soft width 2 }}
    closest_filter {{ name nearest }}
    variance_filter {{ name spread }}
    driver_exr {{ name file filename "{name}" {driver} }}
    """
    (folder / "scene.ass").write_text(scene)
    settings: Settings = {"spp": spp, "seed": seed, "size": size, "output": folder}
    if region is not None:
        settings["region"] = region
    lightsieve.render(folder / "scene.ass", **settings)
    return folder / name


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("denoising")


@pytest.fixture(scope="module")
def noisy(folder: Path) -> Path:
    return render(folder, "frame.exr", LIGHT + DATA)


def denoise(file: Path, *where: Path, **named: Any) -> Denoised:
    """On one thread: several tests at a time would wait for one another."""
    return lightsieve.denoise(file, *where, **{"threads": 1, **named})


def bits(frame: lightsieve.Frame, name: str) -> bytes:
    return frame.layer(name).tobytes()


def test_layers_still_add_up_and_data_stays(noisy: Path) -> None:
    done = denoise(noisy)
    assert done.file == str(noisy.with_name("frame_denoised.exr"))
    assert set(done.sums) == SUMS
    result = exr.verify(done.file)
    assert result.passed
    checked = {check.text for check in result.checks if check.checked}
    assert checked >= SUMS
    before, after = exr.read(noisy), exr.read(done.file)
    assert after.layers() == before.layers()
    assert set(done.kept) == {"albedo", "N", "Z", "ID", "volume_opacity"}
    assert set(done.layers) | set(done.kept) == set(before.layers())
    for name in done.kept:
        assert bits(before, name) == bits(after, name)
    assert before.layer("RGBA")[:, :, 3].tobytes() == after.layer("RGBA")[:, :, 3].tobytes()
    for name in done.layers:
        assert after.layer(name).min() >= 0
        assert before.layer(name).any() == (bits(before, name) != bits(after, name))
    assert (done.albedo, done.normal, done.nonfinite) == (("albedo",), "N", {})


def test_the_header_keeps_what_it_said_and_tells_what_was_done(noisy: Path) -> None:
    done = denoise(noisy)
    before, after = exr.info(noisy), exr.info(done.file)
    added = {
        name: value
        for name, value in after.attributes.items()
        if before.attributes.get(name) != value
    }
    assert set(added) == {"lightsieve/denoiser", "lightsieve/denoised"}
    assert str(added["lightsieve/denoiser"]).startswith("Open Image Denoise ")
    assert str(added["lightsieve/denoiser"]).endswith(", with albedo N")
    assert str(added["lightsieve/denoised"]).splitlines() == list(done.layers)
    assert set(before.attributes) <= set(after.attributes)
    assert [layer.expression for layer in after.layers] == [
        layer.expression for layer in before.layers
    ]


def test_there_is_less_noise_and_no_other_brightness(folder: Path, noisy: Path) -> None:
    clean = exr.read(render(folder, "clean.exr", LIGHT, spp=48, seed=7))
    before, after = exr.read(noisy), exr.read(denoise(noisy).file)
    for name in ("RGBA", "diffuse", "diffuse_indirect", "RGBA_key"):
        a, b, c = (f.layer(name)[:, :, :3] for f in (before, after, clean))
        assert ((b - c) ** 2).mean() < 0.6 * ((a - c) ** 2).mean(), name
        assert b.mean(axis=(0, 1)) == pytest.approx(a.mean(axis=(0, 1)), rel=0.05)


@pytest.mark.parametrize(
    ("driver", "type_"),
    [
        ("half_precision on", "half"),
        ("multipart on", "float"),
        ("tiled off compression piz", "float"),
        ("compression dwaa", "float"),
        ("multipart on tiled off half_precision on compression b44", "half"),
    ],
)
def test_files_of_every_kind(folder: Path, driver: str, type_: str) -> None:
    file = render(
        folder, "kind.exr", LIGHT + DATA, driver=driver, size=(40, 30), region=(-4, 5, 43, 24)
    )
    done = denoise(file)
    before, after = exr.info(file), exr.info(done.file)
    for name in ("width", "height", "data_window", "tiled", "n_parts", "n_channels"):
        assert getattr(before, name) == getattr(after, name)
    assert [layer.type for layer in after.layers] == [layer.type for layer in before.layers]
    assert after.layers[0].type == type_
    assert after.compression == ("zip" if before.lossy else before.compression)
    frames = exr.read(file), exr.read(done.file)
    for name in done.kept:
        assert bits(frames[0], name) == bits(frames[1], name)
    assert exr.verify(done.file).passed
    assert set(done.sums) == SUMS


def test_what_filters_leave_no_noise_in_stays(folder: Path) -> None:
    more = ("diffuse RGB nearest file one", "diffuse RGB spread file spread_of_it")
    file = render(folder, "filters.exr", ["RGBA RGB", "diffuse FLOAT"], more=more)
    done = denoise(file)
    assert set(done.layers) == {"RGBA", "diffuse"}
    assert set(done.kept) == {"one", "spread_of_it"}
    assert (done.albedo, done.normal) == ((), "")
    assert exr.read(done.file).layer("diffuse").shape == (32, 48, 1)


def test_partial_albedos_are_added_up(folder: Path) -> None:
    file = render(folder, "parts.exr", ["RGBA RGBA", "specular_albedo RGB", "diffuse_albedo RGB"])
    assert denoise(file).albedo == ("diffuse_albedo", "specular_albedo")


def test_another_file_may_help(folder: Path) -> None:
    bare = render(folder, "bare.exr", ["RGBA RGBA"])
    helpers = render(folder, "helpers.exr", ["albedo RGB", "N VECTOR"])
    alone = exr.read(denoise(bare).file).layer("RGBA").copy()
    done = denoise(bare, helpers=helpers)
    assert (done.albedo, done.normal) == (("albedo",), "N")
    assert (exr.read(done.file).layer("RGBA") != alone).any()
    small = render(folder, "small.exr", ["albedo RGB"], size=(32, 24))
    with pytest.raises(lightsieve.LightsieveError) as error:
        denoise(bare, helpers=small)
    assert error.value.errors[0].code == "picture-size"


def test_values_that_are_no_numbers_are_replaced(folder: Path, noisy: Path) -> None:
    spoilt = folder / "spoilt.exr"
    with OpenEXR.File(str(noisy), separate_channels=True) as file:
        header, channels = file.header(), dict(file.channels())
        channels["diffuse.R"].pixels[5:9, 7:12] = np.nan
        channels["R"].pixels[20, 30] = np.inf
        channels["emission.G"].pixels[:] = np.nan
        channels = {name: channel.pixels for name, channel in channels.items()}
        OpenEXR.File(header, channels).write(str(spoilt))
    done = denoise(spoilt)
    assert done.nonfinite == {"RGBA": 1, "diffuse": 20, "emission": 48 * 32}
    frame = exr.read(done.file)
    assert all(np.isfinite(frame.layer(name)).all() for name in done.layers)
    assert exr.verify(done.file).passed
    sound = exr.read(denoise(noisy).file)
    assert frame.layer("diffuse")[6, 9, 0] == pytest.approx(
        sound.layer("diffuse")[6, 9, 0], rel=0.3
    )


@pytest.mark.parametrize("size", [(1, 1), (3, 70)])
def test_small_pictures_keep_their_brightness(size: tuple[int, int]) -> None:
    denoiser = Denoiser()
    light = np.full((*size, 3), 0.7, np.float32)
    assert denoiser.denoise(light).mean() == pytest.approx(0.7, rel=0.05)
    denoiser.close()


def test_threads_and_quality_may_be_chosen(noisy: Path, tmp_path: Path) -> None:
    steps: list[tuple[str, int, int]] = []
    one = denoise(
        noisy, tmp_path / "one.exr", threads=1, progress=lambda *step: steps.append(step)
    )
    two = denoise(noisy, tmp_path / "two.exr", threads=2)
    fast = denoise(noisy, tmp_path / "fast.exr", quality="fast")
    a, b, c = (exr.read(d.file).layer("RGBA") for d in (one, two, fast))
    assert a == pytest.approx(b, rel=1e-3, abs=1e-4)
    assert (a != c).any()
    assert [done for _, done, _ in steps] == list(range(len(one.layers) + 1))


def code_of(*arguments: Path, **named: Any) -> str:
    with pytest.raises(lightsieve.LightsieveError) as error:
        denoise(*arguments, **named)
    assert error.value.errors[0].hint
    return error.value.errors[0].code


def test_noisy_pictures_are_not_lost_by_mistake(noisy: Path, tmp_path: Path) -> None:
    copy = Path(shutil.copy(noisy, tmp_path / "a.exr"))
    assert code_of(copy, copy) == "denoise"
    assert code_of(copy, tmp_path / "b.exr", in_place=True) == "denoise"
    assert copy.read_bytes() == noisy.read_bytes()
    done = denoise(copy, in_place=True)
    assert done.file == str(copy)
    assert exr.verify(copy).passed
    assert code_of(copy) == "denoise"
    assert [p.name for p in tmp_path.iterdir()] == ["a.exr"]


def test_what_cannot_be_denoised_says_why(folder: Path, noisy: Path, tmp_path: Path) -> None:
    data = render(folder, "data.exr", ["Z FLOAT", "albedo RGB"])
    assert code_of(data) == "denoise"
    assert code_of(tmp_path / "nowhere.exr") == "file-not-found"
    (tmp_path / "text.exr").write_text("this is no picture")
    assert code_of(tmp_path / "text.exr") == "file-format"
    assert code_of(noisy, tmp_path / "none/a.exr") == "file-unwritable"
    assert [p.name for p in tmp_path.iterdir()] == ["text.exr"]


def test_without_the_denoiser_the_hint_says_how_to_get_it(
    noisy: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyoidn", None)
    with pytest.raises(lightsieve.LightsieveError) as error:
        denoise(noisy)
    assert error.value.errors[0].code == "denoiser-missing"
    assert "pip install" in error.value.errors[0].hint
