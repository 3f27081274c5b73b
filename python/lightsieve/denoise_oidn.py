"""Intel Open Image Denoise, through the package `pyoidn`: the only place that knows it.

Afra: "Intel Open Image Denoise", https://www.openimagedenoise.org. A network that was trained on
path-traced pictures; what it takes and how is in its documentation ("RT filter").
"""

from __future__ import annotations

from types import ModuleType
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from lightsieve.errors import LightsieveError, without_place

Picture = npt.NDArray[np.float32]
Quality = Literal["high", "balanced", "fast"]

# Width and height that the network needs to tell light from its border [pixels].
LEAST_SIZE = 64
INSTALL = 'pip install "lightsieve[denoise]", or pip install pyoidn'


def _missing(message: str) -> LightsieveError:
    return LightsieveError([without_place("denoiser-missing", message, INSTALL)])


def require() -> ModuleType:
    """The package, if it is installed and runs here.

    Returns:
        `pyoidn`.

    Raises:
        LightsieveError: It is not (code `denoiser-missing`; the hint says how to install it).

    Example:
        >>> require().__name__
        'pyoidn'
    """
    try:
        import pyoidn
    except ImportError as error:
        raise _missing(f"Open Image Denoise cannot be loaded: {error}") from None
    try:
        runs = pyoidn.Device.is_cpu_available()
    except OSError as error:
        raise _missing(f"Open Image Denoise cannot be loaded: {error}") from None
    if not runs:
        raise _missing("Open Image Denoise does not run on this processor")
    module: ModuleType = pyoidn
    return module


class _Filter:
    """The library's filter, with the pictures that it reads and writes: they must stay alive."""

    def __init__(
        self,
        oidn: ModuleType,
        device: Any,
        name: str,
        quality: int,
        helpers: dict[str, Picture],
        *,
        hdr: bool,
    ) -> None:
        self._oidn, self._name = oidn, name
        self._pictures = {key: _large_enough(picture) for key, picture in helpers.items()}
        self._filter: Any = oidn.Filter(device, oidn.OIDN_FILTER_TYPE_RT)
        self._filter.set_quality(quality)
        self._filter.set_bool("hdr", hdr)
        self._filter.set_bool("cleanAux", len(helpers) > 0)

    def run(self, picture: Picture) -> Picture:
        self._pictures[self._name] = _large_enough(picture)
        self._pictures["output"] = np.empty_like(self._pictures[self._name])
        for key, image in self._pictures.items():
            self._filter.set_image(key, image, self._oidn.OIDN_FORMAT_FLOAT3)
        self._filter.commit()
        self._filter.execute()
        height, width = picture.shape[:2]
        out: Picture = self._pictures["output"][:height, :width]
        return out

    def close(self) -> None:
        self._filter.release()


def _large_enough(picture: Picture) -> Picture:
    """Pictures of a few pixels come out too dark: they are mirrored until there are enough."""
    height, width = picture.shape[:2]
    pad = [(0, max(0, LEAST_SIZE - height)), (0, max(0, LEAST_SIZE - width)), (0, 0)]
    return np.ascontiguousarray(np.pad(picture, pad, mode="symmetric"), dtype=np.float32)


class Denoiser:
    """One device, and the pictures that help it to tell noise from detail.

    Args:
        albedo: Of the first surface, shape (height, width, 3), 0 to 1; noisy or not.
        normal: Of the first surface, shape (height, width, 3), -1 to 1; noisy or not.
        quality: `high` for final pictures.
        threads: 0: as many as the machine has.

    Raises:
        LightsieveError: It is not installed (code `denoiser-missing`), or fails.
    """

    def __init__(
        self,
        albedo: Picture | None = None,
        normal: Picture | None = None,
        *,
        quality: Quality = "high",
        threads: int = 0,
    ) -> None:
        self._oidn = require()
        self._quality = {
            "high": self._oidn.OIDN_QUALITY_HIGH,
            "balanced": self._oidn.OIDN_QUALITY_BALANCED,
            "fast": self._oidn.OIDN_QUALITY_FAST,
        }[quality]
        self._device: Any = self._oidn.Device()
        if threads > 0:
            self._device.set_int("numThreads", threads)
        # Threads that are tied to processors wait for whatever else runs there.
        self._device.set_bool("setAffinity", False)
        self._device.commit()
        self._check()
        # Helpers are denoised by themselves first: their noise must not show in the result.
        helpers: dict[str, Picture] = {}
        if albedo is not None:
            helpers["albedo"] = self._made("albedo", np.clip(albedo, 0, 1))
        if normal is not None:
            helpers["normal"] = self._made("normal", normal)
        # One for all layers: making it takes longer than running it on a small picture.
        self._filter = _Filter(self._oidn, self._device, "color", self._quality, helpers, hdr=True)

    def close(self) -> None:
        """Gives back what the device holds; nothing can be denoised after it."""
        self._filter.close()
        self._device.release()

    def version(self) -> str:
        """Of the library: `2.5.1`."""
        number = self._device.get_int("version")
        return f"{number // 10000}.{number // 100 % 100}.{number % 100}"

    def denoise(self, light: Picture) -> Picture:
        """A layer of light without its noise.

        Args:
            light: Shape (height, width, 3), linear, finite; below 0 counts as 0.

        Returns:
            The same shape, not negative.

        Raises:
            LightsieveError: The library fails, e.g. for lack of memory.
        """
        out = np.maximum(self._filter.run(light), 0)
        self._check()
        return out

    def _made(self, name: str, picture: Picture) -> Picture:
        """A helper without its noise."""
        step = _Filter(self._oidn, self._device, name, self._quality, {}, hdr=False)
        out = step.run(picture)
        step.close()
        self._check()
        return out

    def _check(self) -> None:
        message = self._device.get_error()
        if message is not None:
            raise LightsieveError(
                [
                    without_place(
                        "denoiser-missing",
                        f"Open Image Denoise failed: {message}",
                        "a smaller picture, or a machine with more memory",
                    )
                ]
            )
