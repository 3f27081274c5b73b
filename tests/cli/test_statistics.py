"""What renders say of themselves: summary, statistics files, logs, forecasts and their limit."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

import lightsieve
from lightsieve.cli._progress import interval_s
from lightsieve.statistics import KEYS
from tests.conftest import ROOT, Run

FAST = ("--spp", "4", "--size", "32x24")


@pytest.fixture
def still(tmp_path: Path) -> Path:
    return Path(shutil.copy(ROOT / "tests/scenes/still.ass", tmp_path))


def renders(path: Path) -> list[str]:
    return list(json.loads(path.read_text()))


def test_the_summary_says_what_it_took(run: Run, still: Path) -> None:
    out = run("render", still.name, *FAST, "--aov", "diffuse RGB").out
    for line in (
        r"time: read \d+\.\d s, compile \d+\.\d s, textures .*, accel .*, render .*, write \d",
        r"rays: [\d,]+ \([\d,]+/s\): \w+ \d+%, ",
        r"memory: \d+ MiB at most; at the end other \d+ MiB, ",
        r"AOVs: 2 layers, \d+ states, 1 atom\n",
        r"noise left in a pixel, of the layer's level: ",
    ):
        assert re.search(line, out), f"{line}\n{out}"


def test_json_and_the_statistics_file_say_the_same(run: Run, still: Path, tmp_path: Path) -> None:
    document = run("render", still.name, *FAST, "--json", "--stats", "stats.json").json
    assert json.loads((tmp_path / "stats.json").read_text()) == {"render 0000": document}
    assert set(KEYS) < set(document)
    assert sum(document["rays_by_kind"].values()) == document["rays"] > 0
    assert document["rays_by_kind"]["camera"] >= document["samples"]
    assert list(document["times"]) == [
        *("read", "compile", "textures", "volumes", "accel", "render", "write")
    ]
    assert document["times"]["render"] == document["seconds"]
    memory, foretold = document["memory"], document["forecast"]["memory"]
    assert list(memory) == list(foretold)
    assert sum(memory.values()) == document["peak_memory"]
    assert 0 < memory["film"] <= foretold["film"]
    assert sum(foretold.values()) == document["forecast"]["total"]
    assert document["forecast"]["file_bytes"] == {"still.exr": 32 * 24 * 4 * 4}
    assert document["forecast"]["checkpoint_bytes"] > 0
    assert document["aovs"]["layers"] == 1
    assert document["warning_codes"] == {}


def test_the_forecast_is_near_what_the_process_takes(run: Run, still: Path) -> None:
    document = run("render", still.name, "--spp", "1", "--size", "1024x1024", "--json").json
    # What is foretold is the most that may be: textures and atoms may turn out to be fewer.
    assert document["peak_memory"] <= 1.1 * document["forecast"]["total"]
    assert document["peak_memory"] >= 0.3 * document["forecast"]["total"]


def test_rays_by_kind_do_not_depend_on_threads(run: Run, still: Path) -> None:
    one, two = (
        run("render", still.name, *FAST, "-t", n, "--json").json["rays_by_kind"] for n in "12"
    )
    assert one == two


def test_warnings_are_counted_by_code(run: Run, still: Path) -> None:
    more = "".join(f"sphere {{ name s{i} center 9 9 9 odd{i} 2 }}\n" for i in range(250))
    still.write_text(still.read_text() + more)
    done = run("render", still.name, *FAST, "--json")
    codes = done.json["warning_codes"]
    assert codes == {"unknown-param": 200, "other": 50}
    assert "warnings: unknown-param 200, other 50" in run("render", still.name, *FAST).out


def test_the_scene_says_where_statistics_go(run: Run, still: Path, tmp_path: Path) -> None:
    overwrite = ("--set", 'options.stats_file="s.json"')
    append = (*overwrite, "--set", 'options.stats_mode="append"')
    for options, count in ((append, 1), (append, 2), (overwrite, 1)):
        assert run("render", still.name, *FAST, *options).code == 0
        assert renders(tmp_path / "s.json") == [f"render {i:04}" for i in range(count)]


def test_a_statistics_file_that_cannot_be_is_an_error_only_if_asked_for(
    run: Run, still: Path, tmp_path: Path
) -> None:
    asked = run("render", still.name, *FAST, "--stats", "missing/s.json")
    assert asked.code == 1
    assert 'error[file-unwritable]: cannot write "missing/s.json"' in asked.err
    assert not (tmp_path / "still.exr").exists(), "before the first ray"
    of_scene = run("render", still.name, *FAST, "--set", 'options.stats_file="missing/s.json"')
    assert of_scene.code == 0
    assert 'warning: options.stats_file: cannot write "missing/s.json"' in of_scene.err
    options = ("options.stats_file=other.json", "options.stats_mode=append")
    for held in ('{"a": 1}', "[1]", "[[1]]", "null", "3", "[" * 100_000, "{", "\udcff"):
        (tmp_path / "other.json").write_text(held, errors="surrogateescape")
        foreign = run("render", still.name, *FAST, "--set", options[0], "--set", options[1])
        assert '"other.json" holds no statistics to go on with' in foreign.err, held[:9]
        assert foreign.code == 0, "the picture is there all the same"
        kept = (tmp_path / "other.json").read_bytes()
        assert kept == held.encode(errors="surrogateescape")


def test_python_writes_statistics_too(still: Path, tmp_path: Path) -> None:
    lightsieve.render(still, spp=1, size=(8, 6), stats=tmp_path / "s.json")
    assert renders(tmp_path / "s.json") == ["render 0000"]


def test_verbosity(run: Run, still: Path) -> None:
    still.write_text(still.read_text() + "\nsphere { name extra radiuss 2 }\n")

    def said(*options: str) -> tuple[str, str]:
        done = run("render", still.name, *FAST, *options)
        assert done.code == 0
        return done.out, done.err

    silent = ("", "")
    quiet = ("--set", "options.log_verbosity=0")
    assert said("-v", "0") == said("--quiet") == said(*quiet) == silent
    assert "unknown-param" in said(*quiet, "-v", "1")[1], "the command line wins"
    assert "memory: up to" not in said()[1]
    for everything in (("-v", "2"), ("--set", "options.log_verbosity=2")):
        out, err = said(*everything)
        assert re.search(r"^memory: up to \d+ MiB: .*film \d+ ", err, re.MULTILINE)
        assert re.search(r"^files: \d+ KiB a frame before compression; a check", err, re.MULTILINE)
        assert "wrote still.exr" in out


def test_only_so_many_warnings_are_printed(run: Run, still: Path) -> None:
    more = "".join(f"sphere {{ name s{i} center 9 9 9 odd{i} 2 }}\n" for i in range(5))
    still.write_text(still.read_text() + more)
    done = run("render", still.name, *FAST, "--set", "options.log_max_warnings=2")
    assert done.err.count("warning[") == 2
    assert "3 more warnings: options.log_max_warnings says how many are printed" in done.err


def test_the_log_file_gets_what_is_printed(run: Run, still: Path, tmp_path: Path) -> None:
    still.write_text(still.read_text() + "\nsphere { name extra radiuss 2 }\n")
    done = run("render", still.name, *FAST, "--set", "options.log_file=render.log")
    assert (tmp_path / "render.log").read_text() == done.err + done.out
    assert "warning[unknown-param]" in done.err
    assert "wrote still.exr" in done.out
    elsewhere = run("render", still.name, *FAST, "--set", "options.log_file=missing/a.log")
    assert elsewhere.code == 0
    assert 'warning: options.log_file: cannot write "missing/a.log"' in elsewhere.err


def test_too_little_memory_is_an_error_before_the_first_ray(
    run: Run, still: Path, tmp_path: Path
) -> None:
    for command in (("render", *FAST), ("check",)):
        name, *options = command
        refused = run(name, still.name, *options, "--max-memory", "20M")
        assert refused.code == 1
        assert re.search(
            r"error\[limit-memory\]: the render may take \d+ MiB of memory, more than the 20 MiB",
            refused.err,
        )
        assert "hint: most of it, " in refused.err
    assert not (tmp_path / "still.exr").exists()
    assert run("render", still.name, *FAST, "--max-memory", "1.5 TiB").code == 0
    assert run("render", still.name, *FAST, "--max-memory", "much").code == 2


def test_check_foretells(run: Run, still: Path) -> None:
    out = run("check", still.name).out
    assert re.search(r"^memory +up to \d+ MiB: ", out, re.MULTILINE)
    assert re.search(r"^files +48 KiB a frame before compression; a check", out, re.MULTILINE)
    forecast = run("check", still.name, "--json").json["summary"]["forecast"]
    assert forecast["file_bytes"] == {"still.exr": 64 * 48 * 4 * 4}
    of_render = run("render", still.name, "--spp", "1", "--json").json["forecast"]
    for kind, size in of_render["memory"].items():
        # What the process holds besides is never the same.
        assert kind == "other" or forecast["memory"][kind] == size
    assert forecast["checkpoint_bytes"] == of_render["checkpoint_bytes"] > 0


def test_a_log_has_fewer_lines_the_longer_it_takes() -> None:
    assert interval_s(0) == interval_s(60) == 5
    assert interval_s(600) == 30
    assert interval_s(86400) == 60
