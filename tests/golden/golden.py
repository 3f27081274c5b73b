"""Golden scenes: small pictures whose means are compared with stored ones by z-tests.

They guard against change and prove no fidelity: what is stored is what Lightsieve gave. A scene is
rendered with several seeds; a picture is the means of 8 x 8 blocks. Stored are the mean of 64 such
pictures and the variance between them, so a change of the random numbers passes and one of the
light does not.

    python -m tests.golden.golden                   prints how near each scene is to an alarm
    python -m tests.golden.golden --write NAME...   stores scenes anew (all, without a name)

README.md beside this file says when that is allowed.
"""

from __future__ import annotations

import sys
import tempfile
import tomllib
from collections.abc import Iterable
from pathlib import Path
from statistics import NormalDist
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from tests.probes.probing import SCENES, Renderer, values, written

FOLDER = Path(__file__).resolve().parent
STORED = FOLDER / "stored"
TABLE: dict[str, dict[str, Any]] = tomllib.loads((FOLDER / "scenes.toml").read_text())

BLOCKS = 8
"""Blocks a side of the picture."""
STORED_RUNS, TESTED_RUNS = 64, 48
STORED_SEEDS = range(1000, 1000 + STORED_RUNS)
TESTED_SEEDS = range(1, 1 + TESTED_RUNS)
FALSE_ALARM = 1e-4
"""Of the whole suite."""
ROUNDING = 2e-5
"""Of the picture's mean: what other instructions of a processor may change without noise."""

Pictures = npt.NDArray[np.float64]
"""Means of blocks; shape (runs, rows, columns, 4)."""


def scene_text(name: str) -> str:
    """The scene as a file."""
    row = TABLE[name]
    around = SCENES[row["scene"]]
    options = {**values(around.options), **values(row.get("options", ""))}
    parts = [f"options\n{{\n{written(options)}\n}}", around.nodes, row.get("nodes", "")]
    return "\n".join([*parts, row["probe"]])


def blocks(pixels: npt.NDArray[Any]) -> npt.NDArray[np.float64]:
    """Means of 8 x 8 parts of a picture."""
    rows = np.array_split(pixels.astype(np.float64), BLOCKS, axis=0)
    return np.array(
        [[part.mean(axis=(0, 1)) for part in np.array_split(row, BLOCKS, axis=1)] for row in rows]
    )


def runs(name: str, seeds: Iterable[int], folder: Path, sets: Iterable[str] = ()) -> Pictures:
    """The scene's pictures with these seeds."""
    renderer, text = Renderer(folder), scene_text(name)
    sets = [*TABLE[name].get("set", []), *sets]
    return np.array([blocks(renderer.frame(text, sets, seed=s).layer("RGBA")) for s in seeds])


def store(name: str, folder: Path) -> None:
    """Writes the mean and the variance of the scene's pictures."""
    pictures = runs(name, STORED_SEEDS, folder)
    both = np.stack([pictures.mean(axis=0), pictures.var(axis=0, ddof=1)])
    whole = pictures.mean(axis=(1, 2))
    np.savez_compressed(
        STORED / f"{name}.npz",
        blocks=both.astype(np.float32),
        whole=np.stack([whole.mean(axis=0), whole.var(axis=0, ddof=1)]).astype(np.float32),
    )


class Scores(NamedTuple):
    """z of a scene's pictures against what is stored."""

    blocks: npt.NDArray[np.float64]
    """Of every block and channel."""
    whole: npt.NDArray[np.float64]
    """Of the whole picture's channels."""

    def alarm(self) -> float:
        """The largest z against its limit: above 1 the scene has changed."""
        return float(
            max(np.abs(self.blocks).max() / BLOCK_LIMIT, np.abs(self.whole).max() / WHOLE_LIMIT)
        )


def scores(name: str, pictures: Pictures) -> Scores:
    """Compares pictures of a scene with the stored ones.

    The variance of a picture is the larger one of both sides: a change that makes more noise does
    not look like a change of the mean.
    """
    with np.load(STORED / f"{name}.npz") as file:
        stored = [(file["blocks"], pictures), (file["whole"], pictures.mean(axis=(1, 2)))]
    found = []
    for (mean, variance), seen in stored:
        n = len(seen)
        spread = variance / STORED_RUNS + np.maximum(variance, seen.var(axis=0, ddof=1)) / n
        floor = ROUNDING * max(float(np.abs(mean).mean()), 1e-6)
        found.append(((seen.mean(axis=0) - mean) / np.sqrt(spread + floor**2)).ravel())
    return Scores(*found)


def threshold(n_tests: int) -> float:
    """The z that any of so many tests exceeds with half of the probability FALSE_ALARM.

    Sidak's correction, and Student's distribution for the 63 degrees of freedom of the stored
    variance. Source: Abramowitz and Stegun 1964, 26.7.5.
    """
    each = 1 - (1 - FALSE_ALARM / 2) ** (1 / n_tests)
    z, dof = NormalDist().inv_cdf(1 - each / 2), STORED_RUNS - 1
    return (
        z
        + (z**3 + z) / (4 * dof)
        + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * dof**2)
        + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * dof**3)
    )


BLOCK_LIMIT = threshold(len(TABLE) * BLOCKS * BLOCKS * 4)
"""No |z| of a block may be larger."""
WHOLE_LIMIT = threshold(len(TABLE) * 4)
"""No |z| of a whole picture may be larger. They are fewer, so a smaller change is seen."""


def main() -> int:
    """Compares or stores."""
    write = "--write" in sys.argv
    names = [name for name in sys.argv[1:] if name != "--write"] or list(TABLE)
    worst = 0.0
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            if write:
                store(name, Path(folder))
                print(f"wrote {name}")
            else:
                alarm = scores(name, runs(name, TESTED_SEEDS, Path(folder))).alarm()
                worst = max(worst, alarm)
                print(f"{name:24} {alarm:5.2f}{'  changed' if alarm > 1 else ''}")
    return 1 if worst > 1 else 0


if __name__ == "__main__":
    sys.exit(main())
