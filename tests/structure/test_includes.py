"""Who may include whom, read off the #include lines."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

# A layer and the layers of ours that it may include, itself apart.
LAYERS = {
    "core": set(),
    "lpe": {"core"},
    "embed": {"core", "lpe", "lightsieve"},  # the last is include/lightsieve
    "bsdf": {"core"},
    "io": {"core"},
    "scene": {"core"},
    "nodes": {"core", "bsdf", "io", "scene"},
    "render": {"core", "lpe", "bsdf", "io", "scene"},
    "python": {"core", "lpe", "embed", "bsdf", "io", "scene", "nodes", "render"},
    "vdb_reader": {"io"},
    "image_reader": {"io"},
    "tool": {"core", "lpe", "bsdf", "io", "scene", "nodes", "render"},
}

# A library of others: what its headers look like, and the files that may include it. One place
# each, so that a library can be replaced by rewriting that place.
LIBRARIES = {
    "TBB": (r"tbb/|oneapi/", r"core/parallel\.cpp|vdb_reader/main\.cpp"),
    "OpenEXR": (r"Imf|Iex|Imath|half\.h|OpenEXR/", r"io/exr\w*\.(cpp|h)"),
    "OpenImageIO": (r"OpenImageIO/", r"io/(texture|image)\w*\.(cpp|h)"),
    "OpenColorIO": (r"OpenColorIO/", r"io/color_config\.cpp"),
    "OpenVDB": (r"openvdb/|nanovdb/util/", r"vdb_reader/.*"),
    "NanoVDB": (r"nanovdb/NanoVDB\.h", r"io/volume_tree\.(cpp|h)"),
    "OpenSubdiv": (r"opensubdiv/", r"nodes/common/subdivision\.cpp"),
    "Embree": (r"embree", r"render/accel\w*\.(cpp|h)"),
    "zlib": (r"zlib\.h", r"scene/(ass_\w+|\w+_test)\.cpp"),
    "fmt": (r"fmt/", r"(io|scene|nodes|render)/.*"),
    "nanobind": (r"nanobind/", r"python/.*"),
    "GoogleTest": (
        r"gtest/|gmock/",
        r".*_test\.cpp|.*/test_\w+\.h|.*_test_support\.h|.*/testing/.*",
    ),
}

# Headers of the system and of the compiler that any file may use.
SYSTEM = re.compile(
    r"[a-z_]+|sys/\w+\.h|"
    r"(unistd|fcntl|xmmintrin|immintrin|dlfcn|malloc|poll|pthread|signal|spawn|netdb)\.h|"
    r"(arpa/inet|netinet/in)\.h"
)


def sources(root: Path) -> list[Path]:
    return sorted(p for p in (root / "src").rglob("*") if p.suffix in {".h", ".cpp"})


def includes(path: Path) -> Iterator[tuple[int, str, bool]]:
    """Line number, header, whether it stands in quotes."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*(["<])([^">]+)', line)
        if found:
            yield number, found[2], found[1] == '"'


def complaints_of(file: str, header: str, quoted: bool) -> str | None:
    """What is wrong with `#include header` in src/file, if anything."""
    layer = file.split("/")[0]
    is_test = file.endswith("_test.cpp") or "/testing/" in file
    if quoted:
        target = header.split("/")[0]
        if "/" not in header:
            return f'name it from src/: "{layer}/{header}"'
        if target == layer or target in LAYERS[layer]:
            return None
        if layer == "render" and target == "nodes" and is_test:
            return None  # tests render real scenes, so they need the real registry
        return f"{layer} may not include {target}"
    for library, (pattern, allowed) in LIBRARIES.items():
        if re.match(pattern, header):
            if re.fullmatch(allowed, file):
                return None
            return f"{library} is not for this file"
    return (
        None if SYSTEM.fullmatch(header) else "unknown library: add it to LIBRARIES with its place"
    )


def test_every_layer_includes_only_what_it_may(root: Path) -> None:
    complaints = [
        f"{path.relative_to(root)}:{number}: {header}: {complaint}"
        for path in sources(root)
        for number, header, quoted in includes(path)
        if (complaint := complaints_of(path.relative_to(root / "src").as_posix(), header, quoted))
    ]
    assert not complaints, "\n" + "\n".join(complaints)


def test_every_folder_is_a_known_layer(root: Path) -> None:
    folders = {p.name for p in (root / "src").iterdir() if p.is_dir()}
    assert folders == set(LAYERS)


@pytest.mark.parametrize(
    ("file", "header", "quoted"),
    [
        ("core/name.cpp", "scene/value.h", True),
        ("lpe/parse.cpp", "fmt/format.h", False),
        ("lpe/parse.cpp", "scene/value.h", True),
        ("scene/graph.cpp", "lpe/parse.h", True),
        ("render/film.cpp", "nodes/all_nodes.h", True),
        ("render/film.cpp", "tbb/task_arena.h", False),
        ("render/film.cpp", "embree3/rtcore.h", False),
        ("io/volume_grid.cpp", "openvdb/openvdb.h", False),
        ("io/volume_grid.cpp", "nanovdb/NanoVDB.h", False),
        ("vdb_reader/vdb_file.cpp", "core/error.h", True),
        ("nodes/driver/driver_exr.cpp", "ImfHeader.h", False),
        ("core/name.cpp", "boost/any.hpp", False),
        ("core/name.cpp", "name.h", True),
    ],
)
def test_the_rule_catches_what_it_forbids(file: str, header: str, quoted: bool) -> None:
    assert complaints_of(file, header, quoted) is not None
