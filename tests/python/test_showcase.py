"""scenes/showcase.ass: what the README and the demo show must be in it."""

from __future__ import annotations

from pathlib import Path

import lightsieve
from lightsieve import lpe


def test_every_built_in_aov_and_every_label_has_light_in_it(root: Path) -> None:
    scene = root / "scenes/showcase.ass"
    asked_by_scene = lightsieve.render(scene, size=(16, 9), spp=1).layers()
    names = {row.name for row in lpe.builtins()}
    frame = lightsieve.render(
        scene, size=(128, 72), spp=9, aovs=sorted(names - set(asked_by_scene))
    )
    assert {name for name in names if not frame.layer(name).max() > 0} == set()
    for name in ("sss_jade", "hair", "smoke", "reflections", "RGBA_key", "RGBA_rim", "RGBA_lamp"):
        assert frame.layer(name).max() > 0, name
