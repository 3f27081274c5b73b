"""Pictures in memory: the layers of a render or of a file, as numpy arrays."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from lightsieve.errors import Diagnostic, LightsieveError, without_place

Pixels = npt.NDArray[np.float32] | npt.NDArray[np.uint32]


class Layer(NamedTuple):
    """What one layer of a frame is."""

    name: str
    """Its name, e.g. `diffuse_key`."""
    aov: str
    """The AOV, before renaming; empty if a file's header does not say."""
    type: str
    """`RGBA`, `RGB`, `FLOAT`, `VECTOR`, ... of a render; `half`, `float` or `uint` of a file."""
    expression: str
    """Its light path expression; empty if it has none."""
    light_group: str
    """The light group that it is restricted to; empty if it is not."""
    filter: str
    """The pixel filter's node type; empty if a file's header does not say."""
    filter_width: float
    """The pixel filter's width [pixels]."""


class Frame:
    """The layers of one picture, of equal size.

    `lightsieve.render` and `lightsieve.exr.read` return it.
    """

    width: int
    """Of every layer [pixels]."""
    height: int
    """Of every layer [pixels]."""
    files: tuple[str, ...]
    """The files that were written or read."""
    diagnostics: tuple[Diagnostic, ...]
    """Warnings and lints of the render."""
    samples: int
    """Camera samples taken; 0 for a file."""
    seconds: float
    """Sampling time; 0 for a file."""

    def __init__(
        self,
        layers: Sequence[tuple[Layer, Pixels]],
        *,
        files: Sequence[str] = (),
        diagnostics: Sequence[Diagnostic] = (),
        samples: int = 0,
        seconds: float = 0.0,
    ) -> None:
        self._infos: dict[str, Layer] = {}
        self._pixels: dict[str, Pixels] = {}
        for info, pixels in layers:
            # Several drivers may have a layer of one name; the first stands for it.
            self._infos.setdefault(info.name, info)
            self._pixels.setdefault(info.name, pixels)
        first = next(iter(self._pixels.values()), None)
        self.height, self.width = (0, 0) if first is None else first.shape[:2]
        self.files = tuple(files)
        self.diagnostics = tuple(diagnostics)
        self.samples = samples
        self.seconds = seconds

    def layers(self) -> list[str]:
        """The names of the layers, in the order of the outputs.

        Returns:
            The names.

        Example:
            >>> frame.layers()
            ['RGBA', 'diffuse', 'diffuse_direct', 'diffuse_indirect', 'mirrored']
        """
        return list(self._infos)

    def layer(self, name: str) -> Pixels:
        """One layer of the frame as linear colour.

        Args:
            name: Layer name as listed by `layers()`, e.g. `"diffuse_direct"`; `"beauty"` is the
                layer of all light.

        Returns:
            float32 (uint32 for UINT layers), shape (height, width, channels), row 0 at the top;
            radiance [W/(m^2 sr)] for light AOVs. A view: writing to it changes the frame.

        Raises:
            LightsieveError: No such layer (code `unknown-layer`; the hint names the nearest).

        Example:
            >>> frame.layer("beauty").shape
            (48, 64, 4)
        """
        return self._pixels[self._known(name)]

    def info(self, name: str) -> Layer:
        """What a layer is.

        Args:
            name: Layer name as for `layer`.

        Returns:
            Its AOV, type, expression, light group and filter.

        Raises:
            LightsieveError: No such layer.

        Example:
            >>> frame.info("diffuse").expression
            'C<RD>.*'
        """
        return self._infos[self._known(name)]

    def __repr__(self) -> str:
        return f"<Frame {self.width}x{self.height}: {', '.join(self._infos)}>"

    def _known(self, name: str) -> str:
        if name in self._infos:
            return name
        if name == "beauty":
            for other, info in self._infos.items():
                if other in ("RGBA", "RGB") or info.aov in ("RGBA", "RGB"):
                    return other
        message = f'the frame has no layer "{name}"'
        near = get_close_matches(name, self._infos, n=1)
        hint = f'did you mean "{near[0]}"?' if near else f"it has: {', '.join(self._infos)}"
        raise LightsieveError([without_place("unknown-layer", message, hint)])
