"""Our files, opened by other people's readers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR
import OpenImageIO as oiio  # noqa: N813
import pytest

import lightsieve
from tests.conftest import ROOT

STILL = (ROOT / "tests/scenes/still.ass").read_text()

# An output string and the channels that it must become.
OUTPUTS = {
    "RGBA RGBA filter driver": ["R", "G", "B", "A"],
    "diffuse RGB filter driver": ["diffuse.R", "diffuse.G", "diffuse.B"],
    "specular RGBA filter driver": ["specular.R", "specular.G", "specular.B", "specular.A"],
    "direct FLOAT filter driver": ["direct"],
    "coat_key RGB filter driver": ["coat_key.R", "coat_key.G", "coat_key.B"],
    "indirect RGB filter driver bounced": ["bounced.R", "bounced.G", "bounced.B"],
    "sheen RGB filter driver HALF": ["sheen.R", "sheen.G", "sheen.B"],
    "Z FLOAT closest driver": ["Z"],
    "N VECTOR closest driver": ["N.X", "N.Y", "N.Z"],
    "uv VECTOR2 closest driver": ["uv.X", "uv.Y"],
    "ID UINT closest driver": ["ID"],
}


CHANNEL_INDEX = {"R": 0, "G": 1, "B": 2, "A": 3, "X": 0, "Y": 1, "Z": 2}


def scene_with(folder: Path, driver: str, outputs: list[str]) -> Path:
    strings = "\n".join(f'  "{output}"' for output in outputs)
    scene = folder / "shot.ass"
    scene.write_text(
        STILL.replace(
            'camera "cam" }', f'camera "cam"\n outputs {len(outputs)} 1 STRING\n{strings}\n}}'
        )
        + f"\n{driver}\ngaussian_filter {{ name filter }}\nclosest_filter {{ name closest }}\n"
    )
    return scene


@pytest.fixture(params=["tiled on", "tiled off", "multipart on"])
def exr(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[Path, lightsieve.Frame]:
    path = tmp_path / "shot.exr"
    driver = f'driver_exr {{ name driver filename "{path}" {request.param} half_precision off }}'
    scene = scene_with(tmp_path, driver, list(OUTPUTS))
    return path, lightsieve.render(scene, spp=4, write=True)


def channels_of(path: Path) -> dict[str, np.ndarray]:
    """All channels by full name, read with PyPI's OpenEXR."""
    out: dict[str, np.ndarray] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            out |= {name: channel.pixels for name, channel in part.channels.items()}
    return out


def test_openexr_reads_what_memory_holds(exr: tuple[Path, lightsieve.Frame]) -> None:
    path, frame = exr
    channels = channels_of(path)
    assert set(channels) == {name for names in OUTPUTS.values() for name in names}
    for layer in frame.layers():
        pixels = frame.layer(layer)
        names = [n for n in channels if n.split(".")[0] == layer]
        if layer == "RGBA":
            names = ["R", "G", "B", "A"]
        for name in names:
            index = 0 if name == layer else CHANNEL_INDEX[name.rpartition(".")[2]]
            tolerance = 2**-10 if channels[name].dtype == np.float16 else 0
            np.testing.assert_allclose(
                channels[name], pixels[:, :, index], rtol=tolerance, err_msg=name
            )


def test_pixel_types(exr: tuple[Path, lightsieve.Frame]) -> None:
    channels = channels_of(exr[0])
    assert channels["sheen.R"].dtype == np.float16
    assert channels["ID"].dtype == np.uint32
    assert channels["diffuse.R"].dtype == np.float32


def test_openimageio_reads_it(exr: tuple[Path, lightsieve.Frame]) -> None:
    path, frame = exr
    names: set[str] = set()
    source = oiio.ImageInput.open(str(path))
    assert source is not None
    part = 0
    while source.seek_subimage(part, 0):
        names |= set(source.spec().channelnames)
        part += 1
    source.close()
    # OpenImageIO puts a part's name before channels that lack it; ours never do.
    assert names == {name for expected in OUTPUTS.values() for name in expected}
    beauty = oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)
    assert beauty is not None
    assert beauty.shape[:2] == (frame.height, frame.width)


def test_headers_name_expressions(exr: tuple[Path, lightsieve.Frame]) -> None:
    info = lightsieve.exr.info(exr[0])
    layers = {layer.name: layer for layer in info.layers}
    assert layers["coat_key"].expression == "C<RS'coat'>.*"
    assert layers["coat_key"].light_group == "key"
    assert layers["bounced"].source == "indirect"
    assert layers["Z"].filter == "closest_filter"
    assert info.attributes["lightsieve/version"] == lightsieve.__version__


@pytest.mark.parametrize(("kind", "suffix"), [("driver_png", "png"), ("driver_tiff", "tif")])
def test_openimageio_reads_pictures(tmp_path: Path, kind: str, suffix: str) -> None:
    path = tmp_path / f"shot.{suffix}"
    driver = f'{kind} {{ name driver filename "{path}" }}'
    scene = scene_with(tmp_path, driver, ["RGBA RGBA filter driver"])
    lightsieve.render(scene, spp=4, write=True)
    pixels = oiio.ImageBuf(str(path)).get_pixels(oiio.FLOAT)
    assert pixels is not None
    assert pixels.shape == (48, 64, 4)
    # The ball's middle is red, nothing is above it.
    assert pixels[24, 32, 0] > 2 * pixels[24, 32, 1]
    assert pixels[0, 32, 3] == 0
