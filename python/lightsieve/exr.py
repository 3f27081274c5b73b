"""EXR files: what is in them, whether their AOVs add up, how two of them differ.

>>> from lightsieve import exr
>>> exr.verify("out/frame.exr").passed
True
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from lightsieve import _core
from lightsieve._core import ExrDiffResult, ExrInfo, ExrVerifyResult

if TYPE_CHECKING:
    from lightsieve.frame import Frame

__all__ = ["ExrDiffResult", "ExrInfo", "ExrVerifyResult", "diff", "info", "read", "verify"]

Path = str | os.PathLike[str]


def info(path: Path) -> ExrInfo:
    """Reads a file's header.

    Args:
        path: Any OpenEXR file.

    Returns:
        Size, layers with their expressions and light groups, header attributes.

    Raises:
        LightsieveError: The file is missing or damaged.

    Example:
        >>> [layer.name for layer in info("out/frame.exr").layers]
        ['RGBA', 'diffuse', 'diffuse_direct', 'diffuse_indirect', 'mirrored']
    """
    return _core.exr_info(os.fspath(path))


def read(path: Path) -> Frame:
    """Reads all layers of a file.

    Args:
        path: Any OpenEXR file with flat pixels.

    Returns:
        The layers over the data window.

    Raises:
        LightsieveError: The file is missing, damaged or too large.

    Example:
        >>> read("out/frame.exr").layer("RGBA").dtype
        dtype('float32')
    """
    from lightsieve.frame import Frame, Layer

    layers = [
        (
            Layer(
                layer.name,
                layer.source,
                layer.type,
                layer.expression,
                layer.light_group,
                layer.filter,
                layer.filter_width,
            ),
            pixels,
        )
        for layer, pixels in _core.exr_read(os.fspath(path))
    ]
    return Frame(layers, files=[os.fspath(path)])


def verify(path: Path) -> ExrVerifyResult:
    """Re-checks from the pixels the sums that the renderer proved for a file's layers.

    Args:
        path: A file that Lightsieve wrote.

    Returns:
        One check a sum, with the largest residual.

    Raises:
        LightsieveError: The file is missing or damaged.

    Example:
        >>> [check.text for check in verify("out/frame.exr").checks]
        ['diffuse = diffuse_direct + diffuse_indirect']
    """
    return _core.exr_verify(os.fspath(path))


def diff(a: Path, b: Path, picture: Path | None = None, layer: str = "") -> ExrDiffResult:
    """Compares two files layer by layer.

    Args:
        a: A file.
        b: The reference.
        picture: Gets the absolute difference: an `.exr` of all layers, a `.png` or `.tif` of one.
        layer: Which layer goes to a `.png` or `.tif`; the first if empty.

    Returns:
        RMSE, relative MSE and the largest difference of each layer that both have.

    Raises:
        LightsieveError: A file is missing or damaged, or their sizes differ.

    Example:
        >>> diff("out/frame.exr", "out/frame.exr").layers[0].rmse
        0.0
    """
    return _core.exr_diff(
        os.fspath(a), os.fspath(b), "" if picture is None else os.fspath(picture), layer
    )
