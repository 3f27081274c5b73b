"""Denoising of finished EXR files so that layers which add up still do.

>>> import lightsieve
>>> lightsieve.denoise("out/frame.exr").file
'out/frame_denoised.exr'
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from pathlib import Path as FilePath
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from lightsieve import _core, exr, lpe
from lightsieve._core import ExrInfo
from lightsieve.denoise_oidn import Denoiser, Picture, Quality
from lightsieve.denoise_sums import (
    Sum,
    box_mean,
    equations,
    parse_sums,
    reconcile,
    rows_of,
    squared_error,
    without_leftovers,
)
from lightsieve.errors import LightsieveError, without_place
from lightsieve.frame import Frame, Layer

__all__ = ["Denoised", "denoise"]

Path = str | os.PathLike[str]
Progress = Callable[[str, int, int], object]

SUFFIX = "_denoised"
# Header attributes; the second has a layer a line.
DENOISER_ATTRIBUTE, LAYERS_ATTRIBUTE = "lightsieve/denoiser", "lightsieve/denoised"
PARTITIONS_ATTRIBUTE = "lightsieve/partitions"

# Filters that mix samples to a mean. What others keep of them is no picture with noise.
MEAN_FILTERS = {
    f"{name}_filter"
    for name in (
        "blackman_harris",
        "box",
        "catrom",
        "contour",
        "gaussian",
        "mitnet",
        "sinc",
        "triangle",
    )
}
# AOVs of light that are no expression.
LIGHT_AOVS = {"RGBA", "RGB", "clamp_loss", "unclamped"}
# What tells the denoiser of the surfaces: the first of these that is there, or the sum of a row.
ALBEDOS = (
    ("albedo",),
    ("denoise_albedo",),
    (
        "diffuse_albedo",
        "sss_albedo",
        "specular_albedo",
        "coat_albedo",
        "transmission_albedo",
        "volume_albedo",
    ),
)
NORMALS = ("N", "N_denoise")
# How far the mean reaches that stands in for a value that is no number, at first [pixels].
PATCH_RADIUS = 2
# Rows of the picture whose layers are brought together at a time: what bounds the memory for that.
BAND_ROWS = 64


class Denoised(NamedTuple):
    """What `denoise` did."""

    file: str
    """The file that was written."""
    layers: tuple[str, ...]
    """Layers that were denoised."""
    kept: tuple[str, ...]
    """Layers that are as they were."""
    sums: tuple[str, ...]
    """Sums that still hold, as the header names them."""
    albedo: tuple[str, ...]
    """Layers that stood for the albedo; none if there were none."""
    normal: str
    """The layer that stood for the normal; empty if there was none."""
    nonfinite: dict[str, int]
    """For each layer that had any: values that were no number or infinite."""


class _Helpers(NamedTuple):
    """The pictures that help, and which layers they are."""

    albedo: Picture | None
    albedo_layers: tuple[str, ...]
    normal: Picture | None
    normal_layer: str


def _refuse(code: str, message: str, hint: str) -> LightsieveError:
    return LightsieveError([without_place(code, message, hint)])


def denoise(
    path: Path,
    output: Path | None = None,
    *,
    in_place: bool = False,
    helpers: Path | None = None,
    quality: Quality = "high",
    threads: int = 0,
    progress: Progress | None = None,
) -> Denoised:
    """Denoises the light in an EXR file; layers that added up still do.

    Every layer of light is denoised by itself with Open Image Denoise; then all of them are moved
    by as little as it takes for the sums that the header names to hold again, no layer below 0.
    Alpha, data (Z, N, ID, albedos, mattes, ...) and everything else in the file stays bit for bit.

    Args:
        path: A file of flat pixels that Lightsieve wrote.
        output: The new file; `FILE_denoised.exr` beside the old one if not given.
        in_place: Replace the file instead.
        helpers: Another file of the same frame, with layers `albedo` and `N` that this one lacks.
        quality: `high`, `balanced` or `fast`.
        threads: 0: as many as the machine has.
        progress: Called with a layer's name, how many are done and how many there are.

    Returns:
        What was denoised, with what help, and what was not.

    Raises:
        LightsieveError: Open Image Denoise is not installed (code `denoiser-missing`); the file is
            missing or damaged, has no light or is denoised already (code `denoise`); the new one
            cannot be written. There is no half-written file then.

    Example:
        >>> done = denoise("out/frame.exr")
        >>> done.sums
        ('diffuse = diffuse_direct + diffuse_indirect',)
    """
    source, target = os.fspath(path), _target(path, output, in_place)
    info = exr.info(source)
    if LAYERS_ATTRIBUTE in info.attributes:
        raise _refuse(
            "denoise", f'"{source}" is denoised already', "denoise the file that was rendered"
        )
    frame = exr.read(source)
    names = [name for name in frame.layers() if _is_light(frame.info(name), frame.layer(name))]
    if not names:
        raise _refuse(
            "denoise",
            f'"{source}" has no layer of light that could be denoised',
            "layers with a light path expression or RGBA, of a filter that mixes samples, can be",
        )
    help_ = _find_helpers(source, frame, info, helpers, names)
    denoiser = Denoiser(help_.albedo, help_.normal, quality=quality, threads=threads)
    try:
        cleaned, nonfinite = _denoise_layers(frame, names, denoiser, progress)
        version = denoiser.version()
    finally:
        denoiser.close()
    sums = _sums_of(info, names)
    _bring_together(frame, cleaned, sums)
    _write(source, target, info, frame, cleaned, sums, _story(version, help_))
    return Denoised(
        target,
        tuple(names),
        tuple(name for name in frame.layers() if name not in cleaned),
        tuple(map(str, sums)),
        help_.albedo_layers,
        help_.normal_layer,
        nonfinite,
    )


def _target(path: Path, output: Path | None, in_place: bool) -> str:
    source = FilePath(path)
    if in_place:
        if output is not None:
            raise _refuse("denoise", "in place and another file exclude each other", "give one")
        return os.fspath(path)
    target = source.with_name(f"{source.stem}{SUFFIX}.exr") if output is None else FilePath(output)
    if target.resolve() == source.resolve():
        raise _refuse(
            "denoise",
            f'"{target}" would replace the noisy picture',
            "say so with --in-place (in_place=True), or give another name",
        )
    return os.fspath(target)


def _is_light(layer: Layer, pixels: npt.NDArray[np.generic]) -> bool:
    """Whether a layer is light with noise in it, and not data about surfaces."""
    if pixels.dtype != np.float32 or pixels.shape[2] not in (1, 3, 4):
        return False
    if layer.filter and layer.filter not in MEAN_FILTERS:
        return False
    if not layer.expression:
        return (layer.aov or layer.name) in LIGHT_AOVS
    return not _is_probe(layer.expression)


def _is_probe(expression: str) -> bool:
    """Whether an expression takes albedos and no light."""
    try:
        return lpe.compare(expression, "C.*A").relation in ("equal", "subset")
    except LightsieveError:
        # It names others that the header does not define: only light can be told from that.
        return False


def _find_helpers(
    source: str, frame: Frame, info: ExrInfo, other: Path | None, names: list[str]
) -> _Helpers:
    """The albedo and the normal as the beauty's camera sees them: from the file, or the other."""
    beauty = next((n for n in names if (frame.info(n).aov or n) in ("RGBA", "RGB")), names[0])
    own = _helpers_in(frame, info, _camera_of(info, beauty), frame.info(beauty))
    if other is None or (own.albedo is not None and own.normal is not None):
        return own
    other_info = exr.info(other)
    if (other_info.data_window, other_info.width, other_info.height) != (
        info.data_window,
        info.width,
        info.height,
    ):
        raise _refuse(
            "picture-size",
            f'"{os.fspath(other)}" shows another part of the frame than "{source}"',
            "give a file of the same size and region",
        )
    more = _helpers_in(exr.read(other), other_info, _camera_of(info, beauty), frame.info(beauty))
    albedo = own if own.albedo is not None else more
    normal = own if own.normal is not None else more
    return _Helpers(albedo.albedo, albedo.albedo_layers, normal.normal, normal.normal_layer)


def _camera_of(info: ExrInfo, name: str) -> str:
    return next((layer.camera for layer in info.layers if layer.name == name), "")


def _helpers_in(frame: Frame, info: ExrInfo, camera: str, beauty: Layer) -> _Helpers:
    def find(aov: str) -> str | None:
        """The layer of that AOV; one with the beauty's filter before others."""
        found = [
            name
            for name in frame.layers()
            if (frame.info(name).aov or name) == aov
            and _camera_of(info, name) == camera
            and not frame.info(name).light_group
            and frame.layer(name).shape[2] >= 3
        ]
        found.sort(key=lambda name: frame.info(name).filter != beauty.filter)
        return found[0] if found else None

    albedo: tuple[str, ...] = ()
    for row in ALBEDOS:
        albedo = tuple(name for aov in row if (name := find(aov)) is not None)
        if albedo:
            break
    normal = next((name for aov in NORMALS if (name := find(aov)) is not None), None)
    return _Helpers(
        _finite(sum(frame.layer(name)[:, :, :3] for name in albedo)) if albedo else None,
        albedo,
        _finite(frame.layer(normal)[:, :, :3]) if normal is not None else None,
        normal or "",
    )


def _finite(picture: object) -> Picture:
    return np.nan_to_num(np.asarray(picture, np.float32), nan=0, posinf=0, neginf=0)


def _denoise_layers(
    frame: Frame, names: list[str], denoiser: Denoiser, progress: Progress | None
) -> tuple[dict[str, Picture], dict[str, int]]:
    """Each layer of light by itself, and how many of its values were no numbers.

    The frame's layers get numbers there.
    """
    cleaned: dict[str, Picture] = {}
    nonfinite: dict[str, int] = {}
    for i, name in enumerate(names):
        if progress is not None:
            progress(name, i, len(names))
        light = _light(frame, name)
        if n_bad := int((~np.isfinite(light)).sum()):
            nonfinite[name] = n_bad
            light[:] = _patched(light)
        cleaned[name] = light.copy()
        if light.any():
            colour = light if light.shape[2] == 3 else np.repeat(light, 3, axis=2)
            result = denoiser.denoise(colour)
            cleaned[name] = result if light.shape[2] == 3 else result.mean(axis=2, keepdims=True)
    if progress is not None:
        progress("", len(names), len(names))
    return cleaned, nonfinite


def _light(frame: Frame, name: str) -> Picture:
    """A layer without its alpha; a view."""
    pixels = frame.layer(name)
    assert pixels.dtype == np.float32
    return pixels[:, :, :3]  # type: ignore[return-value]


def _patched(light: Picture) -> Picture:
    """Means of what lies around in place of values that are no numbers."""
    out = light.copy()
    good = np.isfinite(light)
    radius = PATCH_RADIUS
    while not np.isfinite(out).all():
        weight = box_mean(good, radius)
        mean = box_mean(np.where(good, light, 0), radius) / np.maximum(weight, 1e-12)
        # Where there is nothing within the whole picture there is no light.
        hopeless = radius > max(light.shape)
        usable = ~np.isfinite(out) & ((weight > 0) | hopeless)
        out[usable] = mean[usable]
        radius *= 2
    return out


def _sums_of(info: ExrInfo, names: Iterable[str]) -> list[Sum]:
    """The sums of the header whose layers are all denoised."""
    known = set(names)
    text = info.attributes.get(PARTITIONS_ATTRIBUTE, "")
    return [s for s in parse_sums(str(text)) if known >= {s.whole, *s.parts}]


def _bring_together(frame: Frame, cleaned: dict[str, Picture], sums: list[Sum]) -> None:
    """Moves denoised layers so that the sums hold, each colour by itself."""
    errors: dict[str, Picture] = {}
    for name, picture in cleaned.items():
        # Roots: squares of faint light would be too small for the type, which saves memory.
        errors[name] = np.sqrt(squared_error(_light(frame, name), picture)).astype(np.float32)
        # Where no sample brought light there is none: the network leaves a trace of it.
        picture[errors[name] == 0] = 0
    # Layers of one value (luminance) and layers of colour are no parts of one another.
    for n_channels in (1, 3):
        alike = [
            s
            for s in sums
            if all(cleaned[name].shape[2] == n_channels for name in (s.whole, *s.parts))
        ]
        names = sorted({name for s in alike for name in (s.whole, *s.parts)})
        matrix, every = equations(alike, names), rows_of(alike, names)
        for top in range(0, frame.height if names else 0, BAND_ROWS):
            rows = slice(top, top + BAND_ROWS)
            found = reconcile(
                np.stack([cleaned[n][rows].astype(np.float64).ravel() for n in names]),
                np.stack([errors[n][rows].astype(np.float64).ravel() ** 2 for n in names]),
                matrix,
            )
            together = without_leftovers(found, every)
            for name, values in zip(names, together, strict=True):
                cleaned[name][rows] = values.reshape(cleaned[name][rows].shape)


def _story(version: str, help_: _Helpers) -> str:
    """What the header says of the denoiser."""
    used = [*help_.albedo_layers, *([help_.normal_layer] if help_.normal_layer else [])]
    return f"Open Image Denoise {version}" + (f", with {' '.join(used)}" if used else "")


def _write(
    source: str,
    target: str,
    info: ExrInfo,
    frame: Frame,
    cleaned: dict[str, Picture],
    sums: list[Sum],
    story: str,
) -> None:
    attributes = {DENOISER_ATTRIBUTE: story, LAYERS_ATTRIBUTE: "\n".join(cleaned)}
    if info.lossy and PARTITIONS_ATTRIBUTE in info.attributes:
        # From now on nothing is lost, so sums are checked: only those that were made to hold may
        # be claimed.
        attributes[PARTITIONS_ATTRIBUTE] = "\n".join(map(str, sums))
    for name, picture in cleaned.items():
        _light(frame, name)[:] = picture
    _core.exr_rewrite(source, target, {name: frame.layer(name) for name in cleaned}, attributes)
