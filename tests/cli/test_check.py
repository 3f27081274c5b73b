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


def with_outputs(folder: Path, outputs: list[str], expressions: list[str]) -> Path:
    """The still scene with these AOVs as RGB, and expressions `NAME EXPR`."""

    def strings(texts: list[str]) -> str:
        return f"{len(texts)} 1 STRING " + " ".join(f'"{text}"' for text in texts)

    scene = folder / "aovs.ass"
    options = f" outputs {strings([f'{name} RGB filter driver' for name in outputs])}"
    if expressions:
        options += f" light_path_expressions {strings(expressions)}"
    scene.write_text(
        STILL.read_text().replace('camera "cam" }', f'camera "cam"{options} }}')
        + '\ndriver_exr { name driver filename "aovs.exr" }\ngaussian_filter { name filter }\n'
    )
    return scene


def test_sums_are_found_among_custom_expressions(run: Run, tmp_path: Path) -> None:
    scene = with_outputs(
        tmp_path,
        ["RGBA", "seen", "bounced", "once", "more", "RGBA_*"],
        ["seen C[LOB]", "bounced C[DSV].*", "once C[DSV][LOB]", "more C[DSV][DSV].*"],
    )
    aovs = run("check", scene, "--json").json["aovs"]
    assert [(one["whole"], one["parts"]) for one in aovs["sums"]] == [
        ("RGBA", ["seen", "bounced"]),
        ("RGBA", ["RGBA_key", "RGBA_default"]),
        ("bounced", ["once", "more"]),
    ]
    assert all(one["everywhere"] for one in aovs["sums"])
    assert aovs["missing"] is None
    assert "adds up  RGBA = seen + bounced\n" in run("check", scene).out


def test_what_is_missing_comes_as_names_and_as_an_expression(run: Run, tmp_path: Path) -> None:
    scene = with_outputs(tmp_path, ["RGBA", "direct", "emission"], [])
    missing = run("check", scene, "--json").json["aovs"]["missing"]
    assert missing["parts"] == ["direct", "emission"]
    assert sorted(missing["builtins"]) == ["background", "indirect"]
    parts = [*missing["parts"], missing["expression"]]
    assert run("lpe", "partition", *parts).code == 0
    assert missing["example"]["text"] == "C B"


def test_what_adds_up_in_this_scene_only_says_so(run: Run, tmp_path: Path) -> None:
    scene = with_outputs(
        tmp_path,
        ["RGBA", "diffuse", "specular", "coat", "glass", "seen"],
        ["glass CT.*", "seen C[LOB]"],
    )
    (one,) = run("check", scene, "--json").json["aovs"]["sums"]
    assert one["everywhere"] is False
    assert one["lost_elsewhere"]["text"] == "C V L"
    assert "(here; elsewhere C V L would be lost)" in run("check", scene).out


def test_layers_that_overlap_cannot_be_added(run: Run, tmp_path: Path) -> None:
    scene = with_outputs(tmp_path, ["RGBA", "diffuse", "far"], ["far C.+[OB]"])
    (left,) = run("check", scene, "--json").json["aovs"]["missing"]["left_out"]
    assert {left["name"], left["overlaps"]} == {"diffuse", "far"}
    assert left["example"]["text"] == "C RD O"


def test_equal_contained_and_dead_aovs(run: Run, tmp_path: Path) -> None:
    scene = with_outputs(
        tmp_path,
        ["RGBA", "diffuse", "volume", "mirror"],
        ["mirror CSL", "matte C<RD>.*", "inner C<RD>.*<L.'key'>"],
    )
    aovs = run("check", scene, "--json").json["aovs"]
    assert aovs["equal"] == [["diffuse", "matte"]]
    assert sorted(aovs["contained"]) == [["inner", "diffuse"], ["inner", "matte"]]
    assert aovs["dead"] == ["volume"]
    out = run("check", scene).out
    assert "same     diffuse and matte take the same paths\n" in out
    assert "black    volume: this scene makes no such paths\n" in out


def test_layers_of_different_filters_do_not_add_up(run: Run, tmp_path: Path) -> None:
    scene = with_outputs(tmp_path, ["RGBA", "direct", "indirect", "emission", "background"], [])
    assert run("check", scene, "--json").json["aovs"]["sums"] != []
    text = scene.read_text().replace("direct RGB filter", "direct RGB other", 1)
    scene.write_text(text + "box_filter { name other }\n")
    assert run("check", scene, "--json").json["aovs"]["sums"] == []


def test_sums_of_custom_expressions_are_found_in_the_pixels(run: Run, tmp_path: Path) -> None:
    assert run("render", ROOT / "examples/aovs/blender_style.ass", "--spp", "1", "-q").code == 0
    done = run("exr", "verify", tmp_path / "blender_style.exr")
    assert done.code == 0
    assert done.out.startswith("adds up      RGBA = DiffDir + DiffInd + GlossDir + GlossInd + ")
