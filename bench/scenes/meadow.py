"""A meadow of one million plants: one instancer, three tufts of grass."""

from __future__ import annotations

import base64
from pathlib import Path

import numpy as np
from scenes.ass_text import Array, node, options

SIZE = 60.0  # edge of the ground [scene units]
DEPTH = 2
KINDS = 3
BLADES = 12  # of a tuft; each two triangles that bend


def tuft(kind: int) -> tuple[np.ndarray, np.ndarray]:
    """Blades that lean outward from the origin.

    Args:
        kind: number of the tuft; each is another one.
    Returns:
        Points, shape (BLADES * 5, 3), and corners of triangles, shape (BLADES * 3, 3).
    """
    random = np.random.default_rng(kind)
    points, corners = [], []
    for blade in range(BLADES):
        angle, lean = random.uniform(0, 2 * np.pi), random.uniform(0.05, 0.4)
        height, width = random.uniform(0.5, 1.0), random.uniform(0.02, 0.05)
        out = np.array([np.cos(angle), 0, np.sin(angle)])
        across = np.array([-out[2], 0, out[0]]) * width
        low = out * 0.05
        middle = out * (0.05 + lean * 0.3) + [0, height * 0.6, 0]
        tip = out * (0.05 + lean) + [0, height, 0]
        points += [low - across, low + across, middle - across, middle + across, tip]
        first = 5 * blade
        corners += [[first, first + 1, first + 3], [first, first + 3, first + 2]]
        corners += [[first + 2, first + 3, first + 4]]
    return np.array(points), np.array(corners)


def placements(n: int) -> np.ndarray:
    """Matrices of plants on the ground, turned and scaled by chance.

    Args:
        n: plants.
    Returns:
        float32, shape (n, 4, 4), for row vectors.
    """
    random = np.random.default_rng(7)
    angle, scale = random.uniform(0, 2 * np.pi, n), random.uniform(0.15, 0.4, n)
    out = np.zeros((n, 4, 4), np.float32)
    out[:, 0, 0] = out[:, 2, 2] = np.cos(angle) * scale
    out[:, 2, 0] = np.sin(angle) * scale
    out[:, 0, 2] = -out[:, 2, 0]
    out[:, 1, 1] = scale
    out[:, 3, 0], out[:, 3, 2] = random.uniform(-SIZE / 2, SIZE / 2, (2, n))
    out[:, 3, 3] = 1
    return out


def _packed(values: np.ndarray) -> str:
    return base64.b64encode(values.tobytes()).decode().rstrip("=")


def write(path: Path, n_plants: int = 1_000_000, resolution: int = 512) -> None:
    """Writes the scene as .ass.

    Args:
        path: of the file; about 90 bytes a plant.
        n_plants: on the ground.
        resolution: width and height [pixels].
    """
    kinds = np.arange(n_plants, dtype=np.uint32) % KINDS
    half = SIZE / 2
    with path.open("w") as out:
        out.write("# A meadow. Written by bench/scenes/meadow.py.\n")
        out.write(options(resolution, resolution, 4, DEPTH))
        out.write(
            node(
                "persp_camera",
                name="camera",
                position=(0, 3.5, 32),
                look_at=(0, 0, 4),
                up=(0, 1, 0),
                fov=50,
            )
        )
        out.write(node("skydome_light", name="dome", color=(0.7, 0.8, 1.0), camera=1))
        out.write(node("lambert", name="soil", Kd_color=(0.3, 0.22, 0.15)))
        corners = [-half, 0, -half, -half, 0, half, half, 0, half, half, 0, -half]
        out.write(
            node(
                "polymesh",
                name="ground",
                nsides=4,
                vidxs=Array("UINT", 4, [0, 1, 2, 3]),
                vlist=Array("VECTOR", 4, corners),
                shader="soil",
            )
        )
        for kind in range(KINDS):
            points, triangles = tuft(kind)
            green = (0.2 + 0.1 * kind, 0.45, 0.12)
            out.write(node("lambert", name=f"green{kind}", Kd_color=green))
            out.write(
                node(
                    "polymesh",
                    name=f"tuft{kind}",
                    visibility=0,
                    nsides=Array("UINT", len(triangles), [3] * len(triangles)),
                    vidxs=Array("UINT", triangles.size, triangles.ravel().tolist()),
                    vlist=Array("VECTOR", len(points), points.ravel().tolist()),
                    shader=f"green{kind}",
                )
            )
        names = " ".join(f'"tuft{kind}"' for kind in range(KINDS))
        out.write(f"instancer\n{{\n name meadow\n nodes {KINDS} 1 NODE {names}\n")
        out.write(f" node_idxs {n_plants} 1 b64UINT\n {_packed(kinds)}\n")
        out.write(f" instance_matrix {n_plants} 1 b64MATRIX\n {_packed(placements(n_plants))}\n")
        out.write("}\n")
