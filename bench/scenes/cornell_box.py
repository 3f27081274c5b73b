"""A Cornell box with a mirror, a glass and a rough metal body.

Walls are Lambert; the block is rough metal, the left ball a mirror, the right ball clear glass. All
of it under one square lamp below the ceiling. Light through the glass is a caustic that is found by
chance only, as in any plain path tracer.
"""

from __future__ import annotations

import math

from scenes.description import BLACK, Ball, Camera, Color, Material, Panel, Point, Scene, mesh

LAMP_SIZE = 0.5
LAMP_HEIGHT = 0.995
LAMP_RADIANCE = (17.0, 14.0, 10.0)
EDGE_TINT = 0.9


def _metal(color: Color, roughness: float) -> Material:
    return Material(
        base_color=color,
        metalness=1,
        edge_tint=EDGE_TINT,
        specular=1,
        roughness=roughness,
        caustics=True,
    )


MATERIALS = {
    "grey": Material(base_color=(0.73, 0.73, 0.73)),
    "red": Material(base_color=(0.63, 0.065, 0.05)),
    "green": Material(base_color=(0.14, 0.45, 0.091)),
    "mirror": _metal((0.9, 0.9, 0.9), 0),
    "brushed": _metal((0.95, 0.64, 0.54), 0.3),
    "clear": Material(base=0, transmission=1, specular=1, roughness=0, caustics=True),
    "black": Material(base_color=BLACK),
}


def _block(center: Point, half: Point, turn_deg: float) -> list[list[Point]]:
    """The six faces of a box that is turned about the vertical."""
    c, s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))

    def corner(x: int, y: int, z: int) -> Point:
        dx, dz = x * half[0], z * half[2]
        return (center[0] + c * dx + s * dz, center[1] + y * half[1], center[2] - s * dx + c * dz)

    faces = (
        ((1, -1, -1), (1, 1, -1), (1, 1, 1), (1, -1, 1)),
        ((-1, -1, 1), (-1, 1, 1), (-1, 1, -1), (-1, -1, -1)),
        ((-1, 1, 1), (1, 1, 1), (1, 1, -1), (-1, 1, -1)),
        ((-1, -1, -1), (1, -1, -1), (1, -1, 1), (-1, -1, 1)),
        ((-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)),
        ((1, -1, -1), (-1, -1, -1), (-1, 1, -1), (1, 1, -1)),
    )
    return [[corner(*v) for v in face] for face in faces]


def _lamp_back() -> list[Point]:
    h, y = LAMP_SIZE / 2, (LAMP_HEIGHT + 1) / 2
    return [(-h, y, -h), (h, y, -h), (h, y, h), (-h, y, h)]


BODIES = (
    mesh("floor", "grey", [[(-1, -1, 1), (1, -1, 1), (1, -1, -1), (-1, -1, -1)]]),
    mesh("ceiling", "grey", [[(-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)]]),
    mesh("back", "grey", [[(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]]),
    mesh("left", "red", [[(-1, -1, 1), (-1, -1, -1), (-1, 1, -1), (-1, 1, 1)]]),
    mesh("right", "green", [[(1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)]]),
    mesh("block", "brushed", _block((-0.3, -0.42, -0.4), (0.28, 0.58, 0.28), 18)),
    # Lamps are no surfaces in Arnold's rules: rays pass them, so the back of this one is a body.
    mesh("lamp_back", "black", [_lamp_back()]),
    Ball("mirror_ball", "mirror", (-0.45, -0.72, 0.4), 0.28),
    Ball("glass_ball", "clear", (0.45, -0.62, 0.15), 0.38),
)


def scene(n_groups: int = 0) -> Scene:
    """The box.

    Args:
        n_groups: 0: one lamp without a group; otherwise the lamp is cut into so many strips, each in
            a light group of its own. The picture stays the same.
    """
    strips = max(1, n_groups)
    width = LAMP_SIZE / strips
    return Scene(
        title="Cornell box: mirror, glass, rough metal. Written by bench/scenes/cornell_box.py.",
        camera=Camera((0.0, 0.0, 3.9), (0.0, 0.0, 0.0), 39.3),
        depth=8,
        materials=MATERIALS,
        bodies=BODIES,
        panels=tuple(
            Panel(
                name=f"lamp{i}",
                center=((i + 0.5) * width - LAMP_SIZE / 2, LAMP_HEIGHT, 0.0),
                size=(width, LAMP_SIZE),
                radiance=LAMP_RADIANCE,
                group=f"group{i}" if n_groups else "",
                visible=True,
            )
            for i in range(strips)
        ),
    )
