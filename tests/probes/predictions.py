"""What a probe may predict of a picture: one short function a word, which raises what is wrong.

Thresholds are far above what noise does: both pictures of a probe have the same random numbers,
and `differs` demands more than what another seed changes.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import OpenImageIO

import lightsieve
from tests.probes.probing import (
    BrokenPredictionError,
    Case,
    Pixels,
    Probe,
    Renderer,
    scene_text,
    unexpected,
)

Prediction = Callable[[Case, list[str]], None]

BRIGHTER = 1.02
"""Least ratio of means."""
REDDER = 0.01
"""Least change of a channel's part of the sum."""
MOVED = 0.2
"""Least way of the centre of light [pixels]."""
CONTRAST = 1.03
"""Least ratio of contrasts."""
DIFFERS = 0.01
"""Least difference, against the mean square of the pictures."""
OVER_NOISE = 2.0
"""Least difference, against that of another seed."""
CORNER = (("min", "8"), ("max", "15"))
"""The lower right quarter of a frame of 16 pixels."""
EXACT = 2e-4
"""Most relative difference of numbers that must be equal, but for rounding."""


def _light(pixels: Pixels) -> float:
    return float(pixels[:, :, :3].mean())


def _ratio(case: Case) -> float:
    before, after = _light(case.before), _light(case.after)
    return after / before if before else float("inf") if after else 1.0


def _demand(truth: bool, message: str) -> None:
    if not truth:
        raise BrokenPredictionError(message)


def brighter(case: Case, arguments: list[str]) -> None:
    """Mean light rises, by the factor that is given or more."""
    least = float(arguments[0]) if arguments else BRIGHTER
    _demand(_ratio(case) >= least, f"light times {_ratio(case):.4f}, at least {least}")


def darker(case: Case, arguments: list[str]) -> None:
    """Mean light falls, to the part that is given or less."""
    most = float(arguments[0]) if arguments else 1 / BRIGHTER
    _demand(_ratio(case) <= most, f"light times {_ratio(case):.4f}, at most {most:.4f}")


def times(case: Case, arguments: list[str]) -> None:
    """Every pixel is multiplied by a number (within 1 % of the mean, or a second argument)."""
    within = float(arguments[1]) if len(arguments) > 1 else 0.01
    factor, before, after = float(arguments[0]), case.before, case.after
    error = np.abs(after - before * factor)[:, :, :3].mean() / max(_light(after), 1e-9)
    _demand(error <= within, f"not times {factor}: off by {error:.4f} (ratio {_ratio(case):.4f})")


def _tint(case: Case, channel: int) -> None:
    before, after = (
        (p[:, :, channel].sum() / max(p[:, :, :3].sum(), 1e-9)) for p in (case.before, case.after)
    )
    _demand(after - before >= REDDER, f"part of channel {channel}: {before:.4f} -> {after:.4f}")


def redder(case: Case, arguments: list[str]) -> None:
    """Red's part of the light rises."""
    _tint(case, 0)


def greener(case: Case, arguments: list[str]) -> None:
    """Green's part of the light rises."""
    _tint(case, 1)


def bluer(case: Case, arguments: list[str]) -> None:
    """Blue's part of the light rises."""
    _tint(case, 2)


def _centre(pixels: Pixels) -> tuple[float, float]:
    light = np.maximum(pixels[:, :, :3].sum(axis=2), 0)
    rows, columns = np.indices(light.shape)
    total = max(light.sum(), 1e-12)
    return float((columns * light).sum() / total), float((rows * light).sum() / total)


def _moves(case: Case, axis: int, sign: int) -> None:
    way = (_centre(case.after)[axis] - _centre(case.before)[axis]) * sign
    _demand(way >= MOVED, f"the centre of light moves by {way:.3f} pixels, at least {MOVED}")


def left(case: Case, arguments: list[str]) -> None:
    """Light moves to the left."""
    _moves(case, 0, -1)


def right(case: Case, arguments: list[str]) -> None:
    """Light moves to the right."""
    _moves(case, 0, 1)


def up(case: Case, arguments: list[str]) -> None:
    """Light moves upward."""
    _moves(case, 1, -1)


def down(case: Case, arguments: list[str]) -> None:
    """Light moves downward."""
    _moves(case, 1, 1)


def _contrast(pixels: Pixels) -> float:
    """Differences of neighbours against the mean."""
    light = pixels[:, :, :3].sum(axis=2)
    steps = np.abs(np.diff(light, axis=0)).mean() + np.abs(np.diff(light, axis=1)).mean()
    return float(steps / max(light.mean(), 1e-12))


def sharper(case: Case, arguments: list[str]) -> None:
    """Neighbours differ more (also: noisier, busier)."""
    before, after = _contrast(case.before), _contrast(case.after)
    _demand(after >= CONTRAST * before, f"contrast of neighbours {before:.4f} -> {after:.4f}")


def blurrier(case: Case, arguments: list[str]) -> None:
    """Neighbours differ less (also: cleaner)."""
    before, after = _contrast(case.before), _contrast(case.after)
    _demand(after * CONTRAST <= before, f"contrast of neighbours {before:.4f} -> {after:.4f}")


def _peak(pixels: Pixels) -> float:
    light = pixels[:, :, :3].sum(axis=2)
    return float(light.max() / max(light.mean(), 1e-12))


def peaked(case: Case, arguments: list[str]) -> None:
    """The brightest pixel stands out more."""
    before, after = _peak(case.before), _peak(case.after)
    _demand(
        after >= CONTRAST * before, f"brightest pixel against the mean {before:.3f} -> {after:.3f}"
    )


def spread(case: Case, arguments: list[str]) -> None:
    """The brightest pixel stands out less."""
    before, after = _peak(case.before), _peak(case.after)
    _demand(
        after * CONTRAST <= before, f"brightest pixel against the mean {before:.3f} -> {after:.3f}"
    )


def _alpha(case: Case) -> tuple[float, float]:
    return float(case.before[:, :, 3].mean()), float(case.after[:, :, 3].mean())


def fuller(case: Case, arguments: list[str]) -> None:
    """Mean alpha rises."""
    before, after = _alpha(case)
    _demand(after - before >= REDDER, f"alpha {before:.4f} -> {after:.4f}")


def emptier(case: Case, arguments: list[str]) -> None:
    """Mean alpha falls."""
    before, after = _alpha(case)
    _demand(before - after >= REDDER, f"alpha {before:.4f} -> {after:.4f}")


def _equal(one: Pixels, other: Pixels, what: str, within: float = 1e-3) -> None:
    _demand(one.shape == other.shape, f"{what}: sizes {one.shape} and {other.shape}")
    scale = max(float(np.abs(other).mean()), 1e-6)
    worst = float(np.abs(one - other).max()) / scale
    _demand(worst <= within, f"{what}: off by {worst:.4f} of the mean")


def mirrored(case: Case, arguments: list[str]) -> None:
    """The picture is the first one mirrored in `x` or `y`; how far it may be off [mean light]."""
    before = case.before
    turned = before[:, ::-1] if arguments[0] == "x" else before[::-1]
    within = float(arguments[1]) if len(arguments) > 1 else 0.05
    _equal(case.after, turned, f"not mirrored in {arguments[0]}", within)
    _differs(case)


def gives(case: Case, arguments: list[str]) -> None:
    """The mean colour is known (3 numbers, or 4 with alpha), and another one than before."""
    wanted = np.array([float(number) for number in arguments])
    got = case.after.mean(axis=(0, 1))[: len(wanted)]
    error = float(np.abs(got - wanted).max())
    within = EXACT * max(1, float(np.abs(wanted).max()))
    _demand(error <= within, f"{got} and not {wanted}")
    before = case.before.mean(axis=(0, 1))[: len(wanted)]
    _demand(float(np.abs(before - wanted).max()) > 5 * within, f"{before} already before")


def equals(case: Case, arguments: list[str]) -> None:
    """The picture is that of other parameters in the place of this one, and not the first."""
    _equal(case.after, case.instead(" ".join(arguments)), f"not as with {' '.join(arguments)}")
    _differs(case)


def _difference(one: Pixels, other: Pixels) -> float:
    if one.shape != other.shape:
        return float("inf")
    size = max(float((one**2).mean()), float((other**2).mean()), 1e-12)
    return float(np.sqrt(((one - other) ** 2).mean() / size))


def _blocks(pixels: Pixels) -> Pixels:
    """Means of sixteen parts: less noise, for changes that are wide."""
    rows = np.array_split(pixels, min(4, pixels.shape[0]), axis=0)
    return np.array(
        [
            [b.mean(axis=(0, 1)) for b in np.array_split(r, min(4, r.shape[1]), axis=1)]
            for r in rows
        ]
    )


def _differs(case: Case) -> None:
    before, after = case.before, case.after
    other = case.pixels(case.probe.before, seed=77)
    said = []
    for seen in (np.asarray, _blocks):
        change = _difference(seen(before), seen(after))
        least = max(DIFFERS, OVER_NOISE * _difference(seen(before), seen(other)))
        if change >= least:
            return
        said.append(f"{change:.4f}, at least {least:.4f}")
    raise BrokenPredictionError(f"differs by {said[0]} (of sixteen parts: {said[1]})")


def differs(case: Case, arguments: list[str]) -> None:
    """The picture is another one, by more than noise."""
    _differs(case)


def noise(case: Case, arguments: list[str]) -> None:
    """The noise is another one, and the mean stays."""
    _demand(not np.array_equal(case.before, case.after), "the same bits")
    _demand(abs(_ratio(case) - 1) < 0.1, f"light times {_ratio(case):.4f}")


def same(case: Case, arguments: list[str]) -> None:
    """The picture is the same, bit for bit: for parameters that only change how it is made."""
    _demand(np.array_equal(case.before, case.after), "the picture is another one")


def size(case: Case, arguments: list[str]) -> None:
    """Width and height of the picture [pixels]."""
    height, width = case.after.shape[:2]
    _demand([width, height] == [int(a) for a in arguments], f"size {width} {height}")
    _demand(case.before.shape != case.after.shape, "the same size as before")


def _code(case: Case, value: str | None) -> str:
    """The code of the first error; empty if it renders."""
    try:
        case.frame(value)
    except lightsieve.LightsieveError as error:
        return error.errors[0].code
    return ""


def fails(case: Case, arguments: list[str]) -> None:
    """The first value renders, the second is an error of that code."""
    codes = [_code(case, case.probe.before), _code(case, case.probe.after)]
    _demand(codes == ["", arguments[0]], f"errors: {codes}")


def renders(case: Case, arguments: list[str]) -> None:
    """The first value is an error of that code, the second renders."""
    codes = [_code(case, case.probe.before), _code(case, case.probe.after)]
    _demand(codes == [arguments[0], ""], f"errors: {codes}")


def _facts(case: Case, value: str | None) -> dict[str, str]:
    """What another reader finds in the file that was written."""
    probe = case.probe
    frame = case.renderer.frame(scene_text(probe, value), probe.sets, write=True)
    name = frame.files[0]
    source = OpenImageIO.ImageInput.open(name)
    assert source is not None, name
    spec = source.spec()
    parts = 1
    while source.seek_subimage(parts, 0):
        parts += 1
    deep = source.read_native_deep_image() if spec.deep else None
    counts = [deep.samples(pixel) for pixel in range(deep.pixels)] if deep else [0]
    source.close()
    if deep is not None:
        return {
            "name": Path(name).name,
            "tile": str(spec.tile_width),
            "types": ",".join(str(spec.channelformat(c)) for c in range(spec.nchannels)),
            "samples": str(max(counts)),
        }
    # As they are stored: colours that are not multiplied by alpha stay so.
    raw = OpenImageIO.ImageSpec()
    raw.attribute("oiio:UnassociatedAlpha", 1)
    pixels = np.asarray(OpenImageIO.ImageBuf(name, 0, 0, raw).get_pixels(OpenImageIO.FLOAT))
    named = {attribute.name: str(attribute.value) for attribute in spec.extra_attribs}
    return {
        **named,
        "name": Path(name).name,
        "format": str(spec.format),
        "tile": str(spec.tile_width),
        "channels": ",".join(spec.channelnames),
        "size": f"{spec.width}x{spec.height}",
        "bytes": str(Path(name).stat().st_size),
        "parts": str(parts),
        "centre": f"{pixels[pixels.shape[0] // 2, pixels.shape[1] // 2, 0]:.3f}",
        "ragged": str(np.ptp(pixels[:, :, 0], axis=0).max()),
    }


def goes_on(case: Case, arguments: list[str]) -> None:
    """Written again for a corner of the frame, a file keeps the rest at the second value only."""
    probe = case.probe
    corner = {f"region_{end}_{axis}": value for end, value in CORNER for axis in "xy"}
    part = Probe(**{**probe.__dict__, "options": {**probe.options, **corner}})
    kept = []
    for value in (probe.before, probe.after):
        texts = [scene_text(probe, value), scene_text(part, value)]
        name = case.renderer.written_over(texts, probe.sets)
        pixels = np.asarray(OpenImageIO.ImageBuf(name).get_pixels(OpenImageIO.FLOAT))
        kept.append(pixels.shape[0] == int(arguments[0]) and bool(pixels[0, 0].max() > 0))
    _demand(kept == [False, True], f"the rest is kept: {kept}")


def file(case: Case, arguments: list[str]) -> None:
    """`NAME=VALUE` or `NAME>VALUE` is true of the second file and not of the first."""
    for argument in arguments:
        name, sign, wanted = argument.partition(">" if ">" in argument else "=")
        found = [
            _facts(case, value).get(name, "") for value in (case.probe.before, case.probe.after)
        ]
        so = [float(text) > float(wanted) if sign == ">" else text == wanted for text in found]
        _demand(
            so == [False, True], f"file's {name}: {found[0]!r} -> {found[1]!r}, not {wanted!r}"
        )


PREDICTIONS: dict[str, Prediction] = {
    function.__name__: function
    for function in (
        brighter, darker, times, redder, greener, bluer, left, right, up, down, sharper,
        blurrier, peaked, spread, fuller, emptier, mirrored, gives, equals, differs, noise, same,
        size, fails, renders, file, goes_on,
    )
}  # fmt: skip


def judge(probe: Probe, renderer: Renderer) -> str:
    """What is wrong with a probe; empty if all that it predicts comes true."""
    case = Case(probe, renderer)
    try:
        for prediction in probe.expect:
            word, *arguments = prediction.split()
            PREDICTIONS[word](case, arguments)
        if not any(text.startswith(("fails", "renders")) for text in probe.expect):
            for value in (probe.before, probe.after):
                said = unexpected(probe, case.frame(value))
                _demand(not said, "; ".join(said))
    except (BrokenPredictionError, lightsieve.LightsieveError) as wrong:
        values = f"{probe.before or 'default'} -> {probe.after}"
        return f"{probe.node}.{probe.param} ({values}; {', '.join(probe.expect)}): {wrong}"
    return ""
