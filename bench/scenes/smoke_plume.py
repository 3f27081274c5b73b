"""The plume of scenes/smoke.vdb, lit by a spot and a dome, with light that scatters up to eight times."""

from __future__ import annotations

from pathlib import Path

from scenes.ass_text import node, options

DEPTH = 8
GRID = Path(__file__).resolve().parents[2] / "scenes/smoke.vdb"


def write(path: Path, resolution: int = 512) -> None:
    """Writes the scene as .ass."""
    text = "# Smoke. Written by bench/scenes/smoke_plume.py.\n" + options(
        resolution, resolution, 4, DEPTH
    )
    text += node(
        "persp_camera",
        name="camera",
        position=(0, 1, 4.2),
        look_at=(0, 1, 0),
        up=(0, 1, 0),
        fov=36,
    )
    text += node(
        "skydome_light",
        name="dome",
        color=(0.5, 0.6, 0.8),
        camera=0,
        intensity=0.3,
        volume_samples=1,
    )
    text += node(
        "point_light",
        name="lamp",
        position=(2, 3, 1.5),
        radius=0.3,
        intensity=80,
        volume_samples=1,
    )
    text += node(
        "standard_volume",
        name="smoke",
        density=12,
        scatter_color=(0.9, 0.9, 0.9),
        scatter_anisotropy=0.3,
        emission_mode="none",
    )
    text += node("volume", name="plume", filename=str(GRID), grids="density", shader="smoke")
    path.write_text(text)
