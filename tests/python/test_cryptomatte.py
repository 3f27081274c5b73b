"""Cryptomattes as compositing programs see them: channels, header, manifest by PyPI's OpenEXR.

Names are those whose ids the specification gives, so no hash of ours is needed to judge them.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import OpenEXR
import pytest

import lightsieve

IDS = {"bunny": 0x13851A76, "default": 0x42C9679F, "bunny_porcelain_mat": 0xB24B26D4}

SCENE = """
options
{
 xres 32
 yres 24
 AA_samples 3
 camera "cam"
 aov_shaders "marks"
 outputs 4 1 STRING
  "RGBA RGBA filter exr" "crypto_object RGB filter exr" "crypto_asset RGB filter exr"
  "crypto_material RGB filter exr"
}
gaussian_filter { name filter }
ortho_camera { name cam position 0 0 5 screen_window_min -1 -1 screen_window_max 1 1 }
lambert { name bunny_porcelain_mat opacity 0.5 0.5 0.5 }
sphere { name bunny radius 0.6 shader bunny_porcelain_mat }
"""


def rendered(folder: Path, driver: str = "", shader: str = "") -> Path:
    path = folder / "shot.exr"
    scene = folder / "shot.ass"
    scene.write_text(
        f"{SCENE}\ncryptomatte {{ name marks {shader} }}\n"
        f'driver_exr {{ name exr filename "{path}" {driver} }}\n'
    )
    lightsieve.render(scene, write=True)
    return path


def parts_of(path: Path) -> tuple[dict[str, npt.NDArray[Any]], dict[str, Any]]:
    """Channels and attributes of all parts."""
    channels: dict[str, npt.NDArray[Any]] = {}
    attributes: dict[str, Any] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:
            channels |= {name: channel.pixels for name, channel in part.channels.items()}
            attributes |= part.header
    return channels, attributes


def mask(channels: dict[str, npt.NDArray[Any]], matte: str, name: str) -> npt.NDArray[Any]:
    """What a decoder does: the coverage of an id, from all pairs of channels."""
    total = np.zeros(channels["A"].shape, np.float64)
    for layer in ("00", "01", "02"):
        for key, value in (("R", "G"), ("B", "A")):
            found = channels[f"{matte}{layer}.{key}"]
            assert found.dtype == np.float32
            chosen = np.ascontiguousarray(found).view(np.uint32) == IDS[name]
            total += np.where(chosen, channels[f"{matte}{layer}.{value}"], 0)
    return total


def metadata(attributes: dict[str, Any]) -> dict[str, dict[str, str]]:
    """By the matte's name."""
    by_key: dict[str, dict[str, str]] = {}
    for name, value in attributes.items():
        if name.startswith("cryptomatte/"):
            _, key, field = name.split("/")
            by_key.setdefault(key, {})[field] = value
    return {fields["name"]: fields | {"key": key} for key, fields in by_key.items()}


@pytest.mark.parametrize("driver", ["tiled on", "tiled off half_precision on", "multipart on"])
def test_masks_cover_what_alpha_says(tmp_path: Path, driver: str) -> None:
    channels, _ = parts_of(rendered(tmp_path, driver))
    tolerance = 2**-10 if "half" in driver else 1e-6
    for matte, name in (
        ("crypto_object", "bunny"),
        ("crypto_asset", "default"),
        ("crypto_material", "bunny_porcelain_mat"),
    ):
        np.testing.assert_allclose(
            mask(channels, matte, name), channels["A"], atol=tolerance, err_msg=matte
        )
    # Half of the light passes at the front of the ball, half of that at its back: both are it.
    assert channels["A"].max() == pytest.approx(0.75, abs=1e-6)
    assert not any(name.startswith("crypto_object.") for name in channels)


def test_headers_name_mattes(tmp_path: Path) -> None:
    _, attributes = parts_of(rendered(tmp_path))
    found = metadata(attributes)
    assert set(found) == {"crypto_object", "crypto_asset", "crypto_material"}
    for fields in found.values():
        assert fields["hash"] == "MurmurHash3_32"
        assert fields["conversion"] == "uint32_to_float32"
        assert len(fields["key"]) == 7
    manifests = {name: json.loads(fields["manifest"]) for name, fields in found.items()}
    assert manifests == {
        "crypto_object": {"bunny": f"{IDS['bunny']:08x}"},
        "crypto_asset": {"default": f"{IDS['default']:08x}"},
        "crypto_material": {"bunny_porcelain_mat": f"{IDS['bunny_porcelain_mat']:08x}"},
    }


def test_manifests_can_lie_beside_the_file(tmp_path: Path) -> None:
    path = rendered(tmp_path, shader="sidecar_manifests on")
    found = metadata(parts_of(path)[1])
    for name, fields in found.items():
        assert "manifest" not in fields
        assert fields["manif_file"] == f"shot.{name}.json"
        assert json.loads((tmp_path / fields["manif_file"]).read_text())


@pytest.mark.parametrize("compression", ["dwaa", "dwab", "pxr24"])
def test_ids_survive_the_choice_of_a_lossy_compression(tmp_path: Path, compression: str) -> None:
    path = rendered(tmp_path, f"compression {compression}")
    channels, attributes = parts_of(path)
    assert attributes["compression"] == OpenEXR.ZIP_COMPRESSION
    np.testing.assert_allclose(mask(channels, "crypto_object", "bunny"), channels["A"], atol=1e-6)


def test_layer_names_are_names_of_mattes(tmp_path: Path) -> None:
    scene = SCENE.replace("crypto_object RGB filter exr", "crypto_object RGB filter exr shapes")
    path, text = tmp_path / "a.exr", tmp_path / "a.ass"
    text.write_text(
        f'{scene}\ncryptomatte {{ name marks }}\ndriver_exr {{ name exr filename "{path}" }}\n'
    )
    lightsieve.render(text, write=True)
    channels, attributes = parts_of(path)
    assert "shapes" in metadata(attributes)
    np.testing.assert_allclose(mask(channels, "shapes", "bunny"), channels["A"], atol=1e-6)
