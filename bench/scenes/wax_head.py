"""A head of wax under a lamp and a dome: light that wanders below a surface with nose, ears and thin places."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scenes.ass_text import Array, node, options

DEPTH = 4


def surface(n: int) -> tuple[np.ndarray, np.ndarray]:
    """A ball with bumps where a head has them.

    Args:
        n: rows; twice as many columns.
    Returns:
        Points, float64 of shape (m, 3), and the corners of quadrilaterals, int64 of shape (k, 4).
    """
    theta = np.linspace(1e-3, np.pi - 1e-3, n)[:, None]
    phi = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)[None, :]
    direction = np.stack(
        [
            np.sin(theta) * np.sin(phi),
            np.cos(theta) * np.ones_like(phi),
            np.sin(theta) * np.cos(phi),
        ],
        axis=-1,
    )

    def bump(at: tuple[float, float, float], width: float, height: float) -> np.ndarray:
        center = np.array(at) / np.linalg.norm(at)
        angle = np.arccos(np.clip(direction @ center, -1, 1))
        return height * np.exp(-((angle / width) ** 2))

    radius = 1 + bump((0, -0.1, 1), 0.16, 0.32) + bump((0, -0.75, 0.75), 0.3, 0.12)
    for side in (-1, 1):
        radius += bump((side, 0.05, -0.05), 0.12, 0.4)  # ears: the thin places
        radius -= bump((side * 0.38, 0.22, 0.9), 0.16, 0.1)
    points = direction * radius[..., None] * np.array([0.82, 1.1, 0.92])
    i, j = np.meshgrid(np.arange(n - 1), np.arange(2 * n), indexing="ij")
    right = (j + 1) % (2 * n)
    corner = [i * 2 * n + j, (i + 1) * 2 * n + j, (i + 1) * 2 * n + right, i * 2 * n + right]
    return points.reshape(-1, 3), np.stack([c.ravel() for c in corner], axis=-1)


def write(path: Path, resolution: int = 512, rows: int = 200) -> None:
    """Writes the scene as .ass."""
    points, quads = surface(rows)
    text = "# A head of wax. Written by bench/scenes/wax_head.py.\n" + options(
        resolution, resolution, 4, DEPTH
    )
    text += node(
        "persp_camera",
        name="camera",
        position=(1.6, 0.3, 4.6),
        look_at=(0, -0.05, 0),
        up=(0, 1, 0),
        fov=34,
    )
    text += node("skydome_light", name="dome", color=(0.5, 0.6, 0.8), camera=0, intensity=0.3)
    text += node("point_light", name="lamp", position=(-3, 3, -2), radius=0.4, intensity=160)
    text += node(
        "standard_surface",
        name="wax",
        base=0,
        subsurface=1,
        subsurface_color=(0.9, 0.7, 0.5),
        subsurface_radius=(0.3, 0.15, 0.08),
        specular_roughness=0.4,
    )
    text += node(
        "polymesh",
        name="head",
        shader="wax",
        smoothing=True,
        nsides=Array("UINT", len(quads), [4] * len(quads)),
        vidxs=Array("UINT", quads.size, quads.ravel().tolist()),
        vlist=Array("VECTOR", len(points), points.ravel().tolist()),
    )
    path.write_text(text)
