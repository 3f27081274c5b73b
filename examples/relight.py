"""Changes the lights of a picture after it was rendered.

    python examples/relight.py scenes/showcase.ass relit.png

Light adds up, so the picture is the sum of its light groups: each is rendered once, then weighted
at will. The weights here make the first group dim and blue and leave the others as they are.
"""

import sys

import numpy as np
from PIL import Image

import lightsieve
from lightsieve.extras.colour import srgb_from_acescg


def main(scene: str, target: str) -> None:
    """Renders the scene's light groups and mixes them anew."""
    frame = lightsieve.render(scene, aovs=["RGBA_*"], spp=16)
    groups = [name for name in frame.layers() if frame.info(name).light_group]
    print("light groups:", ", ".join(groups))

    weights = {name: np.ones(3, np.float32) for name in groups}
    weights[groups[0]] = np.array([0.1, 0.2, 0.6], np.float32)
    relit = np.zeros((frame.height, frame.width, 3), np.float32)
    for name, weight in weights.items():
        relit += weight * frame.layer(name)[:, :, :3]

    Image.fromarray((srgb_from_acescg(relit) * 255).astype(np.uint8), "RGB").save(target)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
