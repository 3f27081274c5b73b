"""The Python package as its users see it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import lightsieve
from tests.conftest import ROOT

STILL = ROOT / "tests/scenes/still.ass"


@pytest.fixture(scope="module")
def frame() -> lightsieve.Frame:
    return lightsieve.render(
        STILL, spp=4, aovs=["diffuse", "N VECTOR", "ID UINT"], lpes={"rest": "C[^<RD>].*"}
    )


def test_render_gives_layers_as_arrays(frame: lightsieve.Frame) -> None:
    assert sorted(frame.layers()) == ["ID", "N", "RGBA", "diffuse", "rest"]
    assert (frame.width, frame.height, frame.samples) == (64, 48, 64 * 48 * 4)
    beauty = frame.layer("beauty")
    assert beauty.shape == (48, 64, 4)
    assert beauty.dtype == np.float32
    assert frame.layer("ID").dtype == np.uint32
    assert frame.info("rest").expression == "C[^<RD>].*"
    total = frame.layer("diffuse") + frame.layer("rest")
    scale = np.abs(frame.layer("diffuse")) + np.abs(frame.layer("rest"))
    assert np.all(np.abs(beauty[:, :, :3] - total) <= 1e-5 * scale)
    assert beauty[:, :, :3].max() > 0.1


def test_row_0_is_at_the_top(frame: lightsieve.Frame) -> None:
    alpha = frame.layer("RGBA")[:, :, 3]
    assert alpha[0].max() == 0, "above the ball is nothing"
    assert alpha[-1].min() > 0.9, "the floor is at the bottom"


def test_a_layer_is_a_view(frame: lightsieve.Frame) -> None:
    frame.layer("N")[0, 0, 0] = 42
    assert frame.layer("N")[0, 0, 0] == 42


def test_unknown_layer(frame: lightsieve.Frame) -> None:
    with pytest.raises(lightsieve.LightsieveError) as caught:
        frame.layer("difuse")
    assert caught.value.errors[0].code == "unknown-layer"
    assert caught.value.errors[0].hint == 'did you mean "diffuse"?'


def test_render_writes_nothing_unless_asked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    lightsieve.render(STILL, spp=1, size=(8, 6))
    assert list(tmp_path.iterdir()) == []
    frame = lightsieve.render(STILL, spp=1, size=(8, 6), output=tmp_path / "a.exr")
    assert frame.files == (str(tmp_path / "a.exr"),)
    read = lightsieve.exr.read(tmp_path / "a.exr")
    # The file holds what memory holds, up to the file's pixel type.
    np.testing.assert_allclose(read.layer("RGBA"), frame.layer("RGBA"), rtol=2**-10, atol=2**-14)


def test_settings_reach_the_renderer() -> None:
    frame = lightsieve.render(
        STILL,
        aa=1,
        size=(16, 12),
        region=(0, 6, 15, 11),
        threads=1,
        seed=3,
        camera="cam",
        set={"sun.intensity": 0, "key.color": (0, 0, 1), "ball.matte": False},
    )
    beauty = frame.layer("RGBA")
    assert beauty.shape == (6, 16, 4)
    assert frame.samples == 96
    # A blue light alone: in ACEScg, where nothing converts it.
    assert beauty[:, :, 2].max() > 0
    assert beauty[:, :, 0].max() < 1e-3 * beauty[:, :, 2].max()


def test_bad_input_raises_everything_at_once() -> None:
    with pytest.raises(lightsieve.LightsieveError) as caught:
        lightsieve.render(ROOT / "tests/broken/bad_expressions.ass")
    errors = caught.value.errors
    assert len(errors) >= 5
    assert errors[0].file is not None
    assert errors[0].file.endswith("bad_expressions.ass")
    assert errors[0].line == 7
    assert errors[0].rendered in str(caught.value)


def test_check_reports_without_raising() -> None:
    report = lightsieve.check(ROOT / "tests/broken/cyclic_links.ass")
    assert not report.ok
    assert report.summary is None
    assert {item.code for item in report.diagnostics} == {"cyclic-link"}
    assert report.diagnostics[0].notes[0].line == 9


def test_progress_is_called_and_may_raise() -> None:
    seen: list[int] = []
    lightsieve.render(STILL, spp=16, progress=lambda now: seen.append(now.samples_done))
    assert seen[-1] == 64 * 48 * 16
    assert seen == sorted(seen)

    def fail(_now: object) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        lightsieve.render(STILL, spp=100_000, progress=fail)


def test_other_threads_run_during_a_render() -> None:
    code = (
        "import threading, lightsieve, sys\n"
        "ticks = 0\n"
        "done = threading.Event()\n"
        "def count():\n"
        "    global ticks\n"
        "    while not done.wait(0.001): ticks += 1\n"
        "thread = threading.Thread(target=count); thread.start()\n"
        f"lightsieve.render({str(STILL)!r}, spp=256)\n"
        "done.set(); thread.join()\n"
        "print(ticks)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert int(done.stdout) > 5


def test_ctrl_c_raises_keyboard_interrupt() -> None:
    code = (
        "import os, signal, lightsieve\n"
        # A shell starts background jobs with the signal ignored; the test may run in one.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "def interrupt(now): os.kill(os.getpid(), signal.SIGINT)\n"
        "try:\n"
        f"    lightsieve.render({str(STILL)!r}, spp=100_000, progress=interrupt)\n"
        "except KeyboardInterrupt:\n"
        "    print('interrupted')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout == "interrupted\n"


def test_an_instruction_set_that_does_not_exist() -> None:
    (error,) = lightsieve.check(STILL, isa="avx9").diagnostics
    assert error.code == "unknown-choice"
    assert 'no instruction set is called "avx9"' in error.message
    assert "avx512" in error.hint


def test_lpe_module() -> None:
    lpe = lightsieve.lpe
    assert lpe.match("C<RD>.*", "C RD TS L'key'")
    assert not lpe.match(lpe.parse("C<RD>L"), "C RD RD L")
    assert lpe.parse("cDL").lints
    assert lpe.resolve("coat", "arnold7") == "C<RS'coat'>.*"
    with pytest.raises(lightsieve.LightsieveError) as caught:
        lpe.parse("C<RD")
    assert caught.value.errors[0].column == 2
    assert ["sheen" in names for names in lpe.additive_sets("arnold7")] == [False, True, True]


def test_unknown_names_of_the_package_are_attribute_errors() -> None:
    with pytest.raises(AttributeError, match="rendr"):
        lightsieve.rendr  # noqa: B018
    assert "render" in dir(lightsieve)
