"""A Cornell box with a mirror, a glass and a rough metal body: one description for two renderers.

Walls are Lambert; the block is rough metal, the left ball a mirror, the right ball clear glass. All
of it under one square lamp below the ceiling. Light through the glass is a caustic that is found by
chance only, as in any plain path tracer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from scenes.ass_text import Array, node, options

Point = tuple[float, float, float]
Color = tuple[float, float, float]

DEPTH = 8  # bounces after which a ray may meet lights only
FOV_DEG = 39.3
CAMERA: Point = (0.0, 0.0, 3.9)
LAMP_HALF_SIZE = 0.25
LAMP_HEIGHT = 0.995
LAMP_RADIANCE = (17.0, 14.0, 10.0)


@dataclass(frozen=True)
class Material:
    """What a body is made of.

    Args:
        kind: model.
        color: reflectance; of metals at normal incidence.
        roughness: of the microfacets as artists give it; their width is its square.
    """

    kind: Literal["diffuse", "metal", "glass"]
    color: Color = (1.0, 1.0, 1.0)
    roughness: float = 0.0

    @property
    def edge_tint(self) -> float:
        """Reflectance of metals at the edge."""
        return 0.9


@dataclass(frozen=True)
class Quads:
    """Flat quadrilaterals; seen from the front the corners run counter-clockwise."""

    name: str
    material: str
    corners: tuple[tuple[Point, Point, Point, Point], ...]


@dataclass(frozen=True)
class Ball:
    """A sphere."""

    name: str
    material: str
    center: Point
    radius: float


MATERIALS = {
    "grey": Material("diffuse", (0.73, 0.73, 0.73)),
    "red": Material("diffuse", (0.63, 0.065, 0.05)),
    "green": Material("diffuse", (0.14, 0.45, 0.091)),
    "mirror": Material("metal", (0.9, 0.9, 0.9)),
    "brushed": Material("metal", (0.95, 0.64, 0.54), 0.3),
    "clear": Material("glass"),
    "black": Material("diffuse", (0.0, 0.0, 0.0)),
}
GLASS_IOR = 1.5


def _block(center: Point, half: Point, turn_deg: float) -> tuple[tuple[Point, ...], ...]:
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
    return tuple(tuple(corner(*v) for v in face) for face in faces)


def _lamp_back() -> tuple[Point, Point, Point, Point]:
    h, y = LAMP_HALF_SIZE, (LAMP_HEIGHT + 1) / 2
    return ((-h, y, -h), (h, y, -h), (h, y, h), (-h, y, h))


BODIES: tuple[Quads | Ball, ...] = (
    Quads("floor", "grey", (((-1, -1, 1), (1, -1, 1), (1, -1, -1), (-1, -1, -1)),)),
    Quads("ceiling", "grey", (((-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)),)),
    Quads("back", "grey", (((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)),)),
    Quads("left", "red", (((-1, -1, 1), (-1, -1, -1), (-1, 1, -1), (-1, 1, 1)),)),
    Quads("right", "green", (((1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)),)),
    Quads("block", "brushed", _block((-0.3, -0.42, -0.4), (0.28, 0.58, 0.28), 18)),  # type: ignore[arg-type]
    # Lamps are no surfaces in Arnold's rules: rays pass them, so the back of this one is a body.
    Quads("lamp_back", "black", (_lamp_back(),)),
    Ball("mirror_ball", "mirror", (-0.45, -0.72, 0.4), 0.28),
    Ball("glass_ball", "clear", (0.45, -0.62, 0.15), 0.38),
)


def metal_index(reflectivity: float, edge_tint: float) -> tuple[float, float]:
    """Index of refraction and extinction of an artist's metal.

    Source: Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, eq. 11 to 16.
    """
    r, root = reflectivity, math.sqrt(reflectivity)
    n = (1 - edge_tint) * (1 + root) / (1 - root) + edge_tint * (1 - r) / (1 + r)
    k2 = (r * (n + 1) ** 2 - (n - 1) ** 2) / (1 - r)
    return n, math.sqrt(max(0.0, k2))


def _shader(name: str, material: Material) -> str:
    if material.kind == "diffuse":
        return node("standard_surface", name=name, base=1, base_color=material.color, specular=0)
    if material.kind == "glass":
        return node(
            "standard_surface",
            name=name,
            base=0,
            transmission=1,
            specular=1,
            specular_roughness=0,
            specular_IOR=GLASS_IOR,
            caustics=True,
        )
    return node(
        "standard_surface",
        name=name,
        base=1,
        base_color=material.color,
        metalness=1,
        specular=1,
        specular_color=[material.edge_tint] * 3,
        specular_roughness=material.roughness,
        caustics=True,
    )


def _lamp(name: str, x0: float, x1: float, group: str) -> str:
    # From below the corners run counter-clockwise.
    h, y = LAMP_HALF_SIZE, LAMP_HEIGHT
    corners = [x0, y, -h, x1, y, -h, x1, y, h, x0, y, h]
    return node(
        "quad_light",
        name=name,
        vertices=Array("VECTOR", 4, corners),
        color=LAMP_RADIANCE,
        normalize=False,
        camera=1,
        specular=1,
        transmission=1,
        **({"aov": group} if group else {}),
    )


def ass(n_groups: int = 0, resolution: int = 512, aa_samples: int = 8) -> str:
    """The scene as .ass text.

    Args:
        n_groups: 0: one lamp without a group; otherwise the lamp is cut into so many strips, each in
            a light group of its own. The picture stays the same.
        resolution: width and height [pixels].
        aa_samples: the square is samples a pixel.
    """
    out = ["# Cornell box: mirror, glass, rough metal. Written by bench/scenes/cornell_box.py.\n"]
    out.append(options(resolution, resolution, aa_samples, DEPTH))
    out.append(
        node(
            "persp_camera",
            name="camera",
            position=CAMERA,
            look_at=(0, 0, 0),
            up=(0, 1, 0),
            fov=FOV_DEG,
        )
    )
    out += [_shader(name, material) for name, material in MATERIALS.items()]
    for body in BODIES:
        if isinstance(body, Ball):
            out.append(
                node(
                    "sphere",
                    name=body.name,
                    center=body.center,
                    radius=body.radius,
                    shader=body.material,
                )
            )
            continue
        points = [x for face in body.corners for corner in face for x in corner]
        n = len(body.corners)
        out.append(
            node(
                "polymesh",
                name=body.name,
                nsides=Array("UINT", n, [4] * n),
                vidxs=Array("UINT", 4 * n, range(4 * n)),
                vlist=Array("VECTOR", 4 * n, points),
                smoothing=False,
                shader=body.material,
            )
        )
    strips = max(1, n_groups)
    width = 2 * LAMP_HALF_SIZE / strips
    for i in range(strips):
        x0 = -LAMP_HALF_SIZE + i * width
        out.append(_lamp(f"lamp{i}", x0, x0 + width, f"group{i}" if n_groups else ""))
    return "".join(out)
