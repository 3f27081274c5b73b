"""Probes: for every parameter of every node a scene in which it acts, and what it must do there.

The tables (`tables/*.toml`) are data; README.md beside this file says how they are written. This
module reads them, writes the scenes and renders them; predictions.py judges the pictures.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import OpenImageIO

import lightsieve
from lightsieve.scene import Node, Param, nodes

FOLDER = Path(__file__).resolve().parent / "tables"
DATA = Path(__file__).resolve().parent.parent / "data"

Pixels = npt.NDArray[np.float64]
Values = dict[str, str]
"""Parameters as a scene file writes them, by name."""


def values(text: str) -> Values:
    """`"coat 1; base_color 1 0 0"` as a dictionary; a declaration is a name without value."""
    parts = [part.strip() for part in text.split(";") if part.strip()]
    return {
        part if part.startswith("declare ") else part.split()[0]: part.partition(" ")[2].strip()
        for part in parts
    }


def written(given: Values) -> str:
    """Parameters as lines of a node."""
    return "\n".join(
        f" {name}" if name.startswith("declare ") else f" {name} {value}"
        for name, value in given.items()
    )


@dataclass(frozen=True)
class Surroundings:
    """The scene around the node that is probed."""

    options: str
    """Parameters of the options node."""
    nodes: str
    """Nodes as a scene file writes them; the probed one is called `probe`."""


@dataclass(frozen=True)
class Probe:
    """One parameter, two values, and what the step from one to the other must do."""

    node: str
    param: str
    scene: str
    before: str | None
    """The first value; None: it is not written."""
    after: str
    expect: tuple[str, ...]
    """Predictions, all of which must come true: a word of `PREDICTIONS` and its arguments."""
    given: Values
    """Other parameters of the node."""
    options: Values
    """Parameters of the options node beside those of the surroundings."""
    nodes: str
    """Nodes beside those of the surroundings."""
    sets: tuple[str, ...]
    """`node.param=value`: changes of the surroundings."""
    layer: str
    """The output that is looked at."""
    where: tuple[float, float, float, float]
    """Part of the picture: x0, y0, x1, y1 in 0..1 from the upper left corner."""
    warns: tuple[str, ...]
    """Codes of diagnostics that either value may bring."""


class BrokenPredictionError(Exception):
    """A prediction did not come true, or the scene did not render as the table says."""


def read_tables() -> tuple[dict[str, Surroundings], dict[str, dict[str, Any]], dict[str, Any]]:
    """The surroundings by name, the tables of nodes, the tables of kinds."""
    surroundings: dict[str, Surroundings] = {}
    of_nodes: dict[str, dict[str, Any]] = {}
    of_kinds: dict[str, Any] = {}
    for path in sorted(FOLDER.glob("*.toml")):
        table = tomllib.loads(path.read_text())
        if path.stem == "scenes":
            surroundings = {name: Surroundings(**row) for name, row in table.items()}
        elif path.stem == "kinds":
            of_kinds = table
        elif path.stem == "unused":
            continue
        else:
            for name, row in table.items():
                assert name not in of_nodes, f"{path.name}: {name} has two tables"
                of_nodes[name] = row
    return surroundings, of_nodes, of_kinds


SCENES, TABLES, KINDS = read_tables()


def _texts(value: str | list[str] | None) -> tuple[str, ...]:
    return () if value is None else (value,) if isinstance(value, str) else tuple(value)


def _numbered(param: str, row: Any, number: int | None) -> tuple[str, Any]:
    """A row for `input#` as one for `input3`."""
    if number is None:
        return param, row
    numbered = {
        key: value.replace("#", str(number)) if isinstance(value, str) else value
        for key, value in row.items()
    }
    return param.replace("#", str(number)), numbered


def _rows(node: Node) -> Iterator[tuple[Mapping[str, Any], str, Mapping[str, Any]]]:
    """The rows of a node's own table, then those of its kind for parameters that are left.

    A row of a kind has its kind's `with`, not the node's.
    """
    own = TABLES.get(node.name, {})
    for param, rows in own.get("probe", {}).items():
        for row in rows if isinstance(rows, list) else [rows]:
            for number in row.get("numbers", [None]):
                yield own, *_numbered(param, row, number)
    kind = KINDS.get(node.kind, {})
    known = {param.name for param in node.params if param.status == "supported"}
    for param, rows in kind.get("probe", {}).items():
        if param not in known or param in own.get("probe", {}):
            continue
        for row in rows if isinstance(rows, list) else [rows]:
            yield {**own, **{key: own[key] for key in ("scene", "with") if key in own}}, param, row


def probes(node: Node) -> list[Probe]:
    """The probes of a node."""
    kind = KINDS.get(node.kind, {})
    made = []
    for table, param, row in _rows(node):
        given = values(table.get("with", ""))
        given.update(values(row.get("with", "")))
        for name in _texts(row.get("without")):
            given.pop(name, None)
        before = given.pop(param, None)
        made.append(
            Probe(
                node.name,
                param,
                row.get("scene", table.get("scene", kind.get("scene", ""))),
                row.get("from", before),
                row["to"],
                _texts(row["expect"]),
                given,
                {**values(table.get("options", "")), **values(row.get("options", ""))},
                table.get("nodes", "") + row.get("nodes", ""),
                _texts(row.get("set")),
                row.get("layer", table.get("layer", "RGBA")),
                tuple(row.get("where", (0, 0, 1, 1))),
                _texts(row.get("warns", table.get("warns"))),
            )
        )
    return made


def probed_params(node: Node) -> set[str]:
    """The parameters of a node that have a probe."""
    return {probe.param for probe in probes(node)}


def scene_text(probe: Probe, value: str | None) -> str:
    """The scene with the probed parameter at a value."""
    around = SCENES[probe.scene]
    given = {**probe.given, **({} if value is None else {probe.param: value})}
    options = {**values(around.options), **probe.options}
    if probe.node == "options":
        options.update(given)
        node = ""
    else:
        node = f"{probe.node}\n{{\n name probe\n{written(given)}\n}}\n"
    return f"options\n{{\n{written(options)}\n}}\n{around.nodes}\n{probe.nodes}\n{node}"


LUMINAIRE = """IESNA:LM-63-1995
TILT=NONE
1 -1 1 5 1 1 2 0 0 0
1 1 0
0 22 45 67 90
0
{}
"""


OPERATORS = """disable { name first selection "second" }
set_parameter { name last selection "ball" assignment "matte=on" inputs first }
"""
# Light is computed in `lin`; values of `twice` are half of those.
COLORS = """ocio_profile_version: 1
roles:
  default: lin
  scene_linear: lin
displays:
  screen:
    - !<View> {name: plain, colorspace: lin}
colorspaces:
  - !<ColorSpace>
    name: lin
  - !<ColorSpace>
    name: twice
    to_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
"""


def _write_files(folder: Path) -> None:
    """Files to read. The chart's red grows to the right, its green upward, its blue is even."""
    (folder / "wide.ies").write_text(LUMINAIRE.format("100 90 60 30 0"))
    (folder / "narrow.ies").write_text(LUMINAIRE.format("100 20 0 0 0"))
    (folder / "body.ass").write_text("sphere { name body radius 1 shader grey }\n")
    (folder / "small.ass").write_text("sphere { name body radius 0.5 shader grey }\n")
    (folder / "matte.ass").write_text("sphere { name body radius 1 shader grey matte on }\n")
    (folder / "operators.ass").write_text(OPERATORS)
    (folder / "config.ocio").write_text(COLORS)
    y, x = np.mgrid[0:16, 0:16]
    chart = np.stack([x / 15, 1 - y / 15, 0 * x + 0.2], axis=2).astype(np.float32)
    cells = np.repeat(((x // 4 + y // 4) % 2)[:, :, None], 3, axis=2).astype(np.float32)
    pictures: dict[str, npt.NDArray[Any]] = {
        "chart.tif": chart,
        "chart.0001.tif": chart,
        "chart.0002.tif": chart[::-1],
        "cells.tif": cells[::4, ::4],
        "fine.tif": cells,
        "bytes.tif": (chart * 100).astype(np.uint8),
    }
    for name, pixels in pictures.items():
        output = OpenImageIO.ImageOutput.create(name)
        assert output is not None, name
        stored = "uint8" if pixels.dtype == np.uint8 else "float"
        spec = OpenImageIO.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], stored)
        output.open(str(folder / name), spec)
        output.write_image(np.ascontiguousarray(pixels))
        output.close()


class Renderer:
    """Renders scenes; the same text is rendered once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[Any, lightsieve.Frame] = {}
        self._files = 0

    def frame(
        self, text: str, sets: Iterable[str] = (), *, seed: int = 0, write: bool = False
    ) -> lightsieve.Frame:
        """A scene's layers. With `write` its drivers' files go to the folder `files`."""
        key = (text, tuple(sets), seed, write)
        if key not in self._known:
            path = self._folder / "probe.ass"
            files = self._folder / "read"
            if "FOLDER" in text and not files.exists():
                files.mkdir()
                _write_files(files)
            path.write_text(text.replace("DATA", str(DATA)).replace("FOLDER", str(files)))
            settings: dict[str, Any] = {"set": dict(part.split("=", 1) for part in sets)}
            if seed:
                settings["seed"] = seed
            if write:
                self._files += 1
                settings["output"] = f"{self._folder}/files{self._files}/"
                Path(settings["output"]).mkdir()
            self._known[key] = lightsieve.render(path, threads=1, **settings)
        return self._known[key]

    def written_over(self, texts: Iterable[str], sets: Iterable[str] = ()) -> str:
        """Renders scenes into one folder, one after the other; gives the last one's file."""
        self._files += 1
        output = f"{self._folder}/files{self._files}/"
        Path(output).mkdir()
        name = ""
        for text in texts:
            path = self._folder / "probe.ass"
            path.write_text(text)
            chosen = dict(part.split("=", 1) for part in sets)
            name = lightsieve.render(path, threads=1, set=chosen, output=output).files[0]
        return name


@dataclass(frozen=True)
class Case:
    """Both pictures of a probe, and what is needed for others."""

    probe: Probe
    renderer: Renderer

    def frame(self, value: str | None, *, seed: int = 0) -> lightsieve.Frame:
        """The layers at a value."""
        probe = self.probe
        return self.renderer.frame(scene_text(probe, value), probe.sets, seed=seed)

    def pixels(self, value: str | None, *, seed: int = 0) -> Pixels:
        """The part that is looked at, as RGBA: grey repeated, alpha 1 where there is none."""
        frame, probe = self.frame(value, seed=seed), self.probe
        found = np.asarray(frame.layer(probe.layer), np.float64)
        found = found.reshape(*found.shape[:2], -1)
        if found.shape[2] == 1:
            found = np.repeat(found, 3, axis=2)
        while found.shape[2] < 4:
            found = np.concatenate([found, np.ones_like(found[:, :, :1])], axis=2)
        height, width = found.shape[:2]
        x0, y0, x1, y1 = probe.where
        return found[
            round(y0 * height) : round(y1 * height), round(x0 * width) : round(x1 * width)
        ]

    @property
    def before(self) -> Pixels:
        """The picture at the first value."""
        return self.pixels(self.probe.before)

    @property
    def after(self) -> Pixels:
        """The picture at the second value."""
        return self.pixels(self.probe.after)

    def instead(self, text: str) -> Pixels:
        """The picture with other parameters in the place of the probed one."""
        probe = self.probe
        given = {**probe.given, **values(text)}
        other = Probe(**{**probe.__dict__, "given": given})
        return Case(other, self.renderer).pixels(None)


def unexpected(probe: Probe, frame: lightsieve.Frame) -> list[str]:
    """What the renderer says of the scene that the table does not know."""
    return [
        f"{item.severity}[{item.code}]: {item.message}"
        for item in frame.diagnostics
        if item.code not in probe.warns
    ]


def all_nodes() -> dict[str, Node]:
    """The registry."""
    return _all_nodes()


@cache
def _all_nodes() -> dict[str, Node]:
    return nodes()


def params_with(status: str) -> list[tuple[Node, Param]]:
    """Every parameter of that status, with its node."""
    return [
        (node, param)
        for node in all_nodes().values()
        for param in node.params
        if param.status == status
    ]
