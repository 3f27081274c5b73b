"""The Cornell box of cornell_box.py for Mitsuba 3 (any of its RGB variants)."""

from __future__ import annotations

from typing import Any

import mitsuba as mi
import numpy as np

from scenes import cornell_box as box

# Path lengths: depth d of ours allows d + 1 scatterings before the light, i.e. d + 2 edges.
MAX_DEPTH = box.DEPTH + 2


def _rgb(values: tuple[float, ...]) -> dict[str, Any]:
    return {"type": "rgb", "value": list(values)}


def _bsdf(material: box.Material) -> dict[str, Any]:
    if material.kind == "diffuse":
        return {"type": "diffuse", "reflectance": _rgb(material.color)}
    if material.kind == "glass":
        return {"type": "dielectric", "int_ior": box.GLASS_IOR, "ext_ior": 1.0}
    index = [box.metal_index(r, material.edge_tint) for r in material.color]
    metal = {
        "eta": _rgb(tuple(n for n, _ in index)),
        "k": _rgb(tuple(k for _, k in index)),
    }
    if material.roughness == 0:
        return {"type": "conductor", **metal}
    alpha = material.roughness**2
    return {"type": "roughconductor", "distribution": "ggx", "alpha": alpha, **metal}


def _mesh(body: box.Quads, bsdf: dict[str, Any]) -> Any:
    """The quadrilaterals as a mesh of two triangles each."""
    n = len(body.corners)
    props = mi.Properties()
    props["mesh_bsdf"] = mi.load_dict(bsdf)
    mesh = mi.Mesh(body.name, 4 * n, 2 * n, has_vertex_normals=False, props=props)
    params = mi.traverse(mesh)
    params["vertex_positions"] = np.array(body.corners, dtype=np.float32).ravel()
    faces = [[4 * i, 4 * i + a, 4 * i + a + 1] for i in range(n) for a in (1, 2)]
    params["faces"] = np.array(faces, dtype=np.uint32).ravel()
    params.update()
    return mesh


def load(sampler: str, spp: int, resolution: int) -> Any:
    """Makes the scene in the variant that is set.

    Args:
        sampler: plugin, e.g. "independent" or "multijitter".
        spp: samples a pixel.
        resolution: width and height [pixels].
    Returns:
        The scene, with integrator, film and sampler.
    """
    to_world = mi.ScalarTransform4f().look_at(
        origin=list(box.CAMERA), target=[0, 0, 0], up=[0, 1, 0]
    )
    film = {
        "type": "hdrfilm",
        "width": resolution,
        "height": resolution,
        "rfilter": {"type": "box"},
        "pixel_format": "rgb",
        "component_format": "float32",
        "sample_border": False,
    }
    scene: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": MAX_DEPTH, "rr_depth": 1000},
        "sensor": {
            "type": "perspective",
            "fov": box.FOV_DEG,
            "fov_axis": "x",
            "to_world": to_world,
            "near_clip": 1e-3,
            "film": film,
            "sampler": {"type": sampler, "sample_count": spp},
        },
    }
    for body in box.BODIES:
        bsdf = _bsdf(box.MATERIALS[body.material])
        if isinstance(body, box.Ball):
            scene[body.name] = {
                "type": "sphere",
                "center": list(body.center),
                "radius": body.radius,
                "bsdf": bsdf,
            }
        else:
            scene[body.name] = _mesh(body, bsdf)
    h = box.LAMP_HALF_SIZE
    scene["lamp"] = {
        "type": "rectangle",
        "to_world": mi.ScalarTransform4f()
        .translate([0, box.LAMP_HEIGHT, 0])
        .rotate([1, 0, 0], 90)
        .scale([h, h, 1]),
        "emitter": {"type": "area", "radiance": _rgb(box.LAMP_RADIANCE)},
        "bsdf": {"type": "diffuse", "reflectance": _rgb((0.0, 0.0, 0.0))},
    }
    return mi.load_dict(scene)
