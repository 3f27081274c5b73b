#!/usr/bin/env python3
"""Writes scenes/showcase.ass: run it after changing what stands on the table.

The scene is plain text; only its curved shapes (torus knot, lamp shade, backdrop) are computed here.
"""

import math
import pathlib
from collections.abc import Callable, Iterable

HEADER = """\
# Showcase: a still life in which every built-in AOV has light in it.
#
#   red torus knot     base and clear coat                    diffuse, coat
#   blue ball          cloth                                  sheen
#   copper ball        rough metal                            specular
#   glass ball         refraction, an interior that tints     transmission, caustics off
#   jade ball          closures with labels                   sss (walks below the surface), sss_jade
#   fur ball           2000 curves                            hair (label of every lobe)
#   incense            smoke.vdb, embers at its foot          volume (V), emission, both labelled smoke
#   tinted pane        thin-walled glass, the sky behind it   transmission_direct
#   paper lamp         thin-walled, lit from inside           sss (diffuse transmission), opacity
#   filament           emissive shape inside the lamp         emission (O)
#   neon tube          emissive shape behind the table        emission, indirect light
#   checked table      texture without an image file          diffuse / diffuse_albedo
#   dome               dim sky seen by the camera             background (B)
#
# Light groups: key (quad), rim (spot), lamp (point in the lamp); the dome and the fill light have none.
"""

Vec = tuple[float, float, float]


def fmt(x: float) -> str:
    return f"{x:.5g}"


def vectors(points: Iterable[Vec]) -> str:
    return "\n".join("  " + " ".join(fmt(c) for c in p) for p in points)


def grid_mesh(
    name: str,
    shader: str,
    n_u: int,
    n_v: int,
    surface: Callable[[float, float], Vec],
    closed: bool,
    uv_scale: float = 1,
) -> str:
    """A mesh of quads over the unit square; `closed` joins u = 0 with u = 1. Normals by differences."""
    columns = n_u if closed else n_u + 1
    points, normals, uvs = [], [], []
    step = 1e-4
    for j in range(n_v + 1):
        for i in range(columns):
            u, v = i / n_u, j / n_v
            p = surface(u, v)
            a, b = surface(u + step, v), surface(u, v + step)
            du = [a[k] - p[k] for k in range(3)]
            dv = [b[k] - p[k] for k in range(3)]
            n = (
                du[1] * dv[2] - du[2] * dv[1],
                du[2] * dv[0] - du[0] * dv[2],
                du[0] * dv[1] - du[1] * dv[0],
            )
            length = math.sqrt(sum(c * c for c in n)) or 1
            points.append(p)
            normals.append((n[0] / length, n[1] / length, n[2] / length))
            uvs.append((u * uv_scale, v * uv_scale))
    faces = []
    for j in range(n_v):
        for i in range(n_u):
            right = (i + 1) % columns
            faces.append(
                (
                    j * columns + i,
                    j * columns + right,
                    (j + 1) * columns + right,
                    (j + 1) * columns + i,
                )
            )
    indices = "\n".join("  " + " ".join(map(str, f)) for f in faces)
    return f"""
polymesh
{{
 name {name}
 shader "{shader}"
 smoothing on
 nsides {len(faces)} 1 UINT
  {" ".join("4" for _ in faces)}
 vidxs {4 * len(faces)} 1 UINT
{indices}
 nidxs {4 * len(faces)} 1 UINT
{indices}
 uvidxs {4 * len(faces)} 1 UINT
{indices}
 vlist {len(points)} 1 VECTOR
{vectors(points)}
 nlist {len(points)} 1 VECTOR
{vectors(normals)}
 uvlist {len(uvs)} 1 VECTOR2
{chr(10).join("  " + fmt(a) + " " + fmt(b) for a, b in uvs)}
}}
"""


def knot(u: float, v: float) -> Vec:
    """A (2,3) torus knot with a round tube; u runs along it."""
    center_at = lambda t: (
        (0.42 + 0.17 * math.cos(3 * t)) * math.cos(2 * t),
        0.17 * math.sin(3 * t),
        (0.42 + 0.17 * math.cos(3 * t)) * math.sin(2 * t),
    )
    t = 2 * math.pi * u
    c, d = center_at(t), center_at(t + 1e-3)
    tangent = [d[k] - c[k] for k in range(3)]
    length = math.sqrt(sum(x * x for x in tangent))
    tangent = [x / length for x in tangent]
    outward = [c[0], 0.0, c[2]]
    along = sum(outward[k] * tangent[k] for k in range(3))
    n = [outward[k] - along * tangent[k] for k in range(3)]
    length = math.sqrt(sum(x * x for x in n))
    n = [x / length for x in n]
    b = [
        tangent[1] * n[2] - tangent[2] * n[1],
        tangent[2] * n[0] - tangent[0] * n[2],
        tangent[0] * n[1] - tangent[1] * n[0],
    ]
    phi, r = -2 * math.pi * v, 0.125
    p = [c[k] + r * (math.cos(phi) * n[k] + math.sin(phi) * b[k]) for k in range(3)]
    # Stand it up, lean it a little, put it on the table.
    x, y, z = p
    y, z = y * 0.25 - z * 0.97, y * 0.97 + z * 0.25
    return (x - 0.15, y + 0.715, z - 0.35)


def shade(u: float, v: float) -> Vec:
    """The paper lamp: a pleated barrel."""
    phi = -2 * math.pi * u
    r = (0.30 + 0.05 * math.sin(math.pi * v)) * (1 + 0.025 * math.cos(24 * phi))
    return (1.25 + r * math.cos(phi), 0.12 + 0.95 * v, -0.55 + r * math.sin(phi))


def table(u: float, v: float) -> Vec:
    """A sweep: flat in front, rising behind."""
    depth = -1.9 + 5.4 * v
    rise = max(0.0, -depth - 1.1)
    return (-4.5 + 9 * u, 0.9 * rise * rise, depth)


def tube(u: float, v: float) -> Vec:
    """A neon tube: a thin arc behind the things."""
    t = math.pi * (0.08 + 0.84 * v)
    c = (-0.1 + 2.05 * math.cos(t), 1.62 * math.sin(t) - 0.05, -1.25)
    radial = (math.cos(t), math.sin(t), 0.0)
    phi, r = 2 * math.pi * u, 0.022
    return tuple(
        c[k] + r * (math.cos(phi) * radial[k] + math.sin(phi) * (0, 0, 1)[k]) for k in range(3)
    )


NODES = """
options
{
 AA_samples 8
 xres 640
 yres 360
 camera "camera"
 GI_diffuse_depth 2
 GI_specular_depth 2
 GI_transmission_depth 6
 GI_volume_depth 2
 GI_total_depth 8
@OUTPUTS@}

persp_camera
{
 name camera
 position 0.25 1.7 5.6
 look_at 0 0.62 -0.2
 up 0 1 0
 fov 37
}

gaussian_filter
{
 name filter
 width 2
}

closest_filter
{
 name closest
}

driver_exr
{
 name exr
 filename "showcase.exr"
 color_space ""
}

# ---- lights ----

quad_light
{
 name key_light
 aov "key"
 transmission 1
 vertices 4 1 VECTOR
  -2.6 2.9 0.9  -1.5 3.5 1.7  -1.2 2.6 2.6  -2.3 2.0 1.8
 color 1 0.86 0.7
 intensity 26
}

spot_light
{
 name rim_light
 aov "rim"
 position 2.9 2.7 -2.4
 look_at 0.1 0.5 -0.1
 cone_angle 46
 penumbra_angle 12
 radius 0.12
 color 0.62 0.78 1
 intensity 34
}

point_light
{
 name lamp_light
 aov "lamp"
 position 1.25 0.62 -0.55
 radius 0.05
 color 1 0.68 0.36
 intensity 0.9
}

quad_light
{
 name fill_light
 vertices 4 1 VECTOR
  3.2 0.4 2.2  2.6 0.4 3.2  2.6 2.2 3.2  3.2 2.2 2.2
 color 0.75 0.85 1
 intensity 2.5
}

skydome_light
{
 name dome
 color 0.055 0.06 0.085
 camera 1
}

# ---- shaders ----

checkerboard
{
 name checks
 color1 0.36 0.33 0.3
 color2 0.16 0.15 0.15
 u_frequency 12
 v_frequency 7.2
}

standard_surface
{
 name table_shader
 base 1
 base_color "checks"
 specular 0.35
 specular_roughness 0.35
}

standard_surface
{
 name knot_shader
 base 1
 base_color 0.55 0.025 0.03
 specular 0
 coat 1
 coat_color 1 0.95 0.9
 coat_roughness 0.06
}

standard_surface
{
 name cloth_shader
 base 1
 base_color 0.04 0.08 0.3
 diffuse_roughness 0.6
 specular 0
 sheen 1
 sheen_color 0.75 0.8 1
 sheen_roughness 0.4
}

standard_surface
{
 name copper_shader
 base 1
 base_color 0.9 0.5 0.3
 metalness 1
 specular_roughness 0.28
}

standard_surface
{
 name glass_shader
 base 0
 specular_roughness 0
 specular_IOR 1.5
 transmission 1
 transmission_color 0.75 0.93 0.88
 transmission_depth 0.72
}

subsurface_bsdf
{
 name jade_body
 color 0.4 0.78 0.5
 radius 0.16 0.12 0.06
 label "jade"
}

dielectric_bsdf
{
 name jade_polish
 roughness 0.01 0.01
 ior 1.6
 label "polish"
}

layer
{
 name jade_shader
 top "jade_polish"
 base "jade_body"
}

standard_hair
{
 name fur_shader
 base 1
 base_color 1 1 1
 melanin 0.32
 melanin_redness 0.55
 roughness 0.28
 ior 1.55
}

lambert
{
 name fur_core_shader
 Kd 0.08
 Kd_color 1 0.8 0.6
}

standard_surface
{
 name pane_shader
 thin_walled on
 base 0
 specular_roughness 0
 transmission 1
 transmission_color 0.5 0.85 0.9
}

standard_surface
{
 name paper_shader
 thin_walled on
 base 1
 base_color 0.8 0.76 0.68
 specular 0.2
 specular_roughness 0.5
 subsurface 0.55
 subsurface_color 0.95 0.82 0.62
 opacity 0.94 0.94 0.94
}

standard_surface
{
 name filament_shader
 base 0
 specular 0
 emission 5
 emission_color 1 0.62 0.28
}

standard_surface
{
 name neon_shader
 base 0
 specular 0
 emission 2.4
 emission_color 0.95 0.16 0.5
}

standard_volume
{
 name smoke_shader
 density 9
 scatter_color 0.92 0.92 0.95
 scatter_anisotropy 0.25
 blackbody_kelvin 1900
 blackbody_intensity 60
 label "smoke"
}

lambert
{
 name incense_shader
 Kd 0.5
 Kd_color 0.35 0.2 0.12
}

# ---- shapes ----

volume
{
 name smoke
 filename "smoke.vdb"
 grids 2 1 STRING "density" "temperature"
 matrix 0.7 0 0 0  0 0.7 0 0  0 0 0.7 0  -0.95 0.1 -0.3 1
 shader "smoke_shader"
}

sphere
{
 name incense
 center -0.95 0.05 -0.3
 radius 0.07
 shader "incense_shader"
}

sphere
{
 name cloth_ball
 center -1.3 0.42 0.35
 radius 0.42
 shader "cloth_shader"
}

sphere
{
 name copper_ball
 center -0.55 0.25 1.0
 radius 0.25
 shader "copper_shader"
}

sphere
{
 name glass_ball
 center 0.62 0.36 0.72
 radius 0.36
 shader "glass_shader"
}

sphere
{
 name jade_ball
 center 0.1 0.2 1.25
 radius 0.2
 shader "jade_shader"
}

sphere
{
 name fur_core
 center 1.2 0.27 0.95
 radius 0.14
 shader "fur_core_shader"
}

polymesh
{
 name pane
 shader "pane_shader"
 nsides 1 1 UINT 4
 vidxs 4 1 UINT 0 1 2 3
 vlist 4 1 VECTOR
  -2.1 0.02 -0.8  -1.3 0.02 -1.05  -1.3 1.55 -1.05  -2.1 1.55 -0.8
}

sphere
{
 name filament
 center 1.25 0.9 -0.55
 radius 0.045
 shader "filament_shader"
}
"""


# Every built-in AOV. A star makes one layer for each light group.
LIGHT_AOVS = """
RGBA_* direct indirect emission background
diffuse diffuse_direct diffuse_indirect specular specular_direct specular_indirect
coat coat_direct coat_indirect sheen sheen_direct sheen_indirect
transmission transmission_direct transmission_indirect sss sss_direct sss_indirect
volume volume_direct volume_indirect
sss_jade hair smoke albedo denoise_albedo diffuse_albedo specular_albedo coat_albedo sheen_albedo transmission_albedo sss_albedo volume_albedo
reflections
"""


def fur(name: str, shader: str, center: Vec, radius: float, length: float, count: int) -> str:
    """Curves that stand on a ball, bend down and part a little: catmull-rom, whose outer points only steer."""
    n = 6
    points: list[Vec] = []
    for i in range(count):
        # Roots evenly over the ball (Fibonacci's spiral); leanings from an even sequence, so that every run writes the same.
        y = 1 - 2 * (i + 0.5) / count
        turn = math.pi * (1 + math.sqrt(5)) * i
        across = math.sqrt(1 - y * y)
        root = (across * math.cos(turn), y, across * math.sin(turn))
        lean = [
            0.7 * ((i * step) % 1 - 0.5) for step in (0.6180339887, 0.7548776662, 0.5698402910)
        ]
        for k in range(n):
            s = (k - 1) / (n - 3)
            out = radius + length * s * (1 - 0.15 * s)
            points.append(
                tuple(
                    center[c]
                    + root[c] * out
                    + length * (lean[c] * s * abs(s) - (0.45 * s * s if c == 1 else 0))
                    for c in range(3)
                )  # type: ignore[arg-type]
            )
    return f"""
curves
{{
 name {name}
 shader "{shader}"
 basis "catmull-rom"
 mode "ribbon"
 num_points {count} 1 UINT
  {" ".join([str(n)] * count)}
 points {len(points)} 1 VECTOR
{vectors(points)}
 radius {count} 1 FLOAT
  {" ".join(["0.0022"] * count)}
}}
"""


def outputs() -> str:
    strings = ["RGBA RGBA filter exr"]
    strings += [f"{name} RGB filter exr" for name in LIGHT_AOVS.split()]
    strings += [
        "volume_opacity RGB filter exr",
        "Z FLOAT closest exr",
        "N VECTOR closest exr",
        "P VECTOR closest exr",
        "ID UINT closest exr",
    ]
    lines = "\n".join(f'  "{s}"' for s in strings)
    return f""" light_path_expressions 4 1 STRING
  "reflections C<RS>+[LOB]"
  "sss_jade C<TD'jade'>.*"
  "hair C'hair'.*"
  "smoke C'smoke'.*"
 outputs {len(strings)} 1 STRING
{lines}
"""


def main() -> None:
    meshes = [
        grid_mesh("table", "table_shader", 1, 48, table, closed=False),
        grid_mesh("knot", "knot_shader", 160, 14, knot, closed=True),
        grid_mesh("lamp_shade", "paper_shader", 144, 10, shade, closed=True),
        grid_mesh("neon_tube", "neon_shader", 10, 64, tube, closed=True),
        fur("fur", "fur_shader", (1.2, 0.27, 0.95), 0.14, 0.15, 2000),
    ]
    path = pathlib.Path(__file__).resolve().parent.parent / "scenes" / "showcase.ass"
    path.parent.mkdir(exist_ok=True)
    path.write_text(HEADER + NODES.replace("@OUTPUTS@", outputs()) + "".join(meshes))


if __name__ == "__main__":
    main()
