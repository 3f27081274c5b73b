"""Separates the light of a rendering by the path that it took.

    >>> import lightsieve
    >>> lightsieve.lpe.match("C<RD>L", "C RD L'key'")
    True

`render` and `check` read Arnold scenes, `lpe` is the engine of light path expressions, `exr` reads
and checks the files, `denoise` takes their noise away, `nodes` lists what a scene may contain.
Everything is loaded when it is first used: importing the package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from lightsieve.errors import Diagnostic, LightsieveError, Note

if TYPE_CHECKING:
    from lightsieve import exr, lpe
    from lightsieve.denoising import denoise
    from lightsieve.frame import Frame
    from lightsieve.rendering import check, render
    from lightsieve.scene import nodes

__all__ = [
    "Diagnostic",
    "Frame",
    "LightsieveError",
    "Note",
    "__version__",
    "check",
    "denoise",
    "exr",
    "lpe",
    "nodes",
    "render",
]

# Where each public name lives; "" is a module of its own.
_LAZY = {
    "Frame": "frame",
    "check": "rendering",
    "denoise": "denoising",
    "exr": "",
    "lpe": "",
    "nodes": "scene",
    "render": "rendering",
}


def __getattr__(name: str) -> Any:
    """Loads a public name when it is first used (PEP 562)."""
    if name == "__version__":
        from lightsieve._lpe import version

        return version
    if name not in _LAZY:
        raise AttributeError(f"module 'lightsieve' has no attribute {name!r}")
    if _LAZY[name] == "":
        return import_module(f"lightsieve.{name}")
    return getattr(import_module(f"lightsieve.{_LAZY[name]}"), name)


def __dir__() -> list[str]:
    return sorted(__all__)
