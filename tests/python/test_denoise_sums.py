"""Layers brought back to where they add up: the maths, without a denoiser."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lightsieve.denoise_sums import (
    LEAST_RELATIVE_ERROR,
    Sum,
    box_mean,
    equations,
    parse_sums,
    reconcile,
    rows_of,
    squared_error,
    without_leftovers,
    without_light,
)

Array = npt.NDArray[np.float64]

# Three ways to part the beauty, two levels deep: what header lines of real files look like.
SUMS = parse_sums(
    "RGBA = direct + indirect + emission\n"
    "RGBA = diffuse + specular + emission\n"
    "RGBA = RGBA_key + RGBA_default\n"
    "RGBA = diffuse_direct + diffuse_indirect + specular_direct + specular_indirect + emission\n"
    "diffuse = diffuse_direct + diffuse_indirect\n"
    "specular = specular_direct + specular_indirect"
)
ATOMS = 10
NAMES = [
    "RGBA",
    "direct",
    "indirect",
    "emission",
    "diffuse",
    "specular",
    "RGBA_key",
    "RGBA_default",
    "diffuse_direct",
    "diffuse_indirect",
    "specular_direct",
    "specular_indirect",
]
# Disjoint sets of paths (columns): diffuse and specular, direct and indirect, key or not, emission
# in no group. Which layers each belongs to.
MEMBERS = np.array(
    [
        [1, 1, 1, 1, 1, 1, 1, 1, 1, 1],
        [1, 1, 0, 0, 1, 1, 0, 0, 0, 0],
        [0, 0, 1, 1, 0, 0, 1, 1, 0, 0],
        [0, 0, 0, 0, 0, 0, 0, 0, 1, 1],
        [1, 1, 1, 1, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 0, 1, 1, 1, 1, 0, 0],
        [1, 0, 1, 0, 1, 0, 1, 0, 0, 0],
        [0, 1, 0, 1, 0, 1, 0, 1, 1, 1],
        [1, 1, 0, 0, 0, 0, 0, 0, 0, 0],
        [0, 0, 1, 1, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 0, 1, 1, 0, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 1, 1, 0, 0],
    ],
    dtype=float,
)
MATRIX = equations(SUMS, NAMES)


def worst_part(x: Array, matrix: Array = MATRIX) -> float:
    """The largest residual of a sum, as a part of what is added up."""
    size = np.abs(matrix) @ np.abs(x)
    return float((np.abs(matrix @ x) / np.maximum(size, 1e-300)).max())


def test_lines_of_the_header_are_read() -> None:
    assert parse_sums("a = b + c\nno sum\n\nd = e") == [Sum("a", ("b", "c")), Sum("d", ("e",))]
    assert str(Sum("a", ("b", "c"))) == "a = b + c"


def test_sums_that_follow_from_others_are_no_equations() -> None:
    assert MATRIX.shape == (5, 12)
    assert np.abs(MATRIX @ MEMBERS).max() == 0
    assert equations([], ["a"]).shape == (0, 1)


def test_box_mean_keeps_what_is_even_and_mirrors_the_border() -> None:
    assert box_mean(np.full((5, 4, 3), 2.0), 2) == pytest.approx(2)
    row = np.array([[1.0, 2, 3, 4]])
    assert box_mean(row, 1)[0].tolist() == pytest.approx([4 / 3, 2, 3, 11 / 3])


@pytest.mark.parametrize("radius", [0, 1, 4, 7, 12])
def test_box_mean_is_the_mean_of_a_square(radius: int) -> None:
    picture = np.random.default_rng(3).random((40, 30, 2))
    around = picture[20 - radius : 21 + radius, 15 - radius : 16 + radius]
    assert box_mean(picture, radius)[20, 15] == pytest.approx(around.mean(axis=(0, 1)))


def test_noise_that_was_taken_away_counts_less_than_detail() -> None:
    """Equal squares were taken away; only those that neighbours have in common are an error."""
    rng = np.random.default_rng(1)
    noise = rng.normal(0, 0.5, (64, 64))
    detail = np.where((np.arange(64) // 16) % 2, 0.5, -0.5)[None, :] * np.ones((64, 1))
    ones = np.ones((64, 64))
    known = LEAST_RELATIVE_ERROR**2
    of_noise = squared_error(ones + noise, ones).mean() - known
    of_detail = squared_error(ones + detail, ones).mean() - known
    assert of_noise == pytest.approx(0.5**2 / 25, rel=0.1)
    assert of_detail > 10 * of_noise


def test_an_error_is_none_only_where_there_is_no_light_around() -> None:
    noisy = np.zeros((32, 32, 3))
    noisy[3, 4, 1] = 1e-6
    error = squared_error(noisy, np.full_like(noisy, 1e-9))
    assert (error[:8, :9, 1] > 0).all()
    assert (error[20:, 20:, 1] < 1e-17).all()
    assert squared_error(np.ones((9, 9)), np.ones((9, 9)))[4, 4] == LEAST_RELATIVE_ERROR**2


def test_darkness_spreads_through_sums() -> None:
    errors = np.ones((len(NAMES), 2))
    errors[[NAMES.index("diffuse_direct"), NAMES.index("diffuse_indirect")], 0] = 0
    errors[NAMES.index("RGBA"), 1] = 0
    dark = without_light(errors, MATRIX)
    assert {n for n, d in zip(NAMES, dark[:, 0], strict=True) if d} == {
        "diffuse",
        "diffuse_direct",
        "diffuse_indirect",
    }
    assert dark[:, 1].all()


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    seed=st.integers(0, 2**32 - 1),
    spread=st.floats(0, 12),
    noise=st.floats(0, 3),
    sparsity=st.floats(0, 0.95),
)
def test_all_sums_hold_and_nothing_is_negative(
    seed: int, spread: float, noise: float, sparsity: float
) -> None:
    """Whatever the layers are: of like or unlike brightness, black in part, far off or not."""
    rng = np.random.default_rng(seed)
    atoms = 10 ** rng.uniform(-spread, 0, (ATOMS, 200)) * (rng.random((ATOMS, 200)) > sparsity)
    truth = MEMBERS @ atoms
    values = truth * np.exp(noise * rng.normal(size=truth.shape))
    errors = (truth * rng.uniform(1e-3, 1 + noise, truth.shape)) ** 2
    x = reconcile(values, errors, MATRIX)
    assert (x >= 0).all()
    assert (x[truth == 0] == 0).all()
    assert worst_part(x) <= 1.01e-7
    assert worst_part(x.astype(np.float32).astype(float)) < 1e-6


@settings(max_examples=30, deadline=None, derandomize=True)
@given(seed=st.integers(0, 2**32 - 1))
def test_layers_come_nearer_to_the_truth(seed: int) -> None:
    """Pythagoras: measured in units of the errors, no pixel's distance to the truth grows."""
    rng = np.random.default_rng(seed)
    truth = MEMBERS @ rng.uniform(1, 2, (ATOMS, 300))
    sigma = truth * rng.uniform(0.01, 0.1, truth.shape)
    values = np.maximum(truth + sigma * rng.normal(size=truth.shape), 0)
    x = reconcile(values, sigma**2, MATRIX)
    before = (((values - truth) / sigma) ** 2).sum(axis=0)
    after = (((x - truth) / sigma) ** 2).sum(axis=0)
    assert (after <= before * 1.01 + 1e-3).all()
    # Five equations take five of twelve degrees of freedom away.
    assert after.mean() == pytest.approx(12 - 5, rel=0.15)


def test_the_answer_is_the_one_of_least_squares_where_no_layer_is_near_black() -> None:
    rng = np.random.default_rng(3)
    values = MEMBERS @ rng.uniform(5, 6, (ATOMS, 50)) + rng.normal(0, 0.1, (12, 50))
    errors = rng.uniform(0.01, 0.02, values.shape)
    x = reconcile(values, errors, MATRIX)
    for p in range(50):
        v = np.diag(errors[:, p])
        gain = v @ MATRIX.T @ np.linalg.inv(MATRIX @ v @ MATRIX.T)
        assert x[:, p] == pytest.approx(values[:, p] - gain @ MATRIX @ values[:, p], rel=1e-5)


def test_what_adds_up_already_stays() -> None:
    rng = np.random.default_rng(4)
    truth = MEMBERS @ rng.uniform(1, 2, (ATOMS, 100))
    assert reconcile(truth, (0.1 * truth) ** 2, MATRIX) == pytest.approx(truth, rel=1e-5)


def test_a_layer_that_is_sure_moves_the_least() -> None:
    sums = equations([Sum("a", ("b", "c"))], ["a", "b", "c"])
    x = reconcile(np.array([[1.0], [1.0], [1.0]]), np.array([[1e-6], [1e-2], [1e-2]]), sums)
    assert x.ravel() == pytest.approx([1, 0.5, 0.5], abs=1e-3)


def test_a_part_that_would_be_negative_is_black_almost() -> None:
    sums = equations([Sum("a", ("b", "c"))], ["a", "b", "c"])
    x = reconcile(np.array([[1.0], [3.0], [0.01]]), np.full((3, 1), 0.01), sums)
    assert x[1, 0] == pytest.approx(2, rel=1e-2)
    assert 0 < x[2, 0] < 0.01
    assert worst_part(x, sums) <= 1e-7


def test_no_equations_change_nothing() -> None:
    values = np.array([[1.0, 2.0]])
    assert (reconcile(values, np.ones((1, 2)), np.zeros((0, 1))) == values).all()


def test_sums_that_contradict_what_is_dark_end_all_the_same() -> None:
    """`a = b` and `a = c` where c is black and b is not: nothing above 0 fulfils that."""
    sums = equations([Sum("a", ("b",)), Sum("a", ("c",))], ["a", "b", "c"])
    x = reconcile(np.array([[1.0], [1.0], [0.0]]), np.array([[1.0], [1.0], [0.0]]), sums)
    assert (x == 0).all()


def test_faint_layers_beside_a_lamp_add_up_or_are_black() -> None:
    """A lamp in the pixel leaves few digits for layers that are a billion times fainter."""
    rng = np.random.default_rng(5)
    atoms = 10 ** rng.uniform(-10, -8, (ATOMS, 3000))
    atoms[8:] = rng.uniform(0.5, 1, (2, 3000))
    truth = MEMBERS @ atoms
    values = truth * np.exp(0.3 * rng.normal(size=truth.shape))
    rows = rows_of(SUMS, NAMES)
    x = without_leftovers(reconcile(values, (0.3 * truth) ** 2, MATRIX), rows)
    assert worst_part(x, rows) <= 1e-6
    assert (x == 0).any(axis=0).mean() < 0.05
    assert (x[NAMES.index("RGBA")] > 0.5).all()
