"""Subsurface scattering, hair and fog: each the same scene for Lightsieve and for Cycles.

A ball of radius 1 in an even surrounding under one square lamp. Both renderers get the same numbers: colours are channels
without a space, the picture is linear. What cannot be the same: Cycles inverts subsurface colours by its own fit.
"""

from __future__ import annotations

import math
import random

SKIN = {"color": (0.8, 0.4, 0.25), "radius": (0.2, 0.1, 0.05)}
HAIR = {"melanin": 0.5, "redness": 0.4, "roughness": 0.3, "radius": 0.012, "n_strands": 4000}
FOG = {"scattering": (1.6, 1.4, 1.0), "absorption": (0.2, 0.4, 0.8), "anisotropy": 0.4}
SURROUNDING = 0.3
#: Radiance of the lamp, a square of side 2 at (3, 4, 3) that faces the middle.
LAMP, LAMP_SIDE, LAMP_AT = 12.0, 2.0, (3.0, 4.0, 3.0)
EYE, FIELD_OF_VIEW = (0.0, 0.6, 5.0), 36.0
DEPTH = 32

Point = tuple[float, float, float]


def hair_absorption() -> Point:
    """Of the hair's pigment, as standard_hair takes it (d'Eon et al. 2011, colours of MaterialX)."""
    brown, red = (0.419, 0.697, 1.37), (0.187, 0.4, 1.05)
    amount, share = -math.log(1 - HAIR["melanin"]), HAIR["redness"]
    r, g, b = (amount * ((1 - share) * x + share * y) for x, y in zip(brown, red, strict=True))
    return (r, g, b)


def strands() -> list[list[Point]]:
    """Strands that stand on a ball of radius 0.8, bent a little: four points each."""
    numbers = random.Random(7)
    out = []
    for _ in range(HAIR["n_strands"]):
        z = numbers.uniform(-1, 1)
        phi = numbers.uniform(0, 2 * math.pi)
        ring = math.sqrt(1 - z * z)
        normal = (ring * math.cos(phi), z, ring * math.sin(phi))
        lean = [numbers.uniform(-0.25, 0.25) for _ in range(3)]
        points: list[Point] = []
        for i in range(4):
            t = i / 3
            x, y, w = (n * (0.8 + 0.3 * t) + d * t * t for n, d in zip(normal, lean, strict=True))
            points.append((x, y - 0.15 * t * t, w))
        out.append(points)
    return out


def _triple(values: Point) -> str:
    return " ".join(f"{v:g}" for v in values)


def _material(which: str) -> str:
    if which == "subsurface":
        return (
            "standard_surface\n{\n name made\n specular 0\n subsurface 1\n"
            f" subsurface_color {_triple(SKIN['color'])}\n subsurface_radius {_triple(SKIN['radius'])}\n}}\n"
            "sphere\n{\n name ball\n radius 1\n shader made\n}\n"
        )
    if which == "fog":
        return (
            "anisotropic_vdf\n{\n name made\n"
            f" scattering {_triple(FOG['scattering'])}\n absorption {_triple(FOG['absorption'])}\n"
            f" anisotropy {FOG['anisotropy']}\n}}\n"
            "sphere\n{\n name ball\n radius 1\n step_size 0.1\n shader made\n}\n"
        )
    all_strands = strands()
    points = "\n".join(_triple(p) for strand in all_strands for p in strand)
    return (
        "standard_hair\n{\n name made\n"
        f" melanin {HAIR['melanin']}\n melanin_redness {HAIR['redness']}\n roughness {HAIR['roughness']}\n"
        " shift 2\n}\n"
        "standard_surface\n{\n name core\n base_color 0.02 0.02 0.02\n specular 0\n}\n"
        "sphere\n{\n name skull\n radius 0.79\n shader core\n}\n"
        f'curves\n{{\n name fur\n basis "linear"\n mode "thick"\n num_points 4\n radius {HAIR["radius"]}\n'
        f" points {4 * len(all_strands)} 1 VECTOR\n{points}\n shader made\n}}\n"
    )


def _lamp() -> str:
    """The lamp as a matrix: the quad shines along -z, row vectors."""
    z = [c / math.dist(LAMP_AT, (0, 0, 0)) for c in LAMP_AT]
    x = [z[2], 0.0, -z[0]]
    length = math.hypot(*x)
    x = [c / length for c in x]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    rows = [(*x, 0), (*y, 0), (*z, 0), (*LAMP_AT, 1)]
    matrix = " ".join(f"{v:g}" for row in rows for v in row)
    h = LAMP_SIDE / 2
    return (
        f"quad_light\n{{\n name lamp\n matrix {matrix}\n"
        f" vertices 4 1 VECTOR {-h} {h} 0 {h} {h} 0 {h} {-h} 0 {-h} {-h} 0\n"
        f" normalize off\n intensity {LAMP}\n}}\n"
    )


def ass(which: str, resolution: int) -> str:
    """The scene for Lightsieve: `subsurface`, `hair` or `fog`."""
    return (
        f"options\n{{\n xres {resolution}\n yres {resolution}\n GI_diffuse_depth {DEPTH}\n GI_specular_depth {DEPTH}\n"
        f" GI_transmission_depth {DEPTH}\n GI_volume_depth {DEPTH}\n GI_total_depth {DEPTH}\n"
        ' indirect_sample_clamp 1e30\n camera cam\n outputs "RGBA RGBA f d"\n}\n'
        'box_filter\n{\n name f\n}\ndriver_exr\n{\n name d\n filename "three_materials.exr"\n}\n'
        f"persp_camera\n{{\n name cam\n fov {FIELD_OF_VIEW}\n position {_triple(EYE)}\n look_at 0 0 0\n}}\n"
        f"skydome_light\n{{\n name sky\n intensity {SURROUNDING}\n}}\n"
        + _lamp()
        + _material(which)
    )
