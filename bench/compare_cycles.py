#!/usr/bin/env python3
"""Subsurface scattering, hair and fog beside Cycles: a sheet of pictures and how far they are apart.

    python bench/compare_cycles.py [--resolution 192] [--spp 256] [--sheet out/cycles.png]

Needs Lightsieve and `pip install bpy` in the Python that runs it. Both render the same scenes (scenes/three_materials.py) with
the same noise: ours takes as many samples as that needs. For subsurface scattering they invert colours by fits of their own, so those pictures may be a few
per cent apart. Printed for each: mean of the picture by channel, the relative difference of the two means,
noise, samples a pixel and time.
"""

from __future__ import annotations

import argparse
import pathlib
import sys
import tempfile
import time
from collections.abc import Callable

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import measure  # noqa: E402

from scenes import three_materials as three  # noqa: E402


def ours(which: str, resolution: int, spp: int, seed: int) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / f"{which}.ass"
        path.write_text(three.ass(which, resolution))
        compiled = measure.compile_scene(str(path), [], threads=2, spp=spp, roulette=4, seed=seed)
        return np.array(measure.beauty(compiled.render()))[..., :3]  # type: ignore[attr-defined]


def _look_at(thing, eye: tuple[float, float, float]) -> None:  # type: ignore[no-untyped-def]
    """Places a camera or lamp at `eye`, turned to the middle; y is up."""
    from mathutils import Matrix, Vector

    z = Vector(eye).normalized()
    x = Vector((0, 1, 0)).cross(z).normalized()
    turned = Matrix((x, z.cross(x), z)).transposed().to_4x4()
    thing.matrix_world = Matrix.Translation(eye) @ turned


def _make_ball(material, radius: float) -> None:  # type: ignore[no-untyped-def]
    import bpy

    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, segments=256, ring_count=128)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(material)


def _node_material(name: str, node_type: str, socket: str):  # type: ignore[no-untyped-def]
    import bpy

    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    node = tree.nodes.new(node_type)
    tree.links.new(node.outputs[0], output.inputs[socket])
    return material, node


def _add_material(which: str) -> None:
    import bpy

    if which == "subsurface":
        material, node = _node_material("skin", "ShaderNodeSubsurfaceScattering", "Surface")
        node.falloff = "RANDOM_WALK"
        node.inputs["Color"].default_value = (*three.SKIN["color"], 1)
        node.inputs["Radius"].default_value = three.SKIN["radius"]
        node.inputs["Scale"].default_value = 1
        _make_ball(material, 1)
    elif which == "fog":
        material, node = _node_material("fog", "ShaderNodeVolumeCoefficients", "Volume")
        node.inputs["Scatter Coefficients"].default_value = three.FOG["scattering"]
        node.inputs["Absorption Coefficients"].default_value = three.FOG["absorption"]
        node.inputs["Anisotropy"].default_value = three.FOG["anisotropy"]
        _make_ball(material, 1)
    else:
        core, node = _node_material("core", "ShaderNodeBsdfDiffuse", "Surface")
        node.inputs["Color"].default_value = (0.02, 0.02, 0.02, 1)
        _make_ball(core, 0.79)
        material, node = _node_material("hair", "ShaderNodeBsdfHairPrincipled", "Surface")
        node.model = "CHIANG"
        node.inputs["Roughness"].default_value = three.HAIR["roughness"]
        node.inputs["Radial Roughness"].default_value = three.HAIR["roughness"]
        node.inputs["Offset"].default_value = np.radians(2)
        node.inputs["Random Roughness"].default_value = 0
        # Not by melanin: the two take pigments of other colours.
        node.parametrization = "ABSORPTION"
        node.inputs["Absorption Coefficient"].default_value = three.hair_absorption()
        curves = bpy.data.hair_curves.new("fur")
        strands = three.strands()
        curves.add_curves([4] * len(strands))
        flat = np.array(strands, dtype=np.float32).ravel()
        curves.attributes["position"].data.foreach_set("vector", flat)
        radius = curves.attributes.get("radius") or curves.attributes.new(
            "radius", "FLOAT", "POINT"
        )
        radius.data.foreach_set(
            "value", np.full(4 * len(strands), three.HAIR["radius"], np.float32)
        )
        curves.materials.append(material)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("fur", curves))


def cycles(which: str, resolution: int, spp: int, seed: int) -> np.ndarray:
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    settings = scene.cycles
    settings.device = "CPU"
    settings.samples, settings.seed = spp, seed
    settings.use_adaptive_sampling = settings.use_denoising = False
    settings.max_bounces = settings.diffuse_bounces = settings.glossy_bounces = three.DEPTH
    settings.transmission_bounces = settings.volume_bounces = three.DEPTH
    settings.sample_clamp_indirect = 0
    settings.pixel_filter_type = "BOX"
    settings.filter_width = 1
    scene.cycles_curves.shape = "THICK"
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.resolution_x = scene.render.resolution_y = resolution
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = three.SURROUNDING
    scene.world = world
    camera = bpy.data.objects.new("cam", bpy.data.cameras.new("cam"))
    camera.data.angle = np.radians(three.FIELD_OF_VIEW)
    _look_at(camera, three.EYE)
    lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "AREA"))
    lamp.data.shape, lamp.data.size = "SQUARE", three.LAMP_SIDE
    lamp.data.energy = three.LAMP * np.pi * three.LAMP_SIDE**2
    _look_at(lamp, three.LAMP_AT)
    for thing in (camera, lamp):
        scene.collection.objects.link(thing)
    scene.camera = camera
    _add_material(which)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        scene.render.filepath = str(pathlib.Path(folder) / "cycles.exr")
        bpy.ops.render.render(write_still=True)
        picture = bpy.data.images.load(scene.render.filepath)
        picture.colorspace_settings.name = "Non-Color"
        pixels = np.array(picture.pixels[:], dtype=np.float32)
        return pixels.reshape(resolution, resolution, 4)[::-1, :, :3]


Renderer = Callable[[str, int, int, int], np.ndarray]


def timed(
    render: Renderer, which: str, resolution: int, spp: int
) -> tuple[list[np.ndarray], float]:
    """Two renders with other seeds, and the seconds that one takes with all that goes with it."""
    start = time.perf_counter()
    pair = [render(which, resolution, spp, seed) for seed in (1, 2)]
    return pair, (time.perf_counter() - start) / 2


def noise_of(pair: list[np.ndarray]) -> float:
    """Standard deviation of a pixel's channel, from two renders."""
    return float(np.sqrt(0.5 * np.mean((pair[0] - pair[1]) ** 2)))


def _display(picture: np.ndarray) -> np.ndarray:
    x = np.clip(picture, 0, None)
    return np.where(x < 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - 0.055)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--resolution", type=int, default=192)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--sheet", type=pathlib.Path, default=pathlib.Path("out/cycles.png"))
    parser.add_argument("--only", nargs="*", default=["subsurface", "hair", "fog"])
    args = parser.parse_args()
    rows = []
    for which in args.only:
        other, seconds_other = timed(cycles, which, args.resolution, args.spp)
        pilot, _ = timed(ours, which, args.resolution, args.spp)
        spp = max(1, round(args.spp * (noise_of(pilot) / noise_of(other)) ** 2))
        pair, seconds = timed(ours, which, args.resolution, spp)
        mean, mean_other = (sum(p.mean(axis=(0, 1)) for p in x) / 2 for x in (pair, other))
        apart = ((mean - mean_other) / mean_other * 100).round(2)
        print(f"{which:12} ours {mean.round(4)}  Cycles {mean_other.round(4)}  apart {apart} %")
        print(
            f"{'':12} noise {noise_of(pair):.4f} ({spp} samples, {seconds:.1f} s)  "
            f"Cycles {noise_of(other):.4f} ({args.spp} samples, {seconds_other:.1f} s)"
        )
        rows.append(np.concatenate([pair[0], other[0]], axis=1))
    sheet = (np.clip(_display(np.concatenate(rows, axis=0)), 0, 1) * 255 + 0.5).astype(np.uint8)
    args.sheet.parent.mkdir(parents=True, exist_ok=True)
    import OpenImageIO

    out = OpenImageIO.ImageOutput.create(str(args.sheet))
    out.open(str(args.sheet), OpenImageIO.ImageSpec(sheet.shape[1], sheet.shape[0], 3, "uint8"))
    out.write_image(sheet)
    out.close()
    print(f"sheet: {args.sheet} (left ours, right Cycles)")


if __name__ == "__main__":
    main()
