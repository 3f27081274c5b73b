"""A ball with 100,000 strands of brown hair under a dome and a lamp."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scenes.ass_text import Array, node, options

DEPTH = 8
N_POINTS = 8  # control points of a strand; catmull-rom: the first and the last only steer
LENGTH = 0.55
ROOT_RADIUS, TIP_RADIUS = 0.0022, 0.0006


def strands(n: int) -> np.ndarray:
    """Control points of hair that grows from a sphere of radius 1, bends down and curls.

    Args:
        n: strands.
    Returns:
        float64, shape (n, N_POINTS, 3).
    """
    random = np.random.default_rng(1)
    # Roots evenly over the sphere: Fibonacci's spiral.
    i = np.arange(n) + 0.5
    y, turn = 1 - 2 * i / n, np.pi * (1 + 5**0.5) * i
    across = np.sqrt(1 - y * y)
    root = np.stack([across * np.cos(turn), y, across * np.sin(turn)], axis=-1)
    along = np.linspace(-1, N_POINTS - 2, N_POINTS) / (N_POINTS - 3) * LENGTH
    s = along[None, :, None]
    lean = random.normal(0, 0.35, (n, 1, 3))
    fall = np.array([0, -0.9, 0]) * s * s / LENGTH
    phase = random.uniform(0, 2 * np.pi, (n, 1, 1))
    side = np.cross(root, [0.3, 1, 0.2])[:, None, :]
    curl = side * np.sin(phase + s * 14) * 0.02
    return root[:, None, :] * (1 + s) + lean * s + fall + curl


def write(path: Path, n_strands: int = 100_000, resolution: int = 512) -> None:
    """Writes the scene as .ass.

    Args:
        path: of the file; about 200 bytes a strand.
        n_strands: on the ball.
        resolution: width and height [pixels].
    """
    points = strands(n_strands)
    radius = np.linspace(ROOT_RADIUS, TIP_RADIUS, N_POINTS - 2)
    with path.open("w") as out:
        out.write("# A ball of hair. Written by bench/scenes/hair_ball.py.\n")
        out.write(options(resolution, resolution, 4, DEPTH))
        out.write(
            node(
                "persp_camera",
                name="camera",
                position=(0, 0.3, 4.6),
                look_at=(0, -0.1, 0),
                up=(0, 1, 0),
                fov=46,
            )
        )
        out.write(
            node("skydome_light", name="dome", color=(0.6, 0.7, 0.9), camera=0, intensity=0.4)
        )
        out.write(
            node(
                "point_light",
                name="lamp",
                position=(3, 4, 3),
                radius=0.5,
                intensity=120,
                aov="key",
            )
        )
        out.write(node("standard_hair", name="brown", melanin=0.35, melanin_redness=0.5))
        out.write(node("lambert", name="skin", Kd_color=(0.5, 0.35, 0.25)))
        out.write(node("sphere", name="head", radius=1, shader="skin"))
        out.write("curves\n{\n name hair\n shader brown\n basis catmull-rom\n mode ribbon\n")
        out.write(f" num_points {N_POINTS}\n points {n_strands * N_POINTS} 1 VECTOR\n")
        out.writelines(" " + " ".join(f"{v:.6g}" for v in row.ravel()) + "\n" for row in points)
        ends = np.broadcast_to(radius, (n_strands, radius.size)).ravel()
        out.write(f" radius {Array('FLOAT', ends.size, ends.tolist())}\n")
        out.write("}\n")
