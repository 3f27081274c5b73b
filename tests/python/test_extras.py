"""Colour, FLIP, contact sheets."""

from __future__ import annotations

import numpy as np
import pytest
from flip_evaluator import evaluate

from lightsieve.extras.colour import rec709_from_acescg, srgb_from_acescg
from lightsieve.extras.contact_sheet import make_tile
from lightsieve.extras.flip import flip, flip_map
from lightsieve.frame import Layer


def light(seed: int) -> np.ndarray:
    """A smooth picture with some noise, dark and bright."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[0:40, 0:60] / 40
    base = np.stack([x * y, 0.5 + 0.5 * np.sin(9 * x), y], axis=-1)
    return (base + rng.normal(0, 0.05, base.shape)).astype(np.float32)


def test_white_stays_white_and_primaries_are_those_of_aces() -> None:
    np.testing.assert_allclose(rec709_from_acescg(np.ones(3, np.float32)), 1, atol=2e-5)
    # AP1 red lies outside Rec. 709: more than all red, less than no green.
    red = rec709_from_acescg(np.array([1, 0, 0], np.float32))
    assert red[0] > 1
    assert red[1] < 0


def test_srgb_curve() -> None:
    grey = np.array([0.0, 0.002, 0.214, 1.0, 7.0], np.float32)[:, None] * np.ones(3, np.float32)
    expected = [0, 0.02584, 0.5, 1, 1]
    np.testing.assert_allclose(srgb_from_acescg(grey)[:, 0], expected, atol=1e-3)


@pytest.mark.parametrize("seed", [1, 2])
def test_flip_agrees_with_its_authors_program(seed: int) -> None:
    reference, test = light(seed), np.roll(light(seed + 10), 2, axis=1)
    shown = [np.ascontiguousarray(srgb_from_acescg(p)) for p in (reference, test)]
    theirs, mean, _ = evaluate(shown[0], shown[1], "LDR", applyMagma=False)
    linear = [np.clip(rec709_from_acescg(p), 0, 1) for p in (test, reference)]
    np.testing.assert_allclose(flip_map(*linear), theirs[:, :, 0], atol=1e-3)
    assert flip(test, reference) == pytest.approx(mean, abs=1e-4)


def layer(name: str, expression: str = "") -> Layer:
    return Layer(name, name, "RGB", expression, "", "gaussian_filter", 2)


def test_dark_light_is_brightened_and_the_label_says_so() -> None:
    pixels = np.full((4, 4, 3), 0.1, np.float32)
    tile = make_tile(layer("diffuse", "C<RD>.*"), pixels, 4)
    assert tile.note.startswith("+2 stops")
    beauty = make_tile(layer("RGBA", "C.*"), pixels, 4)
    assert beauty.note == "C.*"
    bright, dark = (np.asarray(t.picture).mean() for t in (tile, beauty))
    assert bright > dark


def test_black_light_and_flat_data_are_no_trouble() -> None:
    black = make_tile(layer("coat", "C<RS'coat'>.*"), np.zeros((4, 4, 3), np.float32), 4)
    assert black.note.startswith("black")
    flat = make_tile(layer("Z"), np.full((4, 4, 1), np.inf, np.float32), 4)
    assert flat.picture.size == (4, 4)
    vectors = make_tile(layer("uv"), np.ones((4, 4, 2), np.float32), 4)
    assert vectors.picture.mode == "RGB"
