"""`lightsieve denoise` and `lightsieve render --denoise`."""

from __future__ import annotations

from pathlib import Path

import pytest

from lightsieve.cli import denoise, render
from tests.conftest import ROOT, Run

STILL = ROOT / "tests/scenes/still.ass"
FAST = ("--spp", "1", "--size", "24x16", "--threads", "1")
AOVS = [
    word
    for name in ("diffuse RGB", "diffuse_direct RGB", "diffuse_indirect RGB", "Z FLOAT")
    for word in ("--aov", name)
]


def scene(folder: Path, outputs: str, nodes: str) -> str:
    """The still life with some outputs."""
    text = STILL.read_text().replace('camera "cam" }', f'camera "cam" outputs {outputs} }}')
    (folder / "scene.ass").write_text(f"{text}\nbox_filter {{ name box }}\n{nodes}\n")
    return "scene.ass"


@pytest.fixture
def frame(run: Run) -> str:
    done = run("render", STILL, *FAST, "-o", "frame.exr", *AOVS)
    assert done.code == 0, done.err
    return "frame.exr"


@pytest.fixture
def no_denoiser(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As if the optional package were not installed."""
    hidden = tmp_path / "hidden"
    hidden.mkdir()
    (hidden / "pyoidn.py").write_text("raise ImportError(\"No module named 'pyoidn'\")\n")
    monkeypatch.setenv("PYTHONPATH", str(hidden))


def test_a_file_beside_the_noisy_one_adds_up(run: Run, frame: str, tmp_path: Path) -> None:
    before = (tmp_path / frame).read_bytes()
    done = run("denoise", frame, "-t", "1")
    assert done.code == 0, done.err
    assert done.out == "wrote frame_denoised.exr: 4 layers denoised, 1 sum kept\n"
    assert done.err.endswith(
        "detail would be kept better by layers that the file lacks: "
        '--aov "albedo RGB" --aov "N VECTOR"\n'
    )
    assert (tmp_path / frame).read_bytes() == before
    verified = run("exr", "verify", "frame_denoised.exr")
    assert verified.code == 0, verified.out
    assert "adds up      diffuse = diffuse_direct + diffuse_indirect" in verified.out


def test_json_has_what_the_text_says(run: Run, frame: str) -> None:
    done = run("denoise", frame, "-t", "1", "-o", "clean.exr", "--quality", "fast", "--json")
    assert done.code == 0, done.err
    assert list(done.json) == list(denoise.JSON)
    assert done.json["denoised"] == "clean.exr"
    assert set(done.json["layers"]) == {"RGBA", "diffuse", "diffuse_direct", "diffuse_indirect"}
    assert done.json["kept"] == ["Z"]
    assert done.json["normal"] is None


def test_in_place_only_if_asked(run: Run, frame: str, tmp_path: Path) -> None:
    assert run("denoise", frame, "--in-place", "-o", "b.exr").code == 2
    done = run("denoise", frame, "-o", frame)
    assert done.code == 1
    assert "error[denoise]" in done.err
    assert "--in-place" in done.err
    done = run("denoise", frame, "-t", "1", "--in-place", "--quiet")
    assert (done.code, done.out, done.err) == (0, "", "")
    assert [p.name for p in tmp_path.iterdir()] == [frame]
    done = run("denoise", frame)
    assert done.code == 1
    assert "is denoised already" in done.err


def test_without_the_denoiser_nothing_is_rendered(
    run: Run, no_denoiser: None, tmp_path: Path
) -> None:
    done = run("render", STILL, *FAST, "-o", "a.exr", "--denoise")
    assert done.code == 1
    assert "error[denoiser-missing]" in done.err
    assert 'hint: pip install "lightsieve[denoise]"' in done.err
    assert not (tmp_path / "a.exr").exists()


def test_without_the_denoiser_everything_else_works(
    run: Run, no_denoiser: None, frame: str
) -> None:
    done = run("denoise", frame)
    assert done.code == 1
    assert "error[denoiser-missing]" in done.err


def test_a_render_is_denoised_to_files_beside_its_own(run: Run, tmp_path: Path) -> None:
    outputs = (
        '4 1 STRING "RGBA RGB box png" "RGBA RGBA box one" "N VECTOR box one" '
        '"diffuse RGB box two"'
    )
    nodes = """
    driver_png { name png filename "a.png" }
    driver_exr { name one filename "one.exr" }
    driver_exr { name two filename "two.exr" }
    """
    done = run("render", scene(tmp_path, outputs, nodes), *FAST, "--denoise", "--json")
    assert done.code == 0, done.err
    assert list(done.json) == list(render.JSON)
    assert done.json["files"] == ["a.png", "one.exr", "two.exr"]
    first, second = done.json["denoised"]
    assert list(first) == list(denoise.JSON)
    assert (first["file"], first["denoised"]) == ("one.exr", "one_denoised.exr")
    assert (first["albedo"], first["normal"]) == (["albedo"], "N")
    assert set(first["kept"]) == {"albedo", "N"}
    # The second file has no helpers: those of the first one serve.
    assert (second["denoised"], second["albedo"]) == ("two_denoised.exr", ["albedo"])
    info = run("exr", "info", "two_denoised.exr", "--json").json
    assert [layer["name"] for layer in info["layers"]] == ["diffuse"]


def test_a_render_without_anything_to_denoise_does_not_begin(run: Run, tmp_path: Path) -> None:
    name = scene(
        tmp_path, '1 1 STRING "RGBA RGB box png"', 'driver_png { name png filename "a.png" }'
    )
    done = run("render", name, *FAST, "--denoise")
    assert done.code == 1
    assert "error[" in done.err
    assert not (tmp_path / "a.png").exists()


def test_what_cannot_be_denoised_says_so_after_the_render(run: Run, tmp_path: Path) -> None:
    outputs = '2 1 STRING "RGBA RGBA box deep" "Z FLOAT box data"'
    nodes = """
    driver_deepexr { name deep filename "deep.exr" }
    driver_exr { name data filename "data.exr" }
    """
    done = run("render", scene(tmp_path, outputs, nodes), *FAST, "--denoise")
    assert done.code == 1
    assert "holds deep pixels" in done.err
    assert (tmp_path / "deep.exr").is_file()
    assert "wrote deep.exr" in done.out


def test_help_says_what_files_there_will_be(run: Run) -> None:
    assert "FILE_denoised.exr" in run("render", "--help").out
    assert "add up" in run("denoise", "--help").out
