"""From the rendering space to a screen."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Picture = npt.NDArray[np.float32]

# ACEScg (AP1, white of about D60) to linear Rec. 709 (D65), Bradford adaptation: what every ACES
# implementation uses, e.g. the OpenColorIO configuration of ACES 1.3.
REC709_FROM_ACESCG = np.array(
    [
        [1.70505, -0.62179, -0.08326],
        [-0.13026, 1.14080, -0.01055],
        [-0.02400, -0.12897, 1.15297],
    ],
    dtype=np.float32,
)
# The Y row of ACEScg.
LUMINANCE = np.array([0.27223, 0.67408, 0.05369], dtype=np.float32)


def rec709_from_acescg(linear: Picture) -> Picture:
    """Linear colours in the primaries of a screen.

    Args:
        linear: ACEScg, shape (..., 3).

    Returns:
        Linear Rec. 709, same shape, not clipped.

    Example:
        >>> rec709_from_acescg(np.ones((1, 3), np.float32)).round(3).tolist()
        [[1.0, 1.0, 1.0]]
    """
    out: Picture = linear @ REC709_FROM_ACESCG.T
    return out


def srgb_from_acescg(linear: Picture) -> Picture:
    """Colours as a screen shows them.

    Args:
        linear: ACEScg, shape (..., 3).

    Returns:
        sRGB with its transfer curve, clipped to 0..1, same shape.

    Source:
        IEC 61966-2-1.

    Example:
        >>> np.allclose(srgb_from_acescg(np.full(3, 0.18, np.float32)), 0.461, atol=1e-3)
        True
    """
    rec709 = np.clip(rec709_from_acescg(linear), 0, 1)
    low = rec709 * 12.92
    high = 1.055 * np.power(np.maximum(rec709, 1e-8), 1 / 2.4) - 0.055
    display: Picture = np.where(rec709 <= 0.0031308, low, high).astype(np.float32)
    return np.clip(display, 0, 1)
