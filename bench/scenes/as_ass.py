"""Writes a described scene as .ass: what Lightsieve renders."""

from __future__ import annotations

from pathlib import Path

from scenes.ass_text import Array, Value, node, options
from scenes.description import Ball, Material, Mesh, Panel, Scene


def _shader(name: str, m: Material) -> str:
    params: dict[str, Value] = {"base": m.base, "base_color": m.base_color, "specular": m.specular}
    if m.metalness:
        params |= {"metalness": m.metalness, "specular_color": [m.edge_tint] * 3}
    if m.specular or m.metalness or m.transmission:
        params |= {"specular_roughness": m.roughness, "specular_IOR": m.ior}
    if m.transmission:
        params["transmission"] = m.transmission
    if m.coat:
        params |= {"coat": m.coat, "coat_roughness": m.coat_roughness}
    if m.sheen:
        params |= {"sheen": m.sheen, "sheen_roughness": m.sheen_roughness}
    return node("standard_surface", name=name, **params, caustics=m.caustics)


def _body(body: Mesh | Ball) -> str:
    if isinstance(body, Ball):
        return node(
            "sphere",
            name=body.name,
            center=body.center,
            radius=body.radius,
            shader=body.material,
        )
    quads, points = body.quads, body.points
    return node(
        "polymesh",
        name=body.name,
        nsides=Array("UINT", len(quads), [4] * len(quads)),
        vidxs=Array("UINT", quads.size, quads.ravel().tolist()),
        vlist=Array("VECTOR", len(points), points.ravel().tolist()),
        smoothing=False,
        shader=body.material,
    )


def _lamp(panel: Panel) -> str:
    (x, y, z), (size_x, size_z) = panel.center, panel.size
    x0, x1, z0, z1 = x - size_x / 2, x + size_x / 2, z - size_z / 2, z + size_z / 2
    seen: dict[str, Value] = {"camera": 1, "specular": 1, "transmission": 1}
    return node(
        "quad_light",
        name=panel.name,
        # From below the corners run counter-clockwise.
        vertices=Array("VECTOR", 4, [x0, y, z0, x1, y, z0, x1, y, z1, x0, y, z1]),
        color=panel.radiance,
        normalize=False,
        **(seen if panel.visible else {}),
        **({"aov": panel.group} if panel.group else {}),
    )


def write(path: Path, scene: Scene, resolution: int, aa_samples: int = 4) -> None:
    """Writes the scene.

    Args:
        path: of the file; two million triangles take about 60 MB.
        scene: what to write.
        resolution: width and height [pixels].
        aa_samples: the square is samples a pixel.
    """
    with path.open("w") as out:
        out.write(f"# {scene.title}\n")
        out.write(options(resolution, resolution, aa_samples, scene.depth))
        camera = scene.camera
        out.write(
            node(
                "persp_camera",
                name="camera",
                position=camera.position,
                look_at=camera.look_at,
                up=(0, 1, 0),
                fov=camera.fov,
            )
        )
        out.writelines(_shader(name, m) for name, m in scene.materials.items())
        out.writelines(_body(body) for body in scene.bodies)
        out.writelines(_lamp(panel) for panel in scene.panels)
        if any(scene.sky):
            out.write(node("skydome_light", name="dome", color=scene.sky, camera=1, aov="sky"))
