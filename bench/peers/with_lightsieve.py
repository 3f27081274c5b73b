"""The scenes in Lightsieve."""

from __future__ import annotations

import tempfile
from pathlib import Path

import measure
import numpy as np
from renderer import Rendered, Setting
from scenes.description import Scene

from scenes import as_ass


class Lightsieve:
    """With layers: all built-in AOVs, and each of them in every light group."""

    guiding = False

    def __init__(self, scene: Scene, setting: Setting) -> None:
        from lightsieve import lpe

        self._folder = tempfile.TemporaryDirectory()
        self._path = Path(self._folder.name) / "scene.ass"
        as_ass.write(self._path, scene, setting.resolution)
        self._setting = setting
        self._aovs = measure.all_builtins() if setting.layers else []
        self.layer_count = 0
        if setting.layers:
            n_light = sum("albedo" not in b.name for b in lpe.builtins())
            self.layer_count = len(lpe.builtins()) - 1 + n_light * len(scene.groups)

    def render(self, spp: int, seed: int) -> Rendered:
        # Samples and seed belong to the compiled scene. `seconds` has sampling only.
        compiled = measure.compile_scene(
            str(self._path),
            self._aovs,
            threads=self._setting.threads,
            spp=spp,
            roulette=-1,
            seed=seed,
            guiding=self.guiding,
        )
        outcome = compiled.render()  # type: ignore[attr-defined]
        return Rendered(np.array(measure.beauty(outcome)), outcome.seconds, spp)


class GuidedLightsieve(Lightsieve):
    """The same with --guiding; its training is part of the time."""

    guiding = True
