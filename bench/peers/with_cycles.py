"""The scenes in Cycles, through PyPI's bpy."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix, Vector
from renderer import Rendered, Setting, sphere_mesh, triangles
from scenes.description import Ball, Camera, Color, Material, Panel, Scene

PASSES = [
    "diffuse_direct",
    "diffuse_indirect",
    "diffuse_color",
    "glossy_direct",
    "glossy_indirect",
    "glossy_color",
    "transmission_direct",
    "transmission_indirect",
    "transmission_color",
    "subsurface_direct",
    "subsurface_indirect",
    "subsurface_color",
    "emit",
    "environment",
    "z",
    "normal",
    "position",
    "object_index",
    "material_index",
]


def _look_at(thing: Any, camera: Camera) -> None:
    z = (Vector(camera.position) - Vector(camera.look_at)).normalized()
    x = Vector((0, 1, 0)).cross(z).normalized()
    turned = Matrix((x, z.cross(x), z)).transposed().to_4x4()
    thing.matrix_world = Matrix.Translation(camera.position) @ turned


def _link(name: str, data: Any) -> Any:
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def _material(name: str, m: Material) -> Any:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")

    def connect(kind: str, **values: Any) -> Any:
        node = tree.nodes.new(kind)
        for key, value in values.items():
            node.inputs[key.replace("_", " ")].default_value = value
        tree.links.new(node.outputs[0], output.inputs["Surface"])
        return node

    if m.transmission:
        connect("ShaderNodeBsdfGlass", Color=(1, 1, 1, 1), Roughness=m.roughness, IOR=m.ior)
    elif not (m.metalness or m.specular or m.coat or m.sheen):
        connect("ShaderNodeBsdfDiffuse", Color=(*m.base_color, 1))
    else:
        connect(
            "ShaderNodeBsdfPrincipled",
            Base_Color=(*m.base_color, 1),
            Metallic=m.metalness,
            Roughness=m.roughness,
            IOR=m.ior,
            Specular_IOR_Level=0.5 * m.specular,  # 0.5: as the index says
            Specular_Tint=(m.edge_tint, m.edge_tint, m.edge_tint, 1),
            Coat_Weight=m.coat,
            Coat_Roughness=m.coat_roughness,
            Sheen_Weight=m.sheen,
            Sheen_Roughness=m.sheen_roughness,
        )
    return material


def _mesh(name: str, points: np.ndarray, faces: np.ndarray, material: Any) -> Any:
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.loops.add(faces.size)
    mesh.loops.foreach_set("vertex_index", faces.astype(np.int32).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, faces.size, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.materials.append(material)
    _link(name, mesh)
    return mesh


def _lamp(panel: Panel) -> None:
    data = bpy.data.lights.new(panel.name, "AREA")
    data.shape, data.size, data.size_y = "RECTANGLE", *panel.size
    brightest = max(panel.radiance)
    data.color = [c / brightest for c in panel.radiance]
    data.energy = brightest * np.pi * panel.size[0] * panel.size[1]
    thing = _link(panel.name, data)
    # Lamps shine along their -z; these shine down.
    down = Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0))).to_4x4()
    thing.matrix_world = Matrix.Translation(panel.center) @ down
    thing.visible_camera = thing.visible_glossy = thing.visible_transmission = panel.visible
    thing.lightgroup = panel.group


def _sky(color: Color) -> None:
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1)
    background.inputs["Strength"].default_value = 1
    bpy.context.scene.world = world


def _settings(scene: Scene, setting: Setting) -> None:
    render, settings = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine = "CYCLES"
    settings.device = "CPU"
    settings.use_adaptive_sampling = settings.use_denoising = False
    settings.max_bounces = settings.diffuse_bounces = settings.glossy_bounces = scene.depth
    settings.transmission_bounces = settings.volume_bounces = scene.depth
    settings.min_light_bounces = settings.min_transparent_bounces = scene.depth  # no roulette
    settings.sample_clamp_direct = settings.sample_clamp_indirect = 0
    settings.light_sampling_threshold = 0
    settings.blur_glossy = 0
    settings.pixel_filter_type, settings.filter_width = "BOX", 1
    render.threads_mode, render.threads = "FIXED", setting.threads
    render.resolution_x = render.resolution_y = setting.resolution
    render.use_persistent_data = True
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"


class Cycles:
    """With layers: its light passes, data passes and light groups."""

    def __init__(self, scene: Scene, setting: Setting) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        _settings(scene, setting)
        camera = bpy.data.cameras.new("camera")
        camera.angle = np.radians(scene.camera.fov)
        bpy.context.scene.camera = _link("camera", camera)
        _look_at(bpy.context.scene.camera, scene.camera)
        materials = {name: _material(name, m) for name, m in scene.materials.items()}
        for body in scene.bodies:
            if isinstance(body, Ball):
                points, _, faces = sphere_mesh(body.center, body.radius)
                ball = _mesh(body.name, points, faces, materials[body.material])
                ball.shade_smooth()
            else:
                quads = triangles(body.quads)
                _mesh(body.name, body.points, quads, materials[body.material])
        for panel in scene.panels:
            _lamp(panel)
        _sky(scene.sky)
        self._setting = setting
        self._folder = tempfile.TemporaryDirectory()
        self.layer_count = self._add_layers(scene) if setting.layers else 0

    @staticmethod
    def _add_layers(scene: Scene) -> int:
        layer = bpy.context.view_layer
        for name in PASSES:
            setattr(layer, f"use_pass_{name}", True)
        for group in scene.groups:
            layer.lightgroups.add(name=group)
        if any(scene.sky):
            bpy.context.scene.world.lightgroup = "sky"
        return len(PASSES) + len(scene.groups)

    def render(self, spp: int, seed: int) -> Rendered:
        scene = bpy.context.scene
        scene.cycles.samples, scene.cycles.seed = spp, seed
        scene.render.filepath = str(Path(self._folder.name) / "cycles.exr")
        start = time.perf_counter()
        bpy.ops.render.render(write_still=True)
        seconds = time.perf_counter() - start
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        size = self._setting.resolution
        pixels = np.array(image.pixels[:], dtype=np.float32).reshape(size, size, 4)
        bpy.data.images.remove(image)
        return Rendered(pixels[::-1, :, :3], seconds, spp)
