"""Every example of a docstring runs and gives what it says."""

from __future__ import annotations

import doctest
import pkgutil
import shutil
from importlib import import_module
from pathlib import Path

import pytest

import lightsieve
from tests.conftest import ROOT

MODULES = sorted(
    found.name
    for found in pkgutil.walk_packages(lightsieve.__path__, "lightsieve.")
    if not found.name.rpartition(".")[2].startswith("_")
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the examples name: scene.ass and out/frame.exr."""
    where = tmp_path_factory.mktemp("examples")
    shutil.copy(ROOT / "tests/scenes/still.ass", where / "scene.ass")
    (where / "out").mkdir()
    lightsieve.render(
        where / "scene.ass",
        spp=1,
        aovs=["diffuse", "diffuse_direct", "diffuse_indirect"],
        lpes={"mirrored": "CS[LOB]"},
        output=where / "out/frame.exr",
    )
    return where


@pytest.mark.parametrize("name", ["lightsieve", *MODULES])
def test_examples(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    module = import_module(name)
    frame = lightsieve.exr.read("out/frame.exr")
    names = {**vars(module), "lightsieve": lightsieve, "frame": frame}
    failed, _ = doctest.testmod(module, globs=names, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert failed == 0


def test_every_public_function_has_an_example() -> None:
    missing = []
    for name in ("check", "render", "nodes"):
        if ">>>" not in (getattr(lightsieve, name).__doc__ or ""):
            missing.append(name)
    for module in (lightsieve.lpe, lightsieve.exr):
        for name, value in vars(module).items():
            is_ours = callable(value) and getattr(value, "__module__", "") == module.__name__
            is_public = is_ours and not isinstance(value, type) and not name.startswith("_")
            if is_public and ">>>" not in (value.__doc__ or ""):
                missing.append(f"{module.__name__}.{name}")
    assert missing == []
