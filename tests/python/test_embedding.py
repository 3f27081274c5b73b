"""examples/embed as a stranger would build it: with nothing but the installed engine."""

from __future__ import annotations

import os
import subprocess
import tomllib
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from tests.conftest import ROOT

BUILD = Path(os.environ.get("LIGHTSIEVE_BUILD", ROOT / "build/release"))
EXAMPLE = ROOT / "examples/embed"
AOVS = {
    "beauty": "C.*",
    "diffuse": "C<RD>.*",
    "coat": "C<RS'coat'>.*",
    "mirror": "C<RS[^'coat']>.*",
    "refraction": "CT.*",
    "lamps": "CL",
    "glow": "CO",
    "sky": "CB",
}
GROUPS = ("key", "rim", "default")


def run(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(part) for part in command], capture_output=True, text=True, check=False
    )


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the engine is installed."""
    if not (BUILD / "src/liblightsieve.a").exists():
        pytest.skip(f"the engine is not built in {BUILD}")
    where = tmp_path_factory.mktemp("prefix")
    done = run("cmake", "--install", BUILD, "--component", "engine", "--prefix", where)
    assert done.returncode == 0, done.stderr
    return where


@pytest.fixture(scope="module")
def spheres(prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example's program."""
    build = tmp_path_factory.mktemp("build")
    for command in (
        ("cmake", "-S", EXAMPLE, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}"),
        ("cmake", "--build", build),
    ):
        done = run(*command)
        assert done.returncode == 0, done.stdout + done.stderr
    return build / "spheres"


@pytest.fixture(scope="module")
def pictures(
    spheres: Path, tmp_path_factory: pytest.TempPathFactory
) -> dict[str, npt.NDArray[np.float32]]:
    out = tmp_path_factory.mktemp("pictures")
    arguments = [f"{name}={text}" for name, text in AOVS.items()]
    arguments += [f"group_{group}@{group}=C.*" for group in GROUPS]
    done = run(spheres, out, *arguments)
    assert done.returncode == 0, done.stderr
    assert len(list(out.iterdir())) == len(arguments)
    return {file.stem: read_pfm(file) for file in out.iterdir()}


def read_pfm(file: Path) -> npt.NDArray[np.float32]:
    kind, size, scale, data = file.read_bytes().split(b"\n", 3)
    assert (kind, scale) == (b"PF", b"-1")
    width, height = map(int, size.split())
    return np.frombuffer(data, "<f4").reshape(height, width, 3)


@pytest.mark.parametrize(
    "parts", [[a for a in AOVS if a != "beauty"], [f"group_{g}" for g in GROUPS]]
)
def test_parts_add_up_to_the_beauty(
    pictures: dict[str, npt.NDArray[np.float32]], parts: list[str]
) -> None:
    for part in parts:
        assert pictures[part].max() > 0, part
    total = np.sum([pictures[part] for part in parts], axis=0)
    np.testing.assert_allclose(total, pictures["beauty"], rtol=1e-5, atol=1e-6)
    assert pictures["beauty"].min() >= 0


def test_mistakes_are_told_and_nothing_is_rendered(spheres: Path, tmp_path: Path) -> None:
    done = run(spheres, tmp_path, "good=C.*", "bad=C<RD.*")
    assert done.returncode == 1
    assert "error[lpe-unclosed]" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_the_program_of_the_guide_prints_what_it_says(prefix: Path, tmp_path: Path) -> None:
    page = (ROOT / "docs/embedding.md").read_text()
    program, printed = (page.split(f"```{kind}\n")[1].split("```")[0] for kind in ("cpp", "text"))
    (tmp_path / "guide.cpp").write_text(program)
    done = run(
        *("c++", "-std=c++17", "-Wall", "-Wextra", "-Werror", f"-I{prefix}/include"),
        *(tmp_path / "guide.cpp", prefix / "lib/liblightsieve.a", "-pthread"),
        *("-o", tmp_path / "guide"),
    )
    assert done.returncode == 0, done.stderr
    assert run(tmp_path / "guide").stdout == printed


def test_what_is_installed_stands_alone(prefix: Path) -> None:
    headers = sorted(p.name for p in (prefix / "include").rglob("*") if p.is_file())
    assert headers == ["lightsieve.h", "lpe.h"]
    for file in (*prefix.rglob("*.cmake"), *prefix.rglob("*.h")):
        assert str(ROOT) not in file.read_text(), file


def test_the_engine_alone_looks_for_none_of_the_renderers_libraries(tmp_path: Path) -> None:
    done = run("cmake", "-S", ROOT, "-B", tmp_path, "-DLIGHTSIEVE_RENDERER=OFF")
    assert done.returncode == 0, done.stderr
    cache = (tmp_path / "CMakeCache.txt").read_text().lower()
    assert [
        lib for lib in ("embree", "tbb", "zlib", "openimageio", "nanobind") if lib in cache
    ] == []


def test_python_packages_leave_the_engines_files_out() -> None:
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["scikit-build"]
    assert settings["install"]["components"] == ["python"]


def test_the_example_is_short() -> None:
    assert len((EXAMPLE / "spheres.cpp").read_text().splitlines()) < 300
