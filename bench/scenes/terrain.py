"""Two million triangles under a dome: hills whose height is a sum of waves, in one mesh."""

from __future__ import annotations

import numpy as np
from scenes.description import Camera, Material, Mesh, Scene

SIZE = 10.0  # edge of the ground [scene units]
N_WAVES = 48


def heights(n: int) -> np.ndarray:
    """Heights at (n + 1) x (n + 1) points.

    Args:
        n: quadrilaterals along an edge.
    Returns:
        float64, shape (n + 1, n + 1), row by z, column by x [scene units].
    """
    random = np.random.default_rng(1)
    x = np.linspace(-SIZE / 2, SIZE / 2, n + 1)
    out = np.zeros((n + 1, n + 1))
    # Waves of all directions; twice as short, half as high.
    for i in range(N_WAVES):
        frequency = 0.5 * 2 ** (i / 6)
        angle, phase = random.uniform(0, 2 * np.pi, 2)
        along_x = np.exp(1j * (frequency * np.cos(angle) * x + phase))
        along_z = np.exp(1j * frequency * np.sin(angle) * x)
        out += (along_z[:, None] * along_x[None, :]).imag * (0.22 / frequency)
    return out


def scene(n_triangles: int = 2_000_000) -> Scene:
    """The hills.

    Args:
        n_triangles: twice a square number comes out nearest to it.
    """
    n = max(1, round((n_triangles / 2) ** 0.5))
    edge = np.linspace(-SIZE / 2, SIZE / 2, n + 1)
    points = np.stack([*np.broadcast_arrays(edge[None, :], heights(n), edge[:, None])], axis=-1)
    first = np.arange(n)[:, None] * (n + 1) + np.arange(n)[None, :]
    corners = np.stack([first, first + n + 1, first + n + 2, first + 1], axis=-1)
    return Scene(
        title="Hills under a dome. Written by bench/scenes/terrain.py.",
        camera=Camera((0, 3.2, 6.5), (0, 0, 0), 50),
        depth=2,
        materials={"ground": Material(base_color=(0.45, 0.36, 0.25), specular=0.5, roughness=0.5)},
        bodies=(Mesh("hills", "ground", points.reshape(-1, 3), corners.reshape(-1, 4)),),
        sky=(0.8, 0.9, 1.0),
    )
