"""Scenes that are too much or too little of something, by name."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

OPTIONS = {
    "xres": "8",
    "yres": "6",
    "camera": "cam",
    "outputs": '"RGBA RGBA box drv"',
    "GI_diffuse_depth": "1",
    "GI_specular_depth": "1",
}
CAMERA = "persp_camera { name cam position 0 0 5 }\n"
OUTPUT = "box_filter { name box }\ndriver_exr { name drv filename x.exr }\n"
LIGHT = "point_light { name key position 2 2 4 intensity 50 }\n"
BALL = "sphere { name ball radius 1 shader look }\nstandard_surface { name look }\n"
QUAD = "nsides 4\n vidxs 4 1 UINT 0 1 2 3\n vlist 4 1 VECTOR -1 -1 0 1 -1 0 1 1 0 -1 1 0\n"
QUAD_PARTS = {
    "nsides": "nsides 1 1 UINT 4",
    "vidxs": "vidxs 4 1 UINT 0 1 2 3",
    "vlist": "vlist 4 1 VECTOR -1 -1 0 1 -1 0 1 1 0 -1 1 0",
}

WHOLE_OPTIONS = """
AA_samples AA_samples_max GI_diffuse_samples GI_specular_samples GI_transmission_samples
GI_sss_samples GI_volume_samples GI_diffuse_depth GI_specular_depth GI_transmission_depth
GI_volume_depth GI_total_depth auto_transparency_depth light_samples bucket_size AA_seed
region_min_x region_max_x region_min_y region_max_y threads texture_max_memory_MB
texture_max_open_files max_subdivisions
"""
FLOAT_OPTIONS = """
AA_sample_clamp indirect_sample_clamp low_light_threshold pixel_aspect_ratio frame fps
reference_time meters_per_unit AA_adaptive_threshold
"""
PLACES = """
/dev/zero /dev/full /dev/stdin /dev/tty / . SELF /proc/self/mem /proc/self/environ PIPE
/none/there.exr <udim> <udim><tile><udim> <frame:999999999> <attr:x> %d $HOME ~ https://x/y
"""
"""Names where a file is expected: no files, or not of that kind."""

FLOATS = ("nan", "inf", "-inf", "0", "-1", "1e38", "-1e38", "1e-38")
WHOLE = ("2147483647", "-2147483648", "0", "-1", "100000")


def scene(nodes: str, options: Mapping[str, str] | None = None, *, camera: str = CAMERA) -> str:
    """Nodes with a camera, a light and outputs around them; the values of `options` win."""
    lines = "\n".join(f" {key} {value}" for key, value in {**OPTIONS, **(options or {})}.items())
    return f"options\n{{\n{lines}\n}}\n{camera}{OUTPUT}{LIGHT}{nodes}"


def settings() -> Iterator[tuple[str, str]]:
    """Options at values that make no sense, or too much of it."""
    for name in WHOLE_OPTIONS.split():
        for value in WHOLE:
            yield f"option-{name}-{value}", scene(BALL, {name: value})
    for name in FLOAT_OPTIONS.split():
        for value in ("nan", "inf", "-1", "0", "1e38"):
            yield f"option-{name}-{value}", scene(BALL, {name: value})


def pictures() -> Iterator[tuple[str, str]]:
    """Frames of strange sizes, filters and outputs."""
    for width, height in (
        (1, 1),
        (1, 20000),
        (20000, 1),
        (0, 0),
        (-1, 5),
        (65536, 65536),
        (32768, 32768),
        (2147483647, 2147483647),
    ):
        size = {"xres": str(width), "yres": str(height)}
        yield f"frame-{width}x{height}", scene(BALL, size)
        yield f"frame-{width}x{height}-one-bucket", scene(BALL, {**size, "bucket_size": "65536"})
    for reach in FLOATS:
        for kind in ("gaussian_filter", "sinc_filter", "catrom_filter", "triangle_filter"):
            yield (
                f"filter-{kind}-{reach}",
                scene(
                    BALL + f"{kind} {{ name f width {reach} }}\n", {"outputs": '"RGBA RGBA f drv"'}
                ),
            )
    many = " ".join(f'"a{i} RGB box drv"' for i in range(3000))
    expressions = " ".join(f"\"a{i} C.*<L.'g{i}'>\"" for i in range(3000))
    yield (
        "outputs-3000",
        scene(
            BALL,
            {
                "outputs": f"3000 1 STRING {many}",
                "light_path_expressions": f"3000 1 STRING {expressions}",
            },
        ),
    )
    for name, text in (
        ("long", "C" + ".*" * 50000),
        ("nested", "C" + "(" * 50000 + ")" * 50000),
        ("wide", "C" + "|".join(["R"] * 20000)),
        ("repeat", "C.{1000000,1000000}L"),
        ("nothing", ""),
    ):
        yield (
            f"expression-{name}",
            scene(
                BALL,
                {"outputs": '"a RGB box drv"', "light_path_expressions": f'"a {text}"'},
            ),
        )
    for output in (
        "",
        "RGBA",
        "RGBA RGBA",
        "RGBA RGBA none none",
        "a " * 10000,
        "%s %n %s %n",
        "\\",
    ):
        yield f"output-{output[:12]!r}", scene(BALL, {"outputs": f'"{output}"'})
    for path in (
        "",
        "/",
        "/dev/null/x.exr",
        "none/where.exr",
        "x" * 5000,
        "../../..",
        "/proc/x.exr",
    ):
        yield (
            f"file-{path[:20]!r}",
            scene(
                BALL + f'driver_exr {{ name d filename "{path}" }}\n',
                {"outputs": '"RGBA RGBA box d"'},
            ),
        )


CAMERAS = {
    "persp_camera": "fov near_clip far_clip shutter_start shutter_end aperture_size "
    "focus_distance "
    "aperture_blades aperture_rotation exposure radial_distortion",
    "ortho_camera": "near_clip far_clip shutter_start exposure",
    "fisheye_camera": "fov exposure",
    "spherical_camera": "exposure",
    "cyl_camera": "horizontal_fov vertical_fov",
}


def cameras() -> Iterator[tuple[str, str]]:
    """Cameras at impossible values, and none."""
    for kind, params in CAMERAS.items():
        for param in params.split():
            for value in ("nan", "inf", "0", "-1", "1e38"):
                yield (
                    f"{kind}-{param}-{value}",
                    scene(BALL, camera=f"{kind} {{ name cam position 0 0 5 {param} {value} }}\n"),
                )
        for name, matrix in matrices().items():
            yield (
                f"{kind}-matrix-{name}",
                scene(BALL, camera=f"{kind} {{ name cam matrix {matrix} }}\n"),
            )
    yield "camera-is-a-light", scene(BALL, {"camera": "key"})
    yield "camera-at-its-target", scene(BALL, camera="persp_camera { name cam look_at 0 0 0 }\n")


def matrices() -> dict[str, str]:
    """Matrices that cannot be inverted, or are no numbers."""

    def diagonal(x: str, y: str, z: str, w: str = "1") -> str:
        return f"{x} 0 0 0 0 {y} 0 0 0 0 {z} 0 0 0 0 {w}"

    return {
        "nan": diagonal("nan", "nan", "nan"),
        "inf": diagonal("inf", "1", "1"),
        "zero": diagonal("0", "0", "0", "0"),
        "flat": diagonal("1", "0", "1"),
        "huge": diagonal("1e38", "1e38", "1e38"),
        "tiny": diagonal("1e-38", "1e-38", "1e-38"),
        "far": "1 0 0 0 0 1 0 0 0 0 1 0 1e38 1e38 1e38 1",
        "perspective": "1 0 0 1 0 1 0 1 0 0 1 1 0 0 0 0",
    }


SHAPES = {
    "polymesh": QUAD,
    "sphere": "radius 1",
    "box": "",
    "plane": "",
    "cylinder": "",
    "cone": "",
    "disk": "",
    "points": "points 2 1 VECTOR 0 0 0 1 0 0 radius 0.5",
    "curves": "num_points 4 points 4 1 VECTOR -1 0 0 0 1 0 1 0 0 2 0 0 radius 0.1 basis bezier",
    "ginstance": "node ball",
    "instancer": "nodes ball instance_matrix 1 1 MATRIX 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 "
    "node_idxs 0",
    "volume": "step_size 0.1",
}


def transforms() -> Iterator[tuple[str, str]]:
    """Every shape and light under every bad matrix."""
    lights = (
        "quad_light disk_light cylinder_light spot_light point_light distant_light skydome_light"
    )
    for name, matrix in matrices().items():
        for kind, body in SHAPES.items():
            yield (
                f"{kind}-{name}",
                scene(BALL + f"{kind} {{ name odd {body} matrix {matrix} shader look }}\n"),
            )
        for kind in lights.split():
            yield f"{kind}-{name}", scene(BALL + f"{kind} {{ name odd matrix {matrix} }}\n")
    keys = "matrix 2 2 MATRIX " + " ".join(["nan"] * 64)
    yield "keys-of-nan", scene(BALL + f"sphere {{ name odd {keys} }}\n")


def mesh(**parts: str) -> str:
    """A mesh that is a square but for the given parts; empty: left out."""
    body = "\n ".join(text for text in {**QUAD_PARTS, **parts}.values() if text)
    return f"polymesh\n{{\n name odd\n {body}\n shader look\n}}\n"


def meshes() -> Iterator[tuple[str, str]]:
    """Meshes whose arrays are empty, do not fit, or point nowhere."""
    odd: dict[str, dict[str, str]] = {f"no-{part}": {part: ""} for part in QUAD_PARTS}
    odd |= {f"empty-{part}": {part: f"{part} 0 1 UINT"} for part in ("nsides", "vidxs")}
    odd |= {
        "nothing": dict.fromkeys(QUAD_PARTS, ""),
        "empty-vlist": {"vlist": "vlist 0 1 VECTOR"},
        "sides-of-two": {"nsides": "nsides 2 1 UINT 2 2"},
        "sides-of-none": {"nsides": "nsides 4 1 UINT 0 0 0 0"},
        "too-many-sides": {"nsides": "nsides 1 1 UINT 4000000000"},
        "sides-that-overflow": {"nsides": "nsides 2 1 UINT 4294967295 5"},
        "index-out-of-range": {"vidxs": "vidxs 4 1 UINT 0 1 2 4"},
        "index-far-out": {"vidxs": "vidxs 4 1 UINT 0 1 2 4294967295"},
        "one-corner": {"vidxs": "vidxs 4 1 UINT 0 0 0 0"},
        "same-points": {"vlist": "vlist 4 1 VECTOR" + " 1 1 1" * 4},
        "nan-points": {"vlist": "vlist 4 1 VECTOR" + " nan nan nan" * 4},
        "inf-points": {"vlist": "vlist 4 1 VECTOR" + " inf 0 0" * 4},
        "huge-points": {
            "vlist": "vlist 4 1 VECTOR -3e38 -3e38 0 3e38 -3e38 0 3e38 3e38 0 0 3e38 0"
        },
        "keys-of-unlike-size": {"vlist": "vlist 3 2 VECTOR" + " 0 0 0" * 6},
        "count-beyond-file": {"vlist": "vlist 4000000000 1 VECTOR 0 0 0"},
        "count-negative": {"vlist": "vlist -4 1 VECTOR 0 0 0"},
        "keys-negative": {"vlist": "vlist 4 -1 VECTOR 0 0 0"},
        "keys-255": {"vlist": "vlist 4 255 VECTOR" + " 0 1 2" * 4 * 255},
    }
    for name, parts in odd.items():
        yield f"mesh-{name}", scene(BALL + mesh(**parts))
        yield (
            f"mesh-{name}-subdivided",
            scene(BALL + mesh(**parts, more="subdiv_type catclark subdiv_iterations 2")),
        )
    more = {
        "normals-out-of-range": "nlist 1 1 VECTOR 0 0 1 nidxs 4 1 UINT 0 0 9 0",
        "normals-nan": "nlist 1 1 VECTOR nan nan nan nidxs 4 1 UINT 0 0 0 0",
        "uvs-out-of-range": "uvlist 1 1 VECTOR2 0 0 uvidxs 4 1 UINT 0 0 0 4000000000",
        "uvs-nan": "uvlist 1 1 VECTOR2 nan inf uvidxs 4 1 UINT 0 0 0 0",
        "uvs-too-few": "uvlist 1 1 VECTOR2 0 0 uvidxs 1 1 UINT 0",
        "shaders-out-of-range": "shidxs 1 1 BYTE 200",
        "crease-out-of-range": "subdiv_type catclark subdiv_iterations 1 "
        "crease_idxs 2 1 UINT 7 900 "
        "crease_sharpness 1 1 FLOAT nan",
        "crease-odd": "subdiv_type catclark subdiv_iterations 1 crease_idxs 3 1 UINT 0 1 2 "
        "crease_sharpness 2 1 FLOAT 1e38 -5",
        "iterations-255": "subdiv_type catclark subdiv_iterations 255",
        "iterations-15": "subdiv_type catclark subdiv_iterations 15",
        "adaptive-to-nothing": "subdiv_type catclark subdiv_iterations 200 "
        "subdiv_adaptive_error 1e-30",
        "displaced-inf": "disp_height inf disp_map noisy",
        "displaced-nan": "disp_height nan disp_zero_value nan disp_padding nan disp_map noisy",
        "holes-out-of-range": "polygon_holes 2 1 UINT 5 90",
        "user-data-too-short": "declare d uniform FLOAT d 0 1 FLOAT",
        "user-data-indexed-out": "declare d indexed FLOAT d 1 1 FLOAT 1 didxs 4 1 UINT 0 1 2 99",
        "step-size-nan": "step_size nan volume_padding inf",
    }
    for name, text in more.items():
        yield f"mesh-{name}", scene(BALL + "noise { name noisy }\n" + mesh(more=text))


LIGHTS = {
    "point_light": "radius intensity exposure color samples",
    "spot_light": "radius cone_angle penumbra_angle cosine_power roundness lens_radius "
    "aspect_ratio",
    "distant_light": "angle direction intensity",
    "quad_light": "vertices roundness soft_edge spread resolution",
    "disk_light": "radius spread",
    "cylinder_light": "radius bottom top",
    "skydome_light": "resolution intensity color",
    "photometric_light": "filename radius",
    "mesh_light": "mesh intensity",
}


def lights() -> Iterator[tuple[str, str]]:
    """Lights of no size, of no strength and of too much."""
    for kind, params in LIGHTS.items():
        for param in params.split():
            for value in ("nan", "0", "-1", "1e38", "inf"):
                given = " ".join(
                    [value] * {"color": 3, "direction": 3, "vertices": 12}.get(param, 1)
                )
                yield (
                    f"{kind}-{param}-{value}",
                    scene(BALL + f"{kind} {{ name odd {param} {given} }}\n"),
                )
    yield (
        "mesh-light-empty",
        scene(BALL + mesh(nsides="", vidxs="", vlist="") + "mesh_light { name l mesh odd }\n"),
    )
    yield "mesh-light-of-itself", scene(BALL + "mesh_light { name l mesh l }\n")
    yield (
        "lights-10000",
        scene(
            BALL + "".join(f"point_light {{ name p{i} position {i} 1 1 }}\n" for i in range(10000))
        ),
    )


def circles() -> Iterator[tuple[str, str]]:
    """Nodes that lead back to themselves, and chains without an end."""
    for kind, param in (("ginstance", "node"), ("instancer", "nodes")):
        yield f"{kind}-of-itself", scene(BALL + f"{kind} {{ name a {param} a }}\n")
        yield (
            f"{kind}-of-two",
            scene(BALL + f"{kind} {{ name a {param} b }}\n{kind} {{ name b {param} a }}\n"),
        )
        chain = "".join(f"{kind} {{ name n{i} {param} n{i + 1} }}\n" for i in range(20000))
        yield f"{kind}-chain", scene(BALL + chain + f"{kind} {{ name n20000 {param} ball }}\n")
    eye = " 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
    tower = "".join(
        f"instancer {{ name t{i} nodes {'ball' if i == 0 else f't{i - 1}'} "
        f"instance_matrix 100 1 MATRIX{eye * 100} node_idxs 100 1 UINT{' 0' * 100} }}\n"
        for i in range(8)
    )
    yield "instances-10-to-the-16", scene(BALL + tower)
    yield "shader-of-itself", scene(BALL + "mix_shader { name m shader1 m shader2 m }\n")
    for kind, param in (
        ("multiply", "input1"),
        ("mix_rgba", "input1"),
        ("layer_shader", "input1"),
        ("switch_shader", "input0"),
        ("noise", "color1"),
        ("bump2d", "normal"),
        ("switch_operator", "inputs"),
        ("merge", "inputs"),
    ):
        pair = f"{kind} {{ name a {param} b }}\n{kind} {{ name b {param} a }}\n"
        use = "standard_surface { name look base_color a }\nsphere { name s shader look }\n"
        yield f"{kind}-in-a-circle", scene(pair + use, {"operator": "a"})
        long = "".join(f"{kind} {{ name a{i} {param} a{i + 1} }}\n" for i in range(3000))
        yield f"{kind}-in-a-chain", scene(long + use.replace("color a", "color a0"))
    yield "procedural-of-itself", scene(BALL + "procedural { name p filename SELF }\n")
    yield "include-of-itself", scene(BALL + 'include "SELF"\n')


def files() -> Iterator[tuple[str, str]]:
    """Names of files that are no files, or not of that kind."""
    places = [*PLACES.split(), "", "a" * 100000, "../" * 1000 + "x.png"]
    for number, place in enumerate(places):
        for kind, text in (
            ("image", f'image {{ name t filename "{place}" }}\nflat {{ name look color t }}\n'),
            ("volume", f'volume {{ name t filename "{place}" grids density shader look }}\n'),
            ("procedural", f'procedural {{ name t filename "{place}" }}\n'),
            ("photometric", f'photometric_light {{ name t filename "{place}" }}\n'),
            ("include", f'include "{place}"\n'),
            ("ocio", f'color_manager_ocio {{ name t config "{place}" }}\n'),
        ):
            options = {"color_manager": "t"} if kind == "ocio" else {}
            ball = "sphere { name ball shader look }\n"
            yield f"{kind}-file-{number}", scene(ball + text, options)


def amounts() -> Iterator[tuple[str, str]]:
    """Too many of something."""
    yield (
        "nodes-1000000",
        scene(
            "".join(
                f"sphere {{ name s{i} center {i % 1000} {i // 1000} 0 }}\n" for i in range(1000000)
            )
        ),
    )
    yield (
        "shaders-100000",
        scene(BALL + "".join(f"standard_surface {{ name m{i} }}\n" for i in range(100000))),
    )
    yield "one-name-10000-times", scene(BALL + "sphere { name same }\n" * 10000)
    yield "parameters-100000", scene("sphere {\n" + " radius 1\n" * 100000 + "}\n")
    yield "name-of-1000000-letters", scene(f"sphere {{ name {'n' * 1000000} }}\n")
    yield "braces", "{" * 100000
    yield "nothing", ""
    yield "zeros", "\0" * 100000
    yield (
        "sharp-corners-100000",
        scene(
            BALL
            + mesh(
                nsides="nsides 1 1 UINT 100000",
                vidxs="vidxs 100000 1 UINT " + " ".join(map(str, range(100000))),
                vlist="vlist 100000 1 VECTOR "
                + " ".join(f"{(i * 7919) % 1000} {(i * 104729) % 997} 0" for i in range(100000)),
            )
        ),
    )
    yield (
        "points-1000000",
        scene(
            BALL + f"points {{ name p points 1000000 1 VECTOR{' 0 0 0' * 1000000} radius 0.1 }}\n"
        ),
    )
    yield "curves-of-nothing", scene("curves { name c num_points 3 1 UINT 0 4000000000 4 }\n")
    yield (
        "curves-that-overflow",
        scene(
            "curves { name c num_points 2 1 UINT 4294967292 8 points 4 1 VECTOR"
            + " 0 1 0" * 4
            + " }\n"
        ),
    )
    yield (
        "keys-10000",
        scene(
            BALL
            + "sphere { name k matrix 1 10000 MATRIX"
            + " 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1" * 10000
            + " }\n"
        ),
    )
    yield "packed-bomb", scene("points { name p points 100000000 1 b85VECTOR !zzzzzzzzzz }\n")
    yield "packed-run", scene("points { name p points 300000000 1 b85VECTOR\n!z&gL2r }\n")


GROUPS: tuple[Callable[[], Iterator[tuple[str, str]]], ...] = (
    settings,
    pictures,
    cameras,
    transforms,
    meshes,
    lights,
    circles,
    files,
    amounts,
)


def absurdities(group: str) -> dict[str, str]:
    """The scenes of one group, by name."""
    (function,) = (f for f in GROUPS if f.__name__ == group)
    return dict(function())


def write(text: str, path: Path) -> Path:
    """Writes a scene; SELF is the file itself, PIPE a pipe that nobody writes to."""
    if "PIPE" in text:
        os.mkfifo(path.parent / "pipe")
    path.write_text(
        text.replace("SELF", path.name).replace("PIPE", str(path.parent / "pipe")), "latin-1"
    )
    return path
