"""What a render took and held, for machines: documents, and the files that gather them."""

from __future__ import annotations

import json
import os
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lightsieve.errors import LightsieveError, without_place

if TYPE_CHECKING:
    from lightsieve._core import CompiledScene, Outcome, SceneSummary

KEYS = {
    "files": "written",
    "stopped": "true if Ctrl-C ended it early",
    "width": "of the rendered region [pixels]",
    "height": "of the rendered region [pixels]",
    "samples": "camera samples taken",
    "training_samples": "camera samples that --guiding learned from, not in `samples`",
    "resumed_samples": "camera samples that a checkpoint had, not in `samples`",
    "checkpoint": "file from which --resume can go on, or null",
    "dropped_samples": "contributions that were not finite",
    "rays": "closest-hit and shadow rays, those of training too",
    "rays_by_kind": "the same by what they were traced for: `camera`, `shadow`, `diffuse`, "
    "`specular`, `transmission`, `volume`, `subsurface`",
    "seconds": "sampling, without reading the scene and writing files",
    "output_seconds": "writing files",
    "samples_per_second": "`samples` / `seconds`",
    "times": "seconds by stage: `read`, `compile`, `textures` (opened), `volumes` (read), `accel` "
    "(structures for rays), `render`, `write`",
    "memory": "bytes at the end by what they hold: `geometry`, `accel`, `volumes`, `textures`, "
    "`automata`, `guide`, `film`, `layers` (kept for Python), `output`, `checkpoint`, `other` "
    "(the rest of the peak: the program, the scene as it was read)",
    "peak_memory": "the most bytes that the process ever held",
    "forecast": "before the first ray: `memory` (at most, by the same names), `total`, "
    "`file_bytes` (by file, before compression), `checkpoint_bytes` (of that file, at most)",
    "aovs": "`layers`, `expressions`, `states`, `atoms`: how many",
    "warning_codes": "how often each code was warned of; `other`: beyond what is kept",
    "noise": "by layer of light: luminance as `mean` and root mean square (`level`), and the "
    "standard `error` of a pixel's, root mean square",
}
"""Keys of `of_render`, and what they hold."""


def warning_codes(scene: CompiledScene) -> dict[str, int]:
    """How often each code was warned of, the most frequent first.

    Args:
        scene: A scene with its diagnostics.

    Returns:
        Counts; warnings of which nothing but their number was kept are `other`.
    """
    counts = Counter(item.code for item in scene.diagnostics if item.severity == "warning")
    out = dict(sorted(counts.items(), key=lambda pair: (-pair[1], pair[0])))
    if more := scene.n_warnings - counts.total():
        out["other"] = more
    return out


def forecast(summary: SceneSummary) -> dict[str, Any]:
    """What a render will take at most.

    Args:
        summary: Of the scene.

    Returns:
        The object that `KEYS` describes.
    """
    return {
        "memory": summary.forecast,
        "total": sum(summary.forecast.values()),
        "file_bytes": dict(zip(summary.files, summary.file_bytes, strict=True)),
        "checkpoint_bytes": summary.checkpoint_bytes,
    }


def of_render(scene: CompiledScene, outcome: Outcome) -> dict[str, Any]:
    """All that is known of a render.

    Args:
        scene: What was rendered.
        outcome: What came of it.

    Returns:
        A document with `KEYS`.
    """
    summary = scene.summary()
    return {
        "files": outcome.files,
        "stopped": outcome.stopped,
        "width": outcome.width,
        "height": outcome.height,
        "samples": outcome.samples,
        "training_samples": outcome.training_samples,
        "resumed_samples": outcome.resumed_samples,
        "checkpoint": outcome.checkpoint or None,
        "dropped_samples": outcome.dropped_samples,
        "rays": outcome.rays,
        "rays_by_kind": outcome.rays_by_kind,
        "seconds": outcome.seconds,
        "output_seconds": outcome.output_seconds,
        "samples_per_second": outcome.samples / outcome.seconds if outcome.seconds > 0 else 0.0,
        "times": {**scene.times, "render": outcome.seconds, "write": outcome.output_seconds},
        "memory": outcome.memory,
        "peak_memory": outcome.peak_memory,
        "forecast": forecast(summary),
        "aovs": {
            "layers": len(summary.layers),
            "expressions": summary.n_aovs,
            "states": summary.n_states,
            "atoms": summary.n_atoms,
        },
        "warning_codes": warning_codes(scene),
        "noise": {
            name: {"mean": mean, "level": level, "error": error}
            for name, mean, level, error in outcome.noise
        },
    }


class StatisticsFile:
    """A file of renders: `{"render 0000": {...}, "render 0001": {...}, ...}`."""

    def __init__(self, path: str | os.PathLike[str], *, append: bool) -> None:
        """Finds out whether the file can be written, and reads what it holds.

        Args:
            path: The file.
            append: Go on with what it holds; otherwise it is written anew.

        Raises:
            LightsieveError: The folder cannot be written (`file-unwritable`), or the file is no
                file of statistics (`file-format`).
        """
        path = self._path = Path(path)
        self._part = path.with_name(f".{path.name}.{os.getpid()}.part")
        self._renders: dict[str, Any] = {}
        try:
            self._part.touch()
            self._part.unlink()
            if append and path.exists():
                held = json.loads(path.read_text())
                self._renders = held if isinstance(held, dict) else {"": held}
        except OSError as error:
            raise self._refused(error) from None
        except (ValueError, RecursionError):
            self._renders = {"": None}
        if not all(name.startswith("render ") for name in self._renders):
            raise LightsieveError(
                [
                    without_place(
                        "file-format",
                        f'"{path}" holds no statistics to go on with',
                        "remove the file, name another one, or set stats_mode to overwrite",
                    )
                ]
            )

    def write(self, document: dict[str, Any]) -> None:
        """Adds a render. The file appears under its name only when it is complete.

        Args:
            document: As `of_render` makes it.

        Raises:
            LightsieveError: The file cannot be written.
        """
        self._renders[f"render {len(self._renders):04}"] = document
        try:
            self._part.write_text(json.dumps(self._renders, indent=2, allow_nan=False) + "\n")
            self._part.replace(self._path)
        except OSError as error:
            self._part.unlink(missing_ok=True)
            raise self._refused(error) from None

    def _refused(self, error: OSError) -> LightsieveError:
        message = f'cannot write "{self._path}": {error.strerror or error}'
        return LightsieveError(
            [without_place("file-unwritable", message, "name a file in a folder that is there")]
        )
