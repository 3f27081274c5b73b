"""`lightsieve check`."""

from __future__ import annotations

from pathlib import Path

from lightsieve.cli import check
from tests.conftest import ROOT, Run

STILL = ROOT / "tests/scenes/still.ass"


def test_summary_of_a_good_scene(run: Run, tmp_path: Path) -> None:
    done = run("check", STILL)
    assert done.code == 0
    assert done.err == ""
    assert "64 x 48, 4 samples a pixel" in done.out
    assert "2 triangles, 1 sphere" in done.out
    assert "groups: key, default" in done.out
    assert "still.exr: RGBA" in done.out
    assert done.out.endswith("no errors, no warnings, no lints\n")
    assert list(tmp_path.iterdir()) == []


def test_proved_partitions_are_named(run: Run, tmp_path: Path) -> None:
    scene = tmp_path / "sums.ass"
    outputs = ["RGBA RGBA", "diffuse RGB", "diffuse_direct RGB", "diffuse_indirect RGB"]
    strings = " ".join(f'"{output} filter driver"' for output in outputs)
    scene.write_text(
        STILL.read_text().replace(
            'camera "cam" }',
            f'camera "cam" outputs 4 1 STRING {strings} }}\n'
            'driver_exr { name driver filename "sums.exr" }\n'
            "gaussian_filter { name filter }",
        )
    )
    done = run("check", scene, "--json")
    assert done.code == 0, done.out
    assert done.json["summary"]["partitions"] == ["diffuse = diffuse_direct + diffuse_indirect"]


def test_json_keys_are_the_documented_ones(run: Run) -> None:
    document = run("check", STILL, "--json").json
    assert list(document) == list(check.JSON)
    assert document["ok"] is True
    for key in document["summary"]:
        assert f"`{key}`" in check.JSON["summary"]
    for key in document["summary"]["files"][0]["layers"][0]:
        assert f"`{key}`" in check.JSON["summary"]


def test_errors_have_a_place_in_json(run: Run) -> None:
    done = run("check", ROOT / "tests/broken/unknown_node.ass", "--strict", "--json")
    assert done.code == 1
    assert done.json["ok"] is False
    codes = {item["code"]: item for item in done.json["diagnostics"]}
    assert codes["unknown-node"]["severity"] == "error"
    assert (codes["unknown-node"]["line"], codes["unknown-node"]["column"]) == (8, 1)
    assert codes["unknown-node"]["file"].endswith("unknown_node.ass")
    assert "lambert" in codes["unknown-node"]["hint"]


def test_missing_scene(run: Run) -> None:
    done = run("check", "nowhere.ass", "--json")
    assert done.code == 1
    assert [item["code"] for item in done.json["diagnostics"]] == ["file-not-found"]
    assert done.json["summary"] is None
