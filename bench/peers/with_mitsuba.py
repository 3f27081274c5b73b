"""The scenes in Mitsuba 3; the variant is set by whoever imports this."""

from __future__ import annotations

import time
from typing import Any

import mitsuba as mi
import numpy as np
from renderer import Rendered, Setting, triangles
from scenes.description import Ball, Color, Material, Mesh, Panel, Scene

# What its `aov` integrator can add; it has no light path expressions and no light groups.
AOVS = "albedo:albedo,normal:sh_normal,depth:depth,position:position"
AOV_COUNT = 4
NO_ROULETTE = 1000


def _rgb(values: Color) -> dict[str, Any]:
    return {"type": "rgb", "value": list(values)}


def metal_index(reflectivity: float, edge_tint: float) -> tuple[float, float]:
    """Index of refraction and extinction of an artist's metal.

    Source: Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, eq. 11 to 16.
    """
    r = min(reflectivity, 0.999)  # a perfect mirror has no finite index
    root = r**0.5
    n = (1 - edge_tint) * (1 + root) / (1 - root) + edge_tint * (1 - r) / (1 + r)
    k2 = (r * (n + 1) ** 2 - (n - 1) ** 2) / (1 - r)
    return n, max(0.0, k2) ** 0.5


def _metal(material: Material) -> dict[str, Any]:
    index = [metal_index(r, material.edge_tint) for r in material.base_color]
    n, k = (tuple(column) for column in zip(*index, strict=True))
    eta = {"eta": _rgb(n), "k": _rgb(k)}
    if material.roughness == 0:
        return {"type": "conductor", **eta}
    return {"type": "roughconductor", "distribution": "ggx", "alpha": material.roughness**2, **eta}


def _glass(material: Material) -> dict[str, Any]:
    index = {"int_ior": material.ior, "ext_ior": 1.0}
    if material.roughness == 0:
        return {"type": "dielectric", **index}
    alpha = material.roughness**2
    return {"type": "roughdielectric", "distribution": "ggx", "alpha": alpha, **index}


def _bsdf(material: Material) -> dict[str, Any]:
    if material.transmission:
        return _glass(material)
    if material.metalness:
        return _metal(material)
    if not (material.specular or material.coat or material.sheen):
        return {"type": "diffuse", "reflectance": _rgb(material.base_color)}
    layered = {
        "type": "principled",
        "base_color": _rgb(material.base_color),
        "roughness": material.roughness,
        "specular": 0.5 * material.specular,  # 0.5 is an index of 1.5
        "clearcoat": material.coat,
        # Its width goes from 0.1 to 0.001 as the gloss goes from 0 to 1.
        "clearcoat_gloss": float(np.clip((0.1 - material.coat_roughness**2) / 0.099, 0, 1)),
        "sheen": material.sheen,
    }
    return {"type": "twosided", "bsdf": layered}


def _mesh(body: Mesh, bsdf: dict[str, Any]) -> Any:
    faces = triangles(body.quads)
    props = mi.Properties()
    props["mesh_bsdf"] = mi.load_dict(bsdf)
    mesh = mi.Mesh(body.name, len(body.points), len(faces), has_vertex_normals=False, props=props)
    params = mi.traverse(mesh)
    params["vertex_positions"] = body.points.astype(np.float32).ravel()
    params["faces"] = faces.astype(np.uint32).ravel()
    params.update()
    return mesh


def _lamp(panel: Panel) -> dict[str, Any]:
    half_x, half_z = panel.size[0] / 2, panel.size[1] / 2
    place = mi.ScalarTransform4f().translate(list(panel.center)).rotate([1, 0, 0], 90)
    return {
        "type": "rectangle",
        "to_world": place.scale([half_x, half_z, 1]),
        "emitter": {"type": "area", "radiance": _rgb(panel.radiance)},
        "bsdf": {"type": "diffuse", "reflectance": _rgb((0.0, 0.0, 0.0))},
    }


def _sensor(scene: Scene, resolution: int) -> dict[str, Any]:
    camera = scene.camera
    return {
        "type": "perspective",
        "fov": camera.fov,
        "fov_axis": "x",
        "near_clip": 1e-3,
        "to_world": mi.ScalarTransform4f().look_at(
            origin=list(camera.position), target=list(camera.look_at), up=[0, 1, 0]
        ),
        "film": {
            "type": "hdrfilm",
            "width": resolution,
            "height": resolution,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
            "component_format": "float32",
            "sample_border": False,
        },
        "sampler": {"type": "multijitter", "sample_count": 16},
    }


def load(scene: Scene, setting: Setting) -> Any:
    """Makes the scene in the variant that is set."""
    # A depth of d of ours allows d + 1 scatterings before the light, that is d + 2 edges.
    path = {"type": "path", "max_depth": scene.depth + 2, "rr_depth": NO_ROULETTE}
    integrator = {"type": "aov", "aovs": AOVS, "image": path} if setting.layers else path
    out: dict[str, Any] = {
        "type": "scene",
        "integrator": integrator,
        "sensor": _sensor(scene, setting.resolution),
    }
    for body in scene.bodies:
        bsdf = _bsdf(scene.materials[body.material])
        if isinstance(body, Ball):
            ball = {"type": "sphere", "center": list(body.center), "radius": body.radius}
            out[body.name] = {**ball, "bsdf": bsdf}
        else:
            out[body.name] = _mesh(body, bsdf)
    out |= {panel.name: _lamp(panel) for panel in scene.panels}
    if any(scene.sky):
        out["sky"] = {"type": "constant", "radiance": _rgb(scene.sky)}
    return mi.load_dict(out)


class Mitsuba:
    """With layers: what its `aov` integrator offers."""

    def __init__(self, scene: Scene, setting: Setting) -> None:
        import drjit as dr

        dr.set_thread_count(setting.threads)
        self._scene = load(scene, setting)
        self.layer_count = AOV_COUNT if setting.layers else 0

    def render(self, spp: int, seed: int) -> Rendered:
        start = time.perf_counter()
        picture = np.array(mi.render(self._scene, spp=spp, seed=seed))
        return Rendered(picture[..., :3], time.perf_counter() - start, spp)
