"""The scenes in LuxCore, through PyPI's pyluxcore."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import numpy as np
import pyluxcore
from renderer import Rendered, Setting, sphere_mesh, triangles
from scenes.description import Ball, Color, Material, Mesh, Panel, Scene

LAYERS = [
    "EMISSION",
    "DIRECT_DIFFUSE",
    "DIRECT_GLOSSY",
    "INDIRECT_DIFFUSE",
    "INDIRECT_GLOSSY",
    "INDIRECT_SPECULAR",
    "CAUSTIC",
    "ALBEDO",
    "DEPTH",
    "POSITION",
    "SHADING_NORMAL",
    "GEOMETRY_NORMAL",
    "MATERIAL_ID",
    "OBJECT_ID",
]
NO_ROULETTE = 1000

Settings = dict[str, object]


def _properties(settings: Settings) -> pyluxcore.Properties:
    out = pyluxcore.Properties()
    for key, value in settings.items():
        values = value if isinstance(value, (list, tuple)) else [value]
        out.Set(pyluxcore.Property(key, list(values)))
    return out


def _write_ply(
    path: Path, points: np.ndarray, faces: np.ndarray, normals: np.ndarray | None = None
) -> None:
    """A binary triangle mesh: the way in that takes millions of them."""
    columns = points if normals is None else np.concatenate([points, normals], axis=1)
    names = ["x", "y", "z"] + ([] if normals is None else ["nx", "ny", "nz"])
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar uint vertex_indices"]
    rows = np.empty(len(faces), dtype=[("n", "u1"), ("v", "<u4", 3)])
    rows["n"], rows["v"] = 3, faces
    with path.open("wb") as out:
        out.write(("\n".join([*header, "end_header"]) + "\n").encode())
        out.write(columns.astype("<f4").tobytes())
        out.write(rows.tobytes())


def _surface(m: Material) -> Settings:
    if m.transmission and m.roughness == 0:
        return {"type": "glass", "interiorior": m.ior, "kr": [1, 1, 1], "kt": [1, 1, 1]}
    if m.transmission:
        width = m.roughness**2
        kinds = {"interiorior": m.ior, "uroughness": width, "vroughness": width}
        return {"type": "roughglass", "kr": [1, 1, 1], "kt": [1, 1, 1], **kinds}
    if m.metalness and m.roughness == 0:
        return {"type": "mirror", "kr": list(m.base_color)}
    if not (m.metalness or m.specular or m.coat or m.sheen):
        return {"type": "matte", "kd": list(m.base_color)}
    return {
        "type": "disney",
        "basecolor": list(m.base_color),
        "metallic": m.metalness,
        "specular": 0.5 * m.specular,  # 0.5 is an index of 1.5
        "roughness": m.roughness,
        "clearcoat": m.coat,
        "clearcoatgloss": float(np.clip((0.1 - m.coat_roughness**2) / 0.099, 0, 1)),
        "sheen": m.sheen,
    }


def _file_name(layer: str) -> str:
    """Nothing is written, but it insists on formats that could hold the layer."""
    return f"{layer}.png" if layer.endswith("_ID") else f"{layer}.exr"


class LuxCore:
    """With layers: its light channels, data channels and one radiance group for each light group."""

    def __init__(self, scene: Scene, setting: Setting) -> None:
        pyluxcore.Init()
        pyluxcore.SetLogHandler(lambda _message: None)
        self._folder = tempfile.TemporaryDirectory()
        self._groups = {name: i for i, name in enumerate(scene.groups)} if setting.layers else {}
        self._scene = pyluxcore.Scene()
        self._scene.Parse(self._camera(scene))
        for name, material in scene.materials.items():
            surface = _surface(material)
            self._parse({f"scene.materials.{name}.{k}": v for k, v in surface.items()})
        for body in scene.bodies:
            self._add_body(body)
        for panel in scene.panels:
            self._add_lamp(panel)
        if any(scene.sky):
            self._add_sky(scene.sky)
        self._depth, self._setting = scene.depth, setting
        self.layer_count = len(LAYERS) + len(scene.groups) if setting.layers else 0

    def _parse(self, settings: Settings) -> None:
        self._scene.Parse(_properties(settings))

    @staticmethod
    def _camera(scene: Scene) -> pyluxcore.Properties:
        return _properties(
            {
                "scene.camera.type": "perspective",
                "scene.camera.lookat.orig": scene.camera.position,
                "scene.camera.lookat.target": scene.camera.look_at,
                "scene.camera.up": (0.0, 1.0, 0.0),
                "scene.camera.fieldofview": scene.camera.fov,
                "scene.camera.autofocus.enable": 0,
            }
        )

    def _add_shape(
        self,
        name: str,
        material: str,
        points: np.ndarray,
        faces: np.ndarray,
        normals: np.ndarray | None = None,
    ) -> None:
        path = Path(self._folder.name) / f"{name}.ply"
        _write_ply(path, points, faces, normals)
        self._parse({f"scene.shapes.{name}.type": "mesh", f"scene.shapes.{name}.ply": str(path)})
        self._parse(
            {f"scene.objects.{name}.shape": name, f"scene.objects.{name}.material": material}
        )

    def _add_body(self, body: Mesh | Ball) -> None:
        if isinstance(body, Ball):
            points, normals, faces = sphere_mesh(body.center, body.radius)
            self._add_shape(body.name, body.material, points, faces, normals)
        else:
            self._add_shape(body.name, body.material, body.points, triangles(body.quads))

    def _add_lamp(self, panel: Panel) -> None:
        name = panel.name
        shine = {
            "type": "matte",
            "kd": [0.0, 0.0, 0.0],
            "emission": panel.radiance,
            "emission.power": 0.0,
            "emission.normalizebycolor": 0,
            "emission.id": self._groups.get(panel.group, 0),
        }
        self._parse({f"scene.materials.{name}.{k}": v for k, v in shine.items()})
        (x, y, z), (size_x, size_z) = panel.center, panel.size
        x0, x1, z0, z1 = x - size_x / 2, x + size_x / 2, z - size_z / 2, z + size_z / 2
        points = np.array([[x0, y, z0], [x1, y, z0], [x1, y, z1], [x0, y, z1]])
        self._add_shape(name, name, points, np.array([[0, 1, 2], [0, 2, 3]]))

    def _add_sky(self, color: Color) -> None:
        sky = {"type": "constantinfinite", "color": color, "id": self._groups.get("sky", 0)}
        self._parse({f"scene.lights.sky.{key}": value for key, value in sky.items()})

    def _film(self) -> Settings:
        outputs: list[Settings] = [{"type": "RGB", "filename": "rgb.exr"}]
        if self._setting.layers:
            outputs += [{"type": name, "filename": _file_name(name)} for name in LAYERS]
            outputs += [
                {"type": "RADIANCE_GROUP", "id": i, "filename": f"group{i}.exr"}
                for i in self._groups.values()
            ]
        return {
            f"film.outputs.{i}.{key}": value
            for i, output in enumerate(outputs)
            for key, value in output.items()
        }

    def _configuration(self, spp: int, seed: int) -> Settings:
        size = self._setting.resolution
        depth = {f"path.pathdepth.{k}": self._depth for k in ("diffuse", "glossy", "specular")}
        return {
            "renderengine.type": "PATHCPU",
            "renderengine.seed": seed,
            "native.threads.count": self._setting.threads,
            "sampler.type": "SOBOL",
            "sampler.sobol.adaptive.strength": 0.0,
            "path.pathdepth.total": self._depth + 1,
            **depth,
            "path.russianroulette.depth": NO_ROULETTE,
            "path.clamping.variance.maxvalue": 0.0,
            "film.width": size,
            "film.height": size,
            "film.filter.type": "BOX",
            "film.filter.width": 0.5,
            "film.noiseestimation.warmup": 1 << 30,
            "batch.haltspp": [spp, 0],
            **self._film(),
        }

    def render(self, spp: int, seed: int) -> Rendered:
        config = pyluxcore.RenderConfig(_properties(self._configuration(spp, seed)), self._scene)
        session = pyluxcore.RenderSession(config)
        session.Start()  # builds what rays are traced against
        start = time.perf_counter()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()  # looks whether there are samples enough
        seconds = time.perf_counter() - start
        done = session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat()
        session.Stop()
        size = self._setting.resolution
        pixels = np.zeros((size, size, 3), dtype=np.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels, 0, False)
        return Rendered(pixels[::-1], seconds, done / size**2)
