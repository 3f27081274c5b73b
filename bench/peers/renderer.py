"""What compare.py asks of each renderer."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

import numpy as np


@dataclass(frozen=True)
class Rendered:
    """One picture.

    Args:
        picture: linear, float32, shape (height, width, 3), first row at the top.
        seconds: wall time of the call that made it [s].
        spp: samples a pixel that the renderer took; some stop a little late.
    """

    picture: np.ndarray
    seconds: float
    spp: float


@dataclass(frozen=True)
class Setting:
    """How to render.

    Args:
        resolution: width and height [pixels].
        threads: of the renderer.
        layers: whether to make every layer and light group that the renderer has, too.
    """

    resolution: int
    threads: int
    layers: bool = False


class Renderer(Protocol):
    """A scene, loaded and ready to be rendered more than once."""

    layer_count: int  # layers beside the beauty

    def render(self, spp: int, seed: int) -> Rendered:
        """Renders with box filter, without roulette, clamping or denoising."""


def triangles(quads: np.ndarray) -> np.ndarray:
    """Two triangles a quadrilateral; (m, 4) to (2 m, 3)."""
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def sphere_mesh(
    center: Iterable[float], radius: float, segments: int = 256, rings: int = 128
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A ball for renderers that know meshes only.

    Returns:
        Points (n, 3), normals (n, 3), triangles (m, 3) whose front is outside.
    """
    theta = np.linspace(0, np.pi, rings + 1)[:, None]
    phi = np.linspace(0, 2 * np.pi, segments, endpoint=False)[None, :]
    z = np.broadcast_to(np.cos(theta), (rings + 1, segments))
    normals = np.stack([np.sin(theta) * np.sin(phi), z, np.sin(theta) * np.cos(phi)], axis=-1)
    i = np.arange(rings)[:, None] * segments
    j, k = np.arange(segments)[None, :], (np.arange(segments)[None, :] + 1) % segments
    quads = np.stack([i + j, i + segments + j, i + segments + k, i + k], axis=-1).reshape(-1, 4)
    flat = normals.reshape(-1, 3)
    return np.asarray(list(center)) + radius * flat, flat, triangles(quads)
