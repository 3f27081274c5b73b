"""A hall under 64 area lights in eight light groups, with layered surfaces on the floor."""

from __future__ import annotations

import math

from scenes.description import Ball, Camera, Material, Panel, Scene, mesh

N_PANELS = 8  # along an edge
N_GROUPS = 8
HALF_WIDTH, HEIGHT = 8.0, 4.0

MATERIALS = {
    "wall": Material(base_color=(0.6, 0.58, 0.55)),
    "floor_shader": Material(base_color=(0.3, 0.25, 0.2), specular=1, roughness=0.3),
    "paint": Material(
        base_color=(0.5, 0.05, 0.05),
        specular=1,
        roughness=0.4,
        coat=1,
        coat_roughness=0.05,
        caustics=True,
    ),
    "gold": Material(
        base_color=(1.0, 0.77, 0.34), metalness=1, specular=1, roughness=0.25, caustics=True
    ),
    "cloth": Material(base_color=(0.1, 0.15, 0.4), specular=0.2, sheen=0.8, sheen_roughness=0.4),
    "glass": Material(base=0, transmission=1, specular=1, roughness=0.1, caustics=True),
}


def _panel(ix: int, iz: int) -> Panel:
    """One light below the ceiling; a row of panels is one group."""
    pitch = 2 * HALF_WIDTH / N_PANELS
    hue = 2 * math.pi * (ix + N_PANELS * iz) / N_PANELS**2
    intensity = 4 + (3 * ix + 5 * iz) % 7
    r, g, b = (intensity * (0.75 + 0.25 * math.cos(hue + k * 2 * math.pi / 3)) for k in range(3))
    return Panel(
        name=f"panel{ix}_{iz}",
        center=(-HALF_WIDTH + (ix + 0.5) * pitch, HEIGHT - 0.01, -HALF_WIDTH + (iz + 0.5) * pitch),
        size=(0.4 * pitch, 0.4 * pitch),
        radiance=(r, g, b),
        group=f"row{iz % N_GROUPS}",
    )


def _ball(i: int) -> Ball:
    radius = 0.45 + 0.1 * (i * 7 % 5)
    center = (-6 + 3 * (i % 5), radius, -6 + 2.6 * (i // 5))
    return Ball(f"ball{i}", ("paint", "gold", "cloth", "glass")[i % 4], center, radius)


def scene() -> Scene:
    """The hall."""
    w, h = HALF_WIDTH, HEIGHT
    walls = (
        mesh("floor", "floor_shader", [[(-w, 0, w), (w, 0, w), (w, 0, -w), (-w, 0, -w)]]),
        mesh("ceiling", "wall", [[(-w, h, -w), (w, h, -w), (w, h, w), (-w, h, w)]]),
        mesh("back", "wall", [[(-w, 0, -w), (w, 0, -w), (w, h, -w), (-w, h, -w)]]),
        mesh("left", "wall", [[(-w, 0, w), (-w, 0, -w), (-w, h, -w), (-w, h, w)]]),
        mesh("right", "wall", [[(w, 0, -w), (w, 0, w), (w, h, w), (w, h, -w)]]),
    )
    return Scene(
        title="A hall under 64 lights. Written by bench/scenes/ceiling_panels.py.",
        camera=Camera((0, 2.2, 7.6), (0, 0.9, 0), 60),
        depth=3,
        materials=MATERIALS,
        bodies=walls + tuple(_ball(i) for i in range(25)),
        panels=tuple(_panel(ix, iz) for iz in range(N_PANELS) for ix in range(N_PANELS)),
    )
