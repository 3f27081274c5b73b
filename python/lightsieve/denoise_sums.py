"""Layers that were denoised one by one, brought back to where they add up.

Each layer comes with how far it may be off. Of all pictures that fulfil every sum at once and have
no negative light, the one that is nearest to the given layers in units of that is taken, pixel by
pixel. docs/denoising.md has the derivation. Nothing here knows of files or of the denoiser.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

# Half the side of the window that errors are averaged over [pixels]. Wide: where light is rare,
# most of what a layer may be off is told by neighbours that were hit.
ERROR_RADIUS = 12
# Half the side of the window that noise is averaged out in before: what its pixels have in common
# is no noise, for each camera sample belongs to one pixel.
NOISE_RADIUS = 2
# Half the side of the window in which a layer must be black for its middle to stay black.
DARK_RADIUS = 4
# No layer is known better than this part of the brightness around; and none is off by much more
# than all it has: what is taken away at the rim of a lamp says nothing of the dark beside it.
LEAST_RELATIVE_ERROR = 0.03
MOST_RELATIVE_ERROR = 1.0
# How strongly values are kept above 0: one that wants to be 0 becomes a hundredth of its error.
BARRIER = 1e-4
# What a sum may be off, as a part of its parts: about the rounding of 32-bit floats.
TOLERANCE = 1e-7
MAX_STEPS = 40
# With a barrier like this the values hardly matter any more: what is still open stays so.
MAX_BARRIER = 1e6
# Pixels that are solved together: their small matrices stay in the processor's cache.
CHUNK = 4096


class Sum(NamedTuple):
    """One sum of layers, by name."""

    whole: str
    parts: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.whole} = {' + '.join(self.parts)}"


def parse_sums(text: str) -> list[Sum]:
    """The sums that a file's header claims.

    Args:
        text: Its attribute `lightsieve/partitions`, a sum a line.

    Returns:
        Them; lines that are none are left out.

    Example:
        >>> parse_sums("RGBA = diffuse + specular")
        [Sum(whole='RGBA', parts=('diffuse', 'specular'))]
    """
    sides = (line.split(" = ") for line in text.splitlines())
    return [Sum(s[0], tuple(s[1].split(" + "))) for s in sides if len(s) == 2]


def rows_of(sums: Sequence[Sum], names: Sequence[str]) -> Array:
    """Sums as linear equations `matrix @ layers == 0`, a row each.

    Args:
        sums: Of layers that are all in `names`.
        names: The layers, in the order of the columns.

    Returns:
        Shape (sums, names).

    Example:
        >>> rows_of([Sum("a", ("b", "c"))], ["a", "b", "c"]).tolist()
        [[-1.0, 1.0, 1.0]]
    """
    column = {name: i for i, name in enumerate(names)}
    rows = np.zeros((len(sums), len(names)))
    for row, (whole, parts) in zip(rows, sums, strict=True):
        row[column[whole]] -= 1
        for part in parts:
            row[column[part]] += 1
    return rows


def equations(sums: Sequence[Sum], names: Sequence[str]) -> Array:
    """Sums as few equations as say the same: what `reconcile` takes.

    Args:
        sums: Of layers that are all in `names`.
        names: The layers, in the order of the columns.

    Returns:
        One row an equation, of full rank; no rows if there are no sums.

    Example:
        >>> equations([Sum("a", ("b", "c"))], ["a", "b", "c"]).tolist()
        [[1.0, -1.0, -1.0]]
    """
    kept: list[Array] = []
    for row in rows_of(sums, names):
        if np.linalg.matrix_rank(np.array([*kept, row])) > len(kept):
            kept.append(row)
    return _reduced(np.array(kept).reshape(len(kept), len(names)))


def _reduced(matrix: Array) -> Array:
    """The same equations, each of the greatest wholes in one of them alone (Gauss and Jordan).

    What two sums of the beauty have in common is much brighter than what they differ in; as long
    as it stood in both, too few digits would be left for the rest.
    """
    out, row = matrix.copy(), 0
    for column in np.argsort(-(matrix < 0).sum(axis=0), kind="stable"):
        if row == len(out):
            break
        best = row + int(np.argmax(np.abs(out[row:, column])))
        if abs(out[best, column]) < 0.5:
            continue
        out[[row, best]] = out[[best, row]]
        out[row] /= out[row, column]
        for other in range(len(out)):
            if other != row:
                out[other] -= out[other, column] * out[row]
        row += 1
    return np.asarray(np.round(out, 9) + 0.0)


def box_mean(picture: npt.NDArray[np.floating], radius: int) -> Array:
    """The mean over a square around each pixel; the picture is mirrored at its border.

    Args:
        picture: Shape (height, width, ...).
        radius: Half the side of the square without its middle [pixels].

    Returns:
        The same shape.

    Example:
        >>> float(box_mean(np.eye(3), 1)[1, 1].round(3))
        0.333
    """
    out = np.asarray(picture, dtype=np.float64)
    for axis in (0, 1):
        pad = [(0, 0)] * out.ndim
        pad[axis] = (radius, radius)
        padded = np.pad(out, pad, mode="symmetric")
        total, step = np.moveaxis(padded, axis, 0), 1
        # A sum of 25 neighbours is one of 5 sums of 5.
        for n_terms in _factors(2 * radius + 1):
            n = len(total) - (n_terms - 1) * step
            total = sum((total[i * step :][:n] for i in range(1, n_terms)), start=total[:n])
            step *= n_terms
        out = np.moveaxis(total, 0, axis) / (2 * radius + 1)
    return out


def _factors(number: int) -> list[int]:
    """Its prime factors, rising."""
    out, factor = [], 2
    while number > 1:
        while number % factor == 0:
            out.append(factor)
            number //= factor
        factor += 1
    return out


def squared_error(noisy: npt.NDArray[np.floating], denoised: npt.NDArray[np.floating]) -> Array:
    """How far a denoised layer may be off, squared, from what the denoiser took away.

    Noise that was taken away averages out among neighbours; detail that was taken away does not.

    Args:
        noisy: Shape (height, width, ...), linear light.
        denoised: The same picture, denoised.

    Returns:
        The same shape; 0 only where the noisy layer is black all around.

    Example:
        >>> float(squared_error(np.ones((8, 8)), np.ones((8, 8)))[0, 0].round(9))
        0.0009
    """
    removed = box_mean(np.asarray(noisy, np.float64) - denoised, NOISE_RADIUS)
    brightness = np.abs(noisy)
    level = box_mean(brightness, ERROR_RADIUS)
    error = box_mean(removed**2, ERROR_RADIUS)
    most = (MOST_RELATIVE_ERROR * np.asarray(denoised, np.float64)) ** 2
    # Half of the harmonic mean: like the smaller of the two, without a step between them.
    error *= np.divide(most, error + most, out=np.zeros_like(error), where=most > 0)
    error += (LEAST_RELATIVE_ERROR * level) ** 2
    error[box_mean(brightness, DARK_RADIUS) == 0] = 0
    return error


def without_light(errors: Array, matrix: Array) -> npt.NDArray[np.bool_]:
    """Which values must be 0 if those of error 0 are.

    A whole whose parts are all 0 is 0, and so are the parts of a whole that is.

    Args:
        errors: Shape (layers, pixels).
        matrix: Shape (equations, layers).

    Returns:
        The shape of `errors`.

    Example:
        >>> sums = equations([Sum("a", ("b", "c"))], ["a", "b", "c"])
        >>> without_light(np.array([[1.0], [0.0], [0.0]]), sums).ravel().tolist()
        [True, True, True]
    """
    dark = errors <= 0
    n_before = -1
    while n_before != (n_before := int(dark.sum())):
        for row in matrix:
            for side in (row > 0, row < 0):
                # One side of the equation is 0, so the other is: nothing is negative.
                none_lit = dark[side].all(axis=0)
                dark[row != 0] |= none_lit
    return dark


def reconcile(values: Array, errors: Array, matrix: Array) -> Array:
    """The nearest values above 0 for which every equation holds.

    Minimises `sum((x - values)**2 / (2 * errors) - BARRIER * log(x))` over all x with
    `matrix @ x == 0`, for each column by itself.

    Args:
        values: Shape (layers, pixels), not negative.
        errors: Squared, the same shape; 0 where there is no light.
        matrix: Shape (equations, layers), as `equations` gives it.

    Returns:
        The same shape as `values`, not negative.

    Source:
        Without the logarithm it is the generalised least squares of reconciled forecasts
        (Wickramasuriya, Athanasopoulos, Hyndman, "Optimal Forecast Reconciliation for Hierarchical
        and Grouped Time Series Through Trace Minimization", JASA 2019). The logarithm is the
        barrier of interior point methods (Boyd and Vandenberghe, "Convex Optimization", 11.2).

    Example:
        >>> sums = equations([Sum("a", ("b", "c"))], ["a", "b", "c"])
        >>> reconcile(np.array([[3.0], [1.0], [1.0]]), np.ones((3, 1)), sums).ravel().round(3)
        array([2.667, 1.333, 1.333])
    """
    dark = without_light(errors, matrix)
    out, errors = np.where(dark, 0, values), np.where(dark, 0, errors)
    for begin in range(0, out.shape[1] if len(matrix) else 0, CHUNK):
        some = slice(begin, begin + CHUNK)
        # In units of the brightest layer of a pixel: the numbers below are far from any limit.
        scale = out[:, some].max(axis=0)
        scale[scale == 0] = 1
        out[:, some] = scale * _reconciled(
            out[:, some] / scale, errors[:, some] / scale**2, matrix
        )
    return out


def without_leftovers(x: Array, rows: Array) -> Array:
    """Makes light black that is too faint beside the rest of its pixel to have been added up.

    Args:
        x: Layers, shape (layers, pixels), not negative.
        rows: All sums, as `rows_of` gives them.

    Returns:
        The same shape; every sum holds.

    Example:
        >>> rows = rows_of([Sum("a", ("b", "c"))], ["a", "b", "c"])
        >>> without_leftovers(np.array([[3.0, 2.1], [1.0, 1.0], [2.0, 1.0]]), rows).tolist()
        [[3.0, 0.0], [1.0, 0.0], [2.0, 0.0]]
    """
    out = x.copy()
    while (off := np.abs(rows @ out) > 10 * TOLERANCE * (np.abs(rows) @ out)).any():
        out[np.abs(rows).T @ off > 0] = 0
    return out


def _reconciled(values: Array, errors: Array, matrix: Array) -> Array:
    """`reconcile` for a few thousand pixels."""
    out = values.copy()
    todo = np.arange(values.shape[1])
    barrier = BARRIER
    while todo.size and barrier <= MAX_BARRIER:
        multipliers = np.zeros((len(matrix), todo.size))
        for _ in range(MAX_STEPS):
            x, slope = _at(values[:, todo], errors[:, todo], matrix, multipliers, barrier)
            out[:, todo] = x
            off = np.abs(matrix @ x) > TOLERANCE * (np.abs(matrix) @ x)
            left = off.any(axis=0)
            if not left.any():
                return out
            todo, x, slope = todo[left], x[:, left], slope[:, left]
            multipliers = multipliers[:, left] + _newton_step(x, slope, matrix)
        # A higher barrier is a smoother problem: Newton's method cannot miss its answer.
        barrier *= 100
    return out


def _at(
    values: Array, errors: Array, matrix: Array, multipliers: Array, barrier: float
) -> tuple[Array, Array]:
    """The values that belong to some multipliers, and how they grow with `matrix.T @ multipliers`.

    The root above 0 of x**2 - y x - barrier * errors = 0; y is the answer without a barrier.
    """
    y = values + errors * (matrix.T @ multipliers)
    root = np.sqrt(y * y + 4 * barrier * errors)
    # Of the two ways to write the root the one in which nothing cancels.
    far = np.where(root > 0, root + np.abs(y), 1)
    x: Array = np.where(y >= 0, far / 2, 2 * barrier * errors / far)
    x[errors == 0] = 0
    slope: Array = errors * np.divide(x, root, out=np.zeros_like(x), where=root > 0)
    return x, slope


def _newton_step(x: Array, slope: Array, matrix: Array) -> Array:
    """What to add to the multipliers so that all equations would hold if slopes stayed."""
    n = len(matrix)
    products = (matrix[:, None] * matrix[None]).reshape(n * n, -1)
    system = (products @ slope).T.reshape(-1, n, n)
    # Rows are brought to one size: layers may be a million times fainter than others.
    size = np.sqrt(np.maximum(system.diagonal(axis1=1, axis2=2), np.finfo(np.float64).tiny))
    system = system / (size[:, :, None] * size[:, None]) + 1e-13 * np.eye(n)
    steps = np.linalg.solve(system, ((matrix @ x).T / size)[..., None])[..., 0] / size
    out: Array = -steps.T
    return out
