"""Two million triangles under a dome: hills whose height is a sum of waves, in one mesh."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scenes.ass_text import node, options

SIZE = 10.0  # edge of the ground [scene units]
DEPTH = 2
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


def _rows(table: np.ndarray, form: str) -> Iterator[str]:
    for row in table:
        yield " ".join(form % v for v in row.ravel())


def write(path: Path, n_triangles: int = 2_000_000, resolution: int = 512) -> None:
    """Writes the scene as .ass.

    Args:
        path: of the file; about 30 bytes a triangle.
        n_triangles: twice a square number comes out nearest to it.
        resolution: width and height [pixels].
    """
    n = max(1, round((n_triangles / 2) ** 0.5))
    edge = np.linspace(-SIZE / 2, SIZE / 2, n + 1)
    points = np.stack([*np.broadcast_arrays(edge[None, :], heights(n), edge[:, None])], axis=-1)
    first = np.arange(n)[:, None] * (n + 1) + np.arange(n)[None, :]
    corners = np.stack([first, first + n + 1, first + n + 2, first + 1], axis=-1)
    with path.open("w") as out:
        out.write("# Hills under a dome. Written by bench/scenes/terrain.py.\n")
        out.write(options(resolution, resolution, 4, DEPTH))
        out.write(
            node(
                "persp_camera",
                name="camera",
                position=(0, 3.2, 6.5),
                look_at=(0, 0, 0),
                up=(0, 1, 0),
                fov=50,
            )
        )
        out.write(node("skydome_light", name="dome", color=(0.8, 0.9, 1.0), camera=1, aov="sky"))
        out.write(
            node(
                "standard_surface",
                name="ground",
                base=1,
                base_color=(0.45, 0.36, 0.25),
                specular=0.5,
                specular_roughness=0.5,
            )
        )
        out.write(f"polymesh\n{{\n name hills\n shader ground\n nsides {n * n} 1 UINT\n")
        out.writelines(" " + "4 " * n + "\n" for _ in range(n))
        out.write(f" vidxs {4 * n * n} 1 UINT\n")
        out.writelines(f" {row}\n" for row in _rows(corners, "%d"))
        out.write(f" vlist {(n + 1) ** 2} 1 VECTOR\n")
        out.writelines(f" {row}\n" for row in _rows(points, "%.6g"))
        out.write("}\n")
