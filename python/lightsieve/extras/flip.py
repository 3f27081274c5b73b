"""FLIP: how much a person sees two pictures differ when they are shown in turn, 0 to 1.

Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild: "FLIP: A Difference Evaluator for
Alternating Images", HPG 2020. This is the metric for pictures as a screen shows them: light is
converted to sRGB and clipped, as on the contact sheet. Constants have the paper's names.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lightsieve.extras.colour import rec709_from_acescg

if TYPE_CHECKING:
    from lightsieve.frame import Frame

Picture = npt.NDArray[np.float32]

# A 0.7 m wide screen of 3840 pixels seen from 0.7 m, section 4.
PIXELS_PER_DEGREE = 0.7 * (3840 / 0.7) * math.pi / 180
# Contrast sensitivity of the three opponent channels, table 1: a1, b1, a2, b2.
CSF = (
    (1.0, 0.0047, 0.0, 1e-5),
    (1.0, 0.0053, 0.0, 1e-5),
    (34.1, 0.04, 13.5, 0.025),
)
# Exponent of colour differences, break points of their mapping, exponent and width of features.
QC, PC, PT = 0.7, 0.4, 0.95
QF, FEATURE_WIDTH_DEGREES = 0.5, 0.082

XYZ_FROM_RGB = np.array(
    [
        [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
        [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
        [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
    ],
    dtype=np.float32,
)
RGB_FROM_XYZ = np.linalg.inv(XYZ_FROM_RGB).astype(np.float32)
WHITE = XYZ_FROM_RGB.sum(axis=1)


def _opponent(rgb: Picture) -> Picture:
    """Linear RGB to YCxCz, a linear form of CIELab."""
    xyz = (rgb @ XYZ_FROM_RGB.T) / WHITE
    x, y, z = xyz[..., 0], xyz[..., 1], xyz[..., 2]
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def _rgb(opponent: Picture) -> Picture:
    y = (opponent[..., 0] + 16) / 116
    x, z = opponent[..., 1] / 500 + y, y - opponent[..., 2] / 200
    rgb: Picture = (np.stack([x, y, z], axis=-1) * WHITE) @ RGB_FROM_XYZ.T
    return rgb


def _hunt_lab(rgb: Picture) -> Picture:
    """Linear RGB to CIELab with chroma scaled by lightness (the Hunt effect)."""
    xyz = (rgb @ XYZ_FROM_RGB.T) / WHITE
    delta = 6 / 29
    curve = np.where(xyz > delta**3, np.cbrt(xyz), xyz / (3 * delta**2) + 4 / 29)
    lightness = 116 * curve[..., 1] - 16
    a = 500 * (curve[..., 0] - curve[..., 1]) * lightness * 0.01
    b = 200 * (curve[..., 1] - curve[..., 2]) * lightness * 0.01
    return np.stack([lightness, a, b], axis=-1).astype(np.float32)


def _hyab(a: Picture, b: Picture) -> Picture:
    """Lightness in one norm, chroma in another: good for large differences."""
    d = a - b
    difference: Picture = np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])
    return difference


def _along(picture: Picture, kernel: Picture, axis: int) -> Picture:
    """Convolution with a row or column of weights; the border repeats."""
    radius = len(kernel) // 2
    pad = [(0, 0), (0, 0)]
    pad[axis] = (radius, radius)
    padded = np.pad(picture, pad, mode="edge")
    n = picture.shape[axis]
    out = np.zeros_like(picture)
    for i, weight in enumerate(kernel):
        part = padded[i : i + n] if axis == 0 else padded[:, i : i + n]
        out += weight * part
    return out


def _filter(picture: Picture, across: Picture, down: Picture) -> Picture:
    return _along(_along(picture, across, 1), down, 0)


def _spatial_filter(opponent: Picture) -> Picture:
    """What is left of each channel at the distance of the viewer, section 4.1.2."""
    widest = max(b for _, b1, _, b2 in CSF for b in (b1, b2))
    radius = math.ceil(3 * math.sqrt(widest / (2 * math.pi**2)) * PIXELS_PER_DEGREE)
    x = np.arange(-radius, radius + 1) / PIXELS_PER_DEGREE
    channels = []
    for c, (a1, b1, a2, b2) in enumerate(CSF):
        total, weight = np.zeros(opponent.shape[:2], np.float32), 0.0
        # Each Gaussian of the sum is separable, the sum is not.
        for a, b in ((a1, b1), (a2, b2)):
            kernel = np.exp(-(math.pi**2) * x**2 / b).astype(np.float32)
            scale = a * math.sqrt(math.pi / b)
            total += np.float32(scale) * _filter(opponent[..., c], kernel, kernel)
            weight += scale * float(kernel.sum()) ** 2
        channels.append(total / np.float32(weight))
    return np.stack(channels, axis=-1)


def _features(lightness: Picture) -> tuple[Picture, Picture]:
    """Strength of edges and of points, section 4.2."""
    sd = 0.5 * FEATURE_WIDTH_DEGREES * PIXELS_PER_DEGREE
    radius = math.ceil(3 * sd)
    x = np.arange(-radius, radius + 1)
    gauss = np.exp(-(x**2) / (2 * sd**2))
    edge, point = -x * gauss, (x**2 / sd**2 - 1) * gauss
    # Positive weights add up to 1 and negative ones to -1, over the whole square.
    edge = edge / (edge[edge > 0].sum() * gauss.sum())
    positive, negative = point[point > 0].sum(), -point[point < 0].sum()
    point = np.where(point > 0, point / positive, point / negative) / gauss.sum()
    g, e, p = (kernel.astype(np.float32) for kernel in (gauss, edge, point))
    edges: Picture = np.hypot(_filter(lightness, e, g), _filter(lightness, g, e))
    points: Picture = np.hypot(_filter(lightness, p, g), _filter(lightness, g, p))
    return edges, points


def flip_map(test: Picture, reference: Picture) -> Picture:
    """FLIP of two pictures, pixel by pixel.

    Args:
        test: Linear Rec. 709 in 0..1, shape (height, width, 3).
        reference: The same.

    Returns:
        Shape (height, width), 0 (no difference) to 1.

    Example:
        >>> grey = np.full((8, 8, 3), 0.5, np.float32)
        >>> float(flip_map(grey, grey).max())
        0.0
    """
    a, b = _opponent(test), _opponent(reference)
    lab_a, lab_b = (_hunt_lab(np.clip(_rgb(_spatial_filter(p)), 0, 1)) for p in (a, b))
    green_blue = np.eye(3, dtype=np.float32)[1:]
    largest = float(_hyab(*_hunt_lab(green_blue))) ** QC
    power = _hyab(lab_a, lab_b) ** QC
    low = PT / (PC * largest) * power
    high = PT + (power - PC * largest) / (largest - PC * largest) * (1 - PT)
    colour = np.where(power < PC * largest, low, high)
    lightness = [((p[..., 0] + 16) / 116).astype(np.float32) for p in (a, b)]
    (edges_a, points_a), (edges_b, points_b) = map(_features, lightness)
    feature = np.maximum(np.abs(edges_a - edges_b), np.abs(points_a - points_b))
    feature = (feature / math.sqrt(2)) ** QF
    result: Picture = (colour ** (1 - feature)).astype(np.float32)
    return result


def flip(test: Picture, reference: Picture) -> float:
    """Mean FLIP of two layers of light, as a screen would show them.

    Args:
        test: ACEScg, shape (height, width, 3).
        reference: The same.

    Returns:
        0 (no difference) to 1.

    Example:
        >>> black, white = np.zeros((8, 8, 3), np.float32), np.ones((8, 8, 3), np.float32)
        >>> flip(black, white) > 0.9
        True
    """
    shown = [np.clip(rec709_from_acescg(picture), 0, 1) for picture in (test, reference)]
    return float(flip_map(*shown).mean())


def flip_of_layers(test: Frame, reference: Frame) -> dict[str, float]:
    """Mean FLIP of each layer of light that two frames have.

    Args:
        test: A frame.
        reference: Another one.

    Returns:
        By name; data layers (Z, N, ...) and layers of unlike size are left out.

    Example:
        >>> flip_of_layers(frame, frame)["RGBA"]
        0.0
    """
    out = {}
    for name in reference.layers():
        info = reference.info(name)
        if name not in test.layers() or not (info.expression or name in ("RGBA", "RGB")):
            continue
        pictures = [frame.layer(name) for frame in (test, reference)]
        if pictures[0].shape == pictures[1].shape and pictures[0].shape[2] >= 3:
            shown = [np.nan_to_num(p[:, :, :3].astype(np.float32)) for p in pictures]
            out[name] = flip(shown[0], shown[1])
    return out
