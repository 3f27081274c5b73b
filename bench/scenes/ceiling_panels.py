"""A hall under 64 area lights in eight light groups, with layered surfaces on the floor."""

from __future__ import annotations

import math

from scenes.ass_text import Array, node, options

N_PANELS = 8  # along an edge
N_GROUPS = 8
DEPTH = 3
HALF_WIDTH, HEIGHT = 8.0, 4.0


def _quad(name: str, corners: list[float], shader: str) -> str:
    return node(
        "polymesh",
        name=name,
        nsides=Array("UINT", 1, [4]),
        vidxs=Array("UINT", 4, range(4)),
        vlist=Array("VECTOR", 4, corners),
        smoothing=False,
        shader=shader,
    )


def _panel(ix: int, iz: int) -> str:
    """One light below the ceiling; a row of panels is one group."""
    pitch = 2 * HALF_WIDTH / N_PANELS
    half, y = 0.2 * pitch, HEIGHT - 0.01
    x, z = -HALF_WIDTH + (ix + 0.5) * pitch, -HALF_WIDTH + (iz + 0.5) * pitch
    hue = 2 * math.pi * (ix + N_PANELS * iz) / N_PANELS**2
    color = [0.75 + 0.25 * math.cos(hue + k * 2 * math.pi / 3) for k in range(3)]
    h = half
    return node(
        "quad_light",
        name=f"panel{ix}_{iz}",
        vertices=Array(
            "VECTOR", 4, [x - h, y, z - h, x + h, y, z - h, x + h, y, z + h, x - h, y, z + h]
        ),
        color=color,
        intensity=4 + (3 * ix + 5 * iz) % 7,
        normalize=False,
        aov=f"row{iz % N_GROUPS}",
    )


def ass(resolution: int = 512, aa_samples: int = 4) -> str:
    """The scene as .ass text.

    Args:
        resolution: width and height [pixels].
        aa_samples: the square is samples a pixel.
    """
    w, h = HALF_WIDTH, HEIGHT
    out = ["# A hall under 64 lights. Written by bench/scenes/ceiling_panels.py.\n"]
    out.append(options(resolution, resolution, aa_samples, DEPTH))
    out.append(
        node(
            "persp_camera",
            name="camera",
            position=(0, 2.2, 7.6),
            look_at=(0, 0.9, 0),
            up=(0, 1, 0),
            fov=60,
        )
    )
    surface = "standard_surface"
    out += [
        node(surface, name="wall", base=1, base_color=(0.6, 0.58, 0.55), specular=0),
        node(
            surface,
            name="floor_shader",
            base=1,
            base_color=(0.3, 0.25, 0.2),
            specular=1,
            specular_roughness=0.3,
        ),
        node(
            surface,
            name="paint",
            base=1,
            base_color=(0.5, 0.05, 0.05),
            specular=1,
            specular_roughness=0.4,
            coat=1,
            coat_roughness=0.05,
            caustics=True,
        ),
        node(
            surface,
            name="gold",
            base=1,
            base_color=(1.0, 0.77, 0.34),
            metalness=1,
            specular_roughness=0.25,
            caustics=True,
        ),
        node(
            surface,
            name="cloth",
            base=1,
            base_color=(0.1, 0.15, 0.4),
            specular=0.2,
            sheen=0.8,
            sheen_roughness=0.4,
        ),
        node(surface, name="glass", base=0, transmission=1, specular_roughness=0.1, caustics=True),
    ]
    out += [
        _quad("floor", [-w, 0, w, w, 0, w, w, 0, -w, -w, 0, -w], "floor_shader"),
        _quad("ceiling", [-w, h, -w, w, h, -w, w, h, w, -w, h, w], "wall"),
        _quad("back", [-w, 0, -w, w, 0, -w, w, h, -w, -w, h, -w], "wall"),
        _quad("left", [-w, 0, w, -w, 0, -w, -w, h, -w, -w, h, w], "wall"),
        _quad("right", [w, 0, -w, w, 0, w, w, h, w, w, h, -w], "wall"),
    ]
    shaders = ["paint", "gold", "cloth", "glass"]
    for i in range(25):
        x, z = -6 + 3 * (i % 5), -6 + 2.6 * (i // 5)
        r = 0.45 + 0.1 * (i * 7 % 5)
        out.append(
            node("sphere", name=f"ball{i}", center=(x, r, z), radius=r, shader=shaders[i % 4])
        )
    out += [_panel(ix, iz) for iz in range(N_PANELS) for ix in range(N_PANELS)]
    return "".join(out)
