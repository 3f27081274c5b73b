"""`lightsieve lpe export`."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from lightsieve.cli import lpe_export
from tests.conftest import ROOT, Run


def test_export_writes_a_header(run: Run, tmp_path: Path) -> None:
    done = run("lpe", "export", "diffuse", "specular", "-o", "sub/aovs.h")
    assert done.code == 0, done.err
    assert done.out.startswith("wrote sub/aovs.h: 4 states of ")
    assert "static const uint32_t aovs_table[] = {" in (tmp_path / "sub/aovs.h").read_text()


def test_export_as_json(run: Run, tmp_path: Path) -> None:
    document = run("lpe", "export", "C<RD>L", "-o", "table.npy", "--json").json
    assert list(document) == list(lpe_export.JSON)
    assert np.load(tmp_path / "table.npy").shape == (document["states"], document["stride"])
    assert document["events"]["RD"] != document["events"]["RS"]


def test_export_knows_a_scenes_events(run: Run) -> None:
    scene = ROOT / "tests/scenes/still.ass"
    events = run("lpe", "export", "RGBA", "-o", "t.npz", "--scene", scene, "--json").json["events"]
    assert "L'key'" in events


def test_what_cannot_be_written_is_an_error(run: Run, tmp_path: Path) -> None:
    assert run("lpe", "export", "diffuse", "-o", "table.txt").code == 2
    (tmp_path / "folder").write_text("")
    done = run("lpe", "export", "diffuse", "-o", "folder/table.h")
    assert done.code == 1
    assert "error[file-unwritable]" in done.err
    assert run("lpe", "export", "C<RD", "-o", "table.h").code == 1
