"""A contact sheet: every layer of a frame as a small labelled picture, in one PNG.

Light is shown in sRGB, converted from the rendering space (ACEScg), without any tone curve. Most
layers are much darker than the beauty, so each but the beauty gets its own exposure in whole
stops; a label says which. Data layers are brought to the range 0 to 1, and the label says how.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw, ImageFont

from lightsieve.extras.colour import LUMINANCE, srgb_from_acescg

if TYPE_CHECKING:
    from lightsieve.frame import Frame, Layer, Pixels

Picture = npt.NDArray[np.float32]

# The brightest hundredth of a dark layer is brought to about this value: bright, seldom clipped.
TARGET_LUMINANCE = 0.8
MAX_STOPS = 10

BACKGROUND = (24, 24, 26)
TEXT, DIM = (235, 235, 235), (150, 150, 155)
MARGIN, GAP = 24, 12
NAME_SIZE, NOTE_SIZE = 17, 13


class Tile(NamedTuple):
    """One layer, ready to be drawn."""

    name: str
    note: str
    """How it is shown, and its expression."""
    picture: Image.Image


def _resize(pixels: Picture, width: int) -> Picture:
    """Averages pixels down to a width; small pictures grow by a whole factor, pixel by pixel."""
    height, old_width, channels = pixels.shape
    if old_width <= width:
        factor = max(1, width // old_width)
        return pixels.repeat(factor, axis=0).repeat(factor, axis=1)
    size = (width, max(1, round(height * width / old_width)))
    parts = [
        np.asarray(Image.fromarray(pixels[:, :, c]).resize(size, Image.Resampling.BOX))
        for c in range(channels)
    ]
    return np.stack(parts, axis=-1)


def _image(display: Picture) -> Image.Image:
    return Image.fromarray((display * 255 + 0.5).astype(np.uint8), "RGB")


def _light_stops(pixels: Picture) -> int | None:
    """How far a layer of light is brightened, in whole stops; None if it is black."""
    luminance = pixels @ LUMINANCE
    lit = luminance[luminance > 0]
    if lit.size == 0:
        return None
    bright = float(np.percentile(lit, 99))
    stops = math.floor(math.log2(TARGET_LUMINANCE / bright)) if bright > 0 else MAX_STOPS
    return max(0, min(MAX_STOPS, stops))


def _show_light(pixels: Picture, width: int, is_beauty: bool) -> tuple[str, Image.Image]:
    stops = 0 if is_beauty else _light_stops(pixels)
    small = _resize(pixels, width)
    if stops is None:
        return "black", _image(np.zeros_like(small))
    note = f"+{stops} stop{'' if stops == 1 else 's'}" if stops else ""
    return note, _image(srgb_from_acescg(small * np.float32(2.0**stops)))


def _show_data(pixels: Picture, width: int) -> tuple[str, Image.Image]:
    small = _resize(pixels, width)[:, :, :3]
    low, high = float(small.min()), float(small.max())
    span = high - low
    unit = (small - low) / np.float32(span) if span > 0 else np.zeros_like(small)
    if unit.shape[2] == 1:
        unit = np.repeat(unit, 3, axis=2)
    elif unit.shape[2] == 2:
        unit = np.concatenate([unit, np.zeros_like(unit[:, :, :1])], axis=2)
    return f"{low:.4g} to {high:.4g} shown as 0 to 1", _image(unit)


def _show_ids(pixels: npt.NDArray[np.uint32], width: int) -> tuple[str, Image.Image]:
    step = max(1, -(-pixels.shape[1] // width))
    factor = max(1, width // pixels.shape[1])
    ids = pixels[::step, ::step, 0].repeat(factor, axis=0).repeat(factor, axis=1).astype(np.uint64)
    # Fibonacci hashing: neighbours in number get colours far apart.
    mixed = (ids * np.uint64(0x9E3779B97F4A7C15)) >> np.uint64(40)
    colours = np.stack([(mixed >> np.uint64(8 * c)) & np.uint64(255) for c in range(3)], axis=-1)
    colours[ids == 0] = 0
    return "a colour for each number", Image.fromarray(colours.astype(np.uint8), "RGB")


def make_tile(info: Layer, pixels: Pixels, width: int) -> Tile:
    """A layer as a small picture with what its label says.

    Args:
        info: The layer.
        pixels: Shape (height, width, channels).
        width: Largest width of the picture [pixels].

    Returns:
        The tile.
    """
    if pixels.dtype == np.uint32:
        note, picture = _show_ids(pixels.astype(np.uint32, copy=False), width)
    else:
        finite = np.nan_to_num(pixels.astype(np.float32, copy=False), posinf=0, neginf=0)
        is_beauty = (info.aov or info.name) in ("RGBA", "RGB") and not info.light_group
        if (is_beauty or info.expression) and finite.shape[2] >= 3:
            note, picture = _show_light(finite[:, :, :3], width, is_beauty)
        else:
            note, picture = _show_data(finite, width)
    group = f"light group {info.light_group}" if info.light_group else ""
    parts = [part for part in (note, info.expression, group) if part]
    return Tile(info.name, "   ".join(parts), picture)


def _fit(draw: ImageDraw.ImageDraw, text: str, font: ImageFont.FreeTypeFont, width: int) -> str:
    """The text, cut with dots if it is wider than `width`."""
    if draw.textlength(text, font=font) <= width:
        return text
    while text and draw.textlength(text + "...", font=font) > width:
        text = text[:-1]
    return text + "..."


def _font(size: int) -> ImageFont.FreeTypeFont:
    font = ImageFont.load_default(size)
    assert isinstance(font, ImageFont.FreeTypeFont), "Pillow was built without FreeType"
    return font


def contact_sheet(frame: Frame, title: str, *, width: int = 320, columns: int = 0) -> Image.Image:
    """Draws all layers of a frame on one sheet.

    Args:
        frame: What `lightsieve.render` or `lightsieve.exr.read` returned.
        title: The headline.
        width: Width of each small picture [pixels].
        columns: Pictures in a row; 0: about as many as rows.

    Returns:
        The sheet, to be saved with its `save`.

    Example:
        >>> contact_sheet(lightsieve.exr.read("out/frame.exr"), "a frame").mode
        'RGB'
    """
    tiles = [make_tile(frame.info(n), frame.layer(n), width) for n in frame.layers()]
    cell_width = max([width, *(t.picture.width for t in tiles)])
    picture_height = max((t.picture.height for t in tiles), default=0)
    cell_height = picture_height + NAME_SIZE + NOTE_SIZE + GAP
    if columns <= 0:
        # A sheet about as wide as a screen: 16 to 10.
        ratio = 1.6 * cell_height / cell_width
        columns = max(1, round(math.sqrt(len(tiles) * ratio)))
    rows = -(-len(tiles) // columns)
    top = MARGIN + NAME_SIZE + NOTE_SIZE + 2 * GAP
    size = (
        2 * MARGIN + columns * cell_width + (columns - 1) * GAP,
        top + rows * (cell_height + GAP) + MARGIN - GAP,
    )
    sheet = Image.new("RGB", size, BACKGROUND)
    draw = ImageDraw.Draw(sheet)
    name_font, note_font = _font(NAME_SIZE), _font(NOTE_SIZE)
    draw.text((MARGIN, MARGIN), title, TEXT, name_font)
    legend = "light: ACEScg shown as sRGB; stops are added where a label says so"
    draw.text((MARGIN, MARGIN + NAME_SIZE + GAP // 2), legend, DIM, note_font)
    for index, tile in enumerate(tiles):
        row, column = divmod(index, columns)
        x, y = MARGIN + column * (cell_width + GAP), top + row * (cell_height + GAP)
        sheet.paste(tile.picture, (x, y))
        below = y + picture_height + GAP // 3
        draw.text((x, below), _fit(draw, tile.name, name_font, cell_width), TEXT, name_font)
        note = _fit(draw, tile.note, note_font, cell_width)
        draw.text((x, below + NAME_SIZE + 3), note, DIM, note_font)
    return sheet
