"""Deep files, clamps and cameras, seen from outside by PyPI's OpenImageIO and OpenEXR."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import OpenEXR
import OpenImageIO as oiio  # noqa: N813
import pytest

import lightsieve

SCENE = """
options
{
 xres 24
 yres 18
 AA_samples 3
 GI_diffuse_depth 1
 camera "cam"
 OUTPUTS
}
gaussian_filter { name filter }
closest_filter { name near }
persp_camera { name cam fov 40 position 0 0.5 5 look_at 0 0 0 }
persp_camera { name side fov 40 position 5 0.5 0 look_at 0 0 0 }
lambert { name solid }
lambert { name veil Kd_color 1 0.2 0.2 opacity 0.4 0.4 0.4 }
sphere { name ball radius 0.5 shader solid }
sphere { name bubble radius 1 shader veil }
quad_light { name key matrix 1 0 0 0  0 0 -1 0  0 1 0 0  0 4 0 1 intensity 40 camera 1 }
skydome_light { name sky intensity 0.2 }
"""


def written(folder: Path, outputs: list[str], drivers: str, options: str = "") -> lightsieve.Frame:
    """Renders the scene into a folder."""
    strings = " ".join(f'"{output}"' for output in outputs)
    text = SCENE.replace("OUTPUTS", f"{options}\n outputs {len(outputs)} 1 STRING {strings}")
    scene = folder / "shot.ass"
    scene.write_text(text + drivers)
    return lightsieve.render(scene, output=f"{folder}/")


Deep = dict[str, list[npt.NDArray[Any]]]


def read_deep(path: Path) -> Deep:
    """By channel: for each pixel an array of samples."""
    source = oiio.ImageInput.open(str(path))
    assert source is not None
    assert source.spec().deep
    data = source.read_native_deep_image()
    assert data is not None
    names = source.spec().channelnames
    found: Deep = {
        name: [
            np.array([data.deep_value(p, c, s) for s in range(data.samples(p))])
            for p in range(data.pixels)
        ]
        for c, name in enumerate(names)
    }
    source.close()
    return found


def flattened(deep: Deep, channel: str) -> npt.NDArray[Any]:
    """Every sample over those behind it."""
    out = []
    for alphas, values in zip(deep["A"], deep[channel], strict=True):
        left = np.concatenate([[1.0], np.cumprod(1 - alphas)])[:-1]
        out.append(float((left * values).sum()))
    return np.array(out)


@pytest.mark.parametrize("driver", ["", "tiled on subpixel_merge off", "depth_tolerance 0.5"])
def test_deep_files_flatten_to_the_picture(tmp_path: Path, driver: str) -> None:
    outputs = [
        "RGBA RGBA filter deep", "diffuse_direct RGB filter deep", "Z FLOAT near deep",
        "RGBA RGBA filter flat", "diffuse_direct RGB filter flat",
    ]  # fmt: skip
    frame = written(
        tmp_path,
        outputs,
        f"driver_deepexr {{ name deep filename deep.exr {driver} }}\n"
        "driver_exr { name flat filename flat.exr }\n",
    )
    assert not frame.diagnostics
    deep = read_deep(tmp_path / "deep.exr")
    assert set(deep) == {
        "A", "Z", "ZBack", "R", "G", "B",
        "diffuse_direct.R", "diffuse_direct.G", "diffuse_direct.B",
    }  # fmt: skip
    with OpenEXR.File(str(tmp_path / "flat.exr"), separate_channels=True) as file:
        flat = {name: c.pixels.ravel() for name, c in file.parts[0].channels.items()}
    for name, pixels in flat.items():
        np.testing.assert_allclose(
            flattened(deep, name), pixels, rtol=2e-3, atol=2e-4, err_msg=name
        )


def test_deep_samples_lie_where_surfaces_are(tmp_path: Path) -> None:
    written(
        tmp_path,
        ["RGBA RGBA filter deep"],
        "driver_deepexr { name deep filename deep.exr depth_tolerance 0.02 }\n",
        "background NULL",
    )
    deep = read_deep(tmp_path / "deep.exr")
    middle = 9 * 24 + 12
    # Bubble, ball, and nothing behind what is opaque; the camera is 5 away, a little above.
    depths, alphas = deep["Z"][middle], deep["A"][middle]
    bubble, ball = depths < 4.3, (depths > 4.3) & (depths < 4.9)
    assert bubble.any()
    assert ball.any()
    assert depths.max() < 4.9
    assert (deep["ZBack"][middle] >= depths).all()
    let_through = float(np.prod(1 - alphas[bubble]))
    assert let_through == pytest.approx(0.6, abs=2e-3)
    assert np.prod(1 - alphas) == pytest.approx(0, abs=1e-3)
    # A corner shows the sky, which has no depth.
    assert deep["Z"][0].max() >= 1e29


def test_deep_files_hold_light_only(tmp_path: Path) -> None:
    with pytest.raises(lightsieve.LightsieveError) as caught:
        written(
            tmp_path,
            ["RGBA RGBA filter deep", "N VECTOR near deep"],
            "driver_deepexr { name deep filename deep.exr }\n",
        )
    assert caught.value.errors[0].code == "output-layers"


def test_what_clamps_took_is_verified(tmp_path: Path) -> None:
    written(
        tmp_path,
        [f"{aov} RGB filter exr" for aov in ("RGBA", "clamp_loss", "unclamped")],
        "driver_exr { name exr filename a.exr half_precision on }\n",
        "AA_sample_clamp 0.3",
    )
    result = lightsieve.exr.verify(tmp_path / "a.exr")
    checks = {check.text: check for check in result.checks}
    assert checks["unclamped = RGBA + clamp_loss"].passed
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        assert file.parts[0].channels["clamp_loss.R"].pixels.max() > 0.05


def test_cameras_have_files_of_their_own_or_share_one(tmp_path: Path) -> None:
    written(
        tmp_path,
        [
            "cam RGBA RGBA filter front", "side RGBA RGBA filter beside",
            "cam RGBA RGBA filter both front", "side RGBA RGBA filter both beside",
        ],
        "".join(
            f"driver_exr {{ name {name} filename {name}.exr }}\n"
            for name in ("front", "beside", "both")
        ),
    )  # fmt: skip
    channels = {}
    for name in ("front", "beside", "both"):
        with OpenEXR.File(str(tmp_path / f"{name}.exr"), separate_channels=True) as file:
            channels[name] = {n: c.pixels for n, c in file.parts[0].channels.items()}
    for name in ("front", "beside"):
        np.testing.assert_array_equal(channels[name]["R"], channels["both"][f"{name}.R"])
    assert not np.array_equal(channels["front"]["R"], channels["beside"]["R"])


def test_regions_are_data_windows_and_go_on_with_files(tmp_path: Path) -> None:
    driver = "driver_exr { name exr filename a.exr append on }\n"
    for low, high in ((-2, 9), (10, 20)):
        written(
            tmp_path,
            ["RGBA RGBA filter exr"],
            driver,
            f"region_min_x {low}\n region_max_x {high}\n region_min_y 3\n region_max_y 12",
        )
    with OpenEXR.File(str(tmp_path / "a.exr")) as file:
        header = file.parts[0].header
        assert header["displayWindow"][1].tolist() == [23, 17]
        assert header["dataWindow"][0].tolist() == [-2, 3]
        assert header["dataWindow"][1].tolist() == [20, 12]
        appended = file.parts[0].channels["RGBA"].pixels
    whole = written(
        tmp_path, ["RGBA RGBA filter whole"], "driver_exr { name whole filename w.exr }\n"
    )
    np.testing.assert_array_equal(appended[:, 2:], whole.layer("RGBA")[3:13, :21])
