"""Damaged scenes, and scenes that read damaged pictures and volumes."""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import OpenImageIO

from tests.conftest import ROOT
from tests.hostile import absurdities
from tests.hostile.mutation import mutate_bytes, mutate_text
from tests.probes.probing import SCENES, TABLES, values, written

N_SCENES = 600
N_PICTURES = 260
N_VOLUMES = 60

PICTURES: dict[str, tuple[str, int, dict[str, str | int]]] = {
    "half.exr": ("half", 4, {"compression": "zip"}),
    "float.exr": ("float", 3, {"compression": "dwaa", "tile": 16}),
    "piz.exr": ("half", 3, {"compression": "piz"}),
    "b44.exr": ("half", 3, {"compression": "b44a"}),
    "rle.exr": ("half", 1, {"compression": "rle", "tile": 16}),
    "lzw.tif": ("uint8", 4, {"compression": "lzw"}),
    "planes.tif": ("uint8", 3, {"compression": "zip", "planarconfig": "separate"}),
    "tiles.tif": ("uint16", 3, {"compression": "zip", "tile": 16}),
    "float.tif": ("float", 3, {"compression": "none", "tile": 16}),
    "jpeg.tif": ("uint8", 3, {"compression": "jpeg", "tile": 16}),
    "bytes.png": ("uint8", 4, {}),
    "words.png": ("uint16", 3, {}),
    "grey.png": ("uint8", 1, {}),
    "picture.jpg": ("uint8", 3, {}),
    "grey.jpg": ("uint8", 1, {}),
    "light.hdr": ("float", 3, {}),
    "picture.bmp": ("uint8", 3, {}),
    "picture.tga": ("uint8", 4, {}),
}
"""Pictures of every format that is read: how values are stored, channels, attributes."""


def originals() -> list[str]:
    """Scenes to damage: ours, and the surroundings of the probes with every node in its place."""
    folders = (ROOT / "tests/scenes", ROOT / "tests/broken", ROOT / "tests/data/ass")
    texts = [
        path.read_text("latin-1") for folder in folders for path in sorted(folder.glob("*.ass"))
    ]
    for name, table in sorted(TABLES.items()):
        rows = [row for rows in table.get("probe", {}).values() for row in np.atleast_1d(rows)]
        given = values(table.get("with", ""))
        for param, row in zip(table.get("probe", {}), rows, strict=False):
            given.setdefault(param, row["to"])
        around = SCENES.get(table.get("scene", ""), SCENES["swatch"])
        node = "" if name == "options" else f"{name}\n{{\n name probe\n{written(given)}\n}}\n"
        more = written(given) if name == "options" else ""
        texts.append(
            f"options\n{{\n{written(values(around.options))}\n{more}\n}}\n{around.nodes}\n"
            f"{table.get('nodes', '')}\n{node}"
        )
    return texts


def scenes(n: int = N_SCENES, seed: int = 1) -> Iterator[tuple[str, str]]:
    """Damaged scenes, always the same ones."""
    texts = originals()
    for number in range(n):
        rng = random.Random(f"{seed} {number}")
        yield f"scene-{number}", mutate_text(texts[number % len(texts)], rng)


def write_pictures(folder: Path) -> list[Path]:
    """Good pictures of every format."""
    noise = np.random.default_rng(3).random((48, 56, 4)).astype(np.float32)
    noise[10:30, 10:30] = 0.5
    paths = []
    for name, (stored, channels, attributes) in PICTURES.items():
        spec = OpenImageIO.ImageSpec(56, 48, channels, stored)
        for key, value in attributes.items():
            if key == "tile":
                spec.tile_width = spec.tile_height = int(value)
                spec.tile_depth = 1
            else:
                spec.attribute(key, value)
        output = OpenImageIO.ImageOutput.create(name)
        assert output is not None, name
        assert output.open(str(folder / name), spec), output.geterror()
        assert output.write_image(np.ascontiguousarray(noise[:, :, :channels])), name
        output.close()
        paths.append(folder / name)
    return paths


def files(
    folder: Path, n_pictures: int = N_PICTURES, n_volumes: int = N_VOLUMES, seed: int = 1
) -> Iterator[tuple[str, str]]:
    """Scenes that show damaged pictures and volumes, which are written to `folder`."""
    pictures = zip(range(n_pictures), itertools.cycle(write_pictures(folder)), strict=False)
    for number, original in pictures:
        path = folder / f"{number}-{original.name}"
        rng = random.Random(f"{seed} {path.name}")
        path.write_bytes(mutate_bytes(original.read_bytes(), rng))
        yield (
            path.name,
            absurdities.scene(
                f'image {{ name t filename "{path}" }}\nflat {{ name look color t }}\n'
                "plane { name wall normal 0 0 1 shader look }\n"
                f"skydome_light {{ name sky color t }}\n"
            ),
        )
    volumes = itertools.cycle(sorted((ROOT / "tests/data/volumes").glob("*.vdb")))
    for number, original in zip(range(n_volumes), volumes, strict=False):
        path = folder / f"{number}-{original.name}"
        rng = random.Random(f"{seed} {path.name}")
        path.write_bytes(mutate_bytes(original.read_bytes(), rng, head=4000))
        yield (
            path.name,
            absurdities.scene(
                f'volume {{ name v filename "{path}" grids density shader look }}\n'
                "standard_volume { name look }\n"
            ),
        )
