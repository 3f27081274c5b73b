"""A scene as data, so that every renderer gets the same one: see as_ass.py here and the writers in ../peers."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

Point = tuple[float, float, float]
Color = tuple[float, float, float]

BLACK: Color = (0.0, 0.0, 0.0)
WHITE: Color = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Material:
    """A layered surface; the names are those of standard_surface.

    Args:
        base: weight of the lowest layer: diffuse, or metal by `metalness`.
        base_color: its reflectance; of metals at normal incidence.
        metalness: 0 or 1.
        edge_tint: reflectance of metals at the edge.
        specular: weight of the reflection above the base.
        roughness: of reflection and transmission as artists give it; the microfacets' width is its square.
        transmission: 1: a clear body of index `ior`.
        coat: weight of the clear layer above all, of index 1.5.
        coat_roughness: as `roughness`.
        sheen: weight of the fibres' layer.
        sheen_roughness: as `roughness`.
        caustics: whether its mirror-like layers are seen by rays that a diffuse surface sent.
    """

    base: float = 1.0
    base_color: Color = WHITE
    metalness: float = 0.0
    edge_tint: float = 1.0
    specular: float = 0.0
    roughness: float = 0.2
    ior: float = 1.5
    transmission: float = 0.0
    coat: float = 0.0
    coat_roughness: float = 0.1
    sheen: float = 0.0
    sheen_roughness: float = 0.3
    caustics: bool = False


@dataclass(frozen=True, eq=False)
class Mesh:
    """Quadrilaterals; seen from the front their corners run counter-clockwise.

    Args:
        name: of the object.
        material: key of the scene's materials.
        points: shape (n, 3) [scene units].
        quads: indices into `points`, shape (m, 4).
    """

    name: str
    material: str
    points: np.ndarray
    quads: np.ndarray


@dataclass(frozen=True)
class Ball:
    """A sphere."""

    name: str
    material: str
    center: Point
    radius: float


@dataclass(frozen=True)
class Panel:
    """A lamp of the shape of a horizontal rectangle that shines down.

    Args:
        name: of the lamp.
        center: of the rectangle.
        size: along x and along z.
        radiance: the same over all of it.
        group: light group; empty: none.
        visible: whether the camera, mirrors and glass show it.
    """

    name: str
    center: Point
    size: tuple[float, float]
    radiance: Color
    group: str = ""
    visible: bool = False


@dataclass(frozen=True)
class Camera:
    """A pinhole camera whose up is y; `fov` is horizontal [degrees]."""

    position: Point
    look_at: Point
    fov: float


@dataclass(frozen=True)
class Scene:
    """What is rendered.

    Args:
        title: one line about it.
        depth: bounces after which a ray may meet lights only.
        sky: radiance that comes from everywhere; black: none. Its light group is "sky".
    """

    title: str
    camera: Camera
    depth: int
    materials: dict[str, Material]
    bodies: tuple[Mesh | Ball, ...]
    panels: tuple[Panel, ...] = ()
    sky: Color = BLACK
    groups: tuple[str, ...] = field(init=False)

    def __post_init__(self) -> None:
        named = [p.group for p in self.panels if p.group] + (["sky"] if any(self.sky) else [])
        object.__setattr__(self, "groups", tuple(dict.fromkeys(named)))


def mesh(name: str, material: str, faces: list[list[Point]]) -> Mesh:
    """A mesh of quadrilaterals that share no corners."""
    points = np.array(faces, dtype=float).reshape(-1, 3)
    return Mesh(name, material, points, np.arange(len(points)).reshape(-1, 4))
