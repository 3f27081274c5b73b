"""`render --tev`: the picture arrives in a viewer as the file holds it, whatever becomes of it.

The server here reads the protocol as tev's own reader does (github.com/Tom94/tev, Ipc.h): packets
of a length that counts itself, a type, and fields.
"""

from __future__ import annotations

import shutil
import socket
import struct
import threading
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import lightsieve
from tests.conftest import ROOT, Run

FAST = ("--spp", "2", "--size", "40x24", "--set", "options.bucket_size=16")
CREATE_IMAGE, UPDATE_IMAGE = 4, 6


class Fields:
    """The fields of a packet, one after the other."""

    def __init__(self, packet: bytes) -> None:
        self.rest = packet

    def take(self, code: str) -> int:
        """A number, by its letter in `struct`."""
        size = struct.calcsize(code)
        (value,) = struct.unpack("<" + code, self.rest[:size])
        self.rest = self.rest[size:]
        return int(value)

    def text(self) -> str:
        """A text that ends with a zero byte."""
        text, self.rest = self.rest.split(b"\0", 1)
        return text.decode()

    def texts(self) -> list[str]:
        """So many texts as the number before them says."""
        return [self.text() for _ in range(self.take("i"))]


class Viewer:
    """Listens, gathers one picture; hangs up after some packets if asked to."""

    def __init__(self, n_packets: int | None = None) -> None:
        self.name = ""
        self.channels: dict[str, npt.NDArray[np.float32]] = {}
        self.n_updates = 0
        self._n_packets = n_packets
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.address = f"127.0.0.1:{self._listener.getsockname()[1]}"
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        connection, _ = self._listener.accept()
        with connection, connection.makefile("rb") as stream:
            n = 0
            while (self._n_packets is None or n < self._n_packets) and (head := stream.read(4)):
                size = int.from_bytes(head, "little")
                self._take(stream.read(size - 4))
                n += 1
        self._listener.close()

    def _take(self, packet: bytes) -> None:
        fields = Fields(packet)
        kind, _focus, name = fields.take("b"), fields.take("b"), fields.text()
        if kind == CREATE_IMAGE:
            self.name = name
            width, height = fields.take("i"), fields.take("i")
            missing = np.full((height, width), np.nan, np.float32)
            self.channels = {channel: missing.copy() for channel in fields.texts()}
            return
        assert (kind, name) == (UPDATE_IMAGE, self.name)
        channels = fields.texts()
        x, y, width, height = (fields.take("i") for _ in range(4))
        offsets = [fields.take("q") for _ in channels]
        strides = [fields.take("q") for _ in channels]
        values = np.frombuffer(fields.rest, "<f4")
        n = width * height
        for channel, offset, stride in zip(channels, offsets, strides, strict=True):
            part = values[offset : offset + (n - 1) * stride + 1 : stride].reshape(height, width)
            self.channels[channel][y : y + height, x : x + width] = part
        self.n_updates += 1

    def done(self) -> None:
        """Waits for the end of the connection."""
        self._thread.join(60)
        assert not self._thread.is_alive()


@pytest.fixture
def still(tmp_path: Path) -> Path:
    return Path(shutil.copy(ROOT / "tests/scenes/still.ass", tmp_path))


def test_the_viewer_gets_what_the_file_holds(run: Run, still: Path, tmp_path: Path) -> None:
    viewer = Viewer()
    aovs = ("--aov", "diffuse RGB", "--aov", "Z FLOAT", "--rendering-space", "lin_srgb")
    shown = (
        "--tev",
        viewer.address,
        "--tev-aov",
        "RGBA",
        "--tev-aov",
        "diffuse",
        "--tev-aov",
        "Z",
    )
    done = run("render", still.name, *FAST, *aovs, *shown)
    assert done.code == 0, done.err
    assert done.err == ""
    viewer.done()
    assert viewer.name == "still.exr"
    assert viewer.n_updates == 3 * 2, "one for each bucket"
    names = ["R", "G", "B", "A", "diffuse.R", "diffuse.G", "diffuse.B", "Z"]
    assert list(viewer.channels) == names
    frame = lightsieve.exr.read(tmp_path / "still.exr")
    file = np.concatenate([frame.layer("RGBA"), frame.layer("diffuse"), frame.layer("Z")], axis=2)
    for i, name in enumerate(names):
        np.testing.assert_array_equal(viewer.channels[name], file[:, :, i], name)


def test_colours_come_as_the_viewer_takes_them(run: Run, still: Path, tmp_path: Path) -> None:
    viewer = Viewer()
    assert run("render", still.name, *FAST, "--tev", viewer.address).code == 0
    viewer.done()
    assert list(viewer.channels) == ["R", "G", "B", "A"]
    file = lightsieve.exr.read(tmp_path / "still.exr").layer("RGBA")
    # ACEScg to linear Rec. 709 with Bradford adaptation (ACES TB-2014-012, inverse).
    to_rec709 = np.array(
        [
            [1.70505, -0.62179, -0.08326],
            [-0.13026, 1.14080, -0.01055],
            [-0.02400, -0.12897, 1.15297],
        ]
    )
    shown = np.stack([viewer.channels[c] for c in "RGB"], axis=2)
    np.testing.assert_allclose(shown, file[:, :, :3] @ to_rec709.T, rtol=1e-3, atol=1e-4)
    np.testing.assert_array_equal(viewer.channels["A"], file[:, :, 3])


def test_a_region_is_the_whole_picture_of_the_viewer(run: Run, still: Path) -> None:
    viewer = Viewer()
    region = ("--region", "8,4,27,15", "--tev", viewer.address, "--tev-aov", "*")
    assert run("render", still.name, *FAST, *region).code == 0
    viewer.done()
    assert viewer.channels["R"].shape == (12, 20)
    assert np.isfinite(viewer.channels["R"]).all()


def test_nobody_there_is_a_warning_and_the_render_goes_on(run: Run, still: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as closed:
        address = f"127.0.0.1:{closed.getsockname()[1]}"
    done = run("render", still.name, *FAST, "--tev", address)
    assert done.code == 0
    assert f"warning[viewer-lost]: the viewer at {address} cannot be reached" in done.err
    assert "start tev, or check host and port; the render goes on without it" in done.err
    assert "wrote still.exr" in done.out


def test_a_viewer_that_goes_away_is_a_warning(run: Run, still: Path) -> None:
    viewer = Viewer(n_packets=1)
    big = ("--spp", "1", "--size", "1500x1000", "--set", "options.bucket_size=64")
    done = run("render", still.name, *big, "--tev", viewer.address)
    viewer.done()
    assert done.code == 0
    assert "warning[viewer-lost]" in done.err
    assert "wrote still.exr" in done.out


def test_what_cannot_be_meant_is_an_error_before_the_first_ray(
    run: Run, still: Path, tmp_path: Path
) -> None:
    nowhere = run("render", still.name, *FAST, "--tev", "somewhere")
    assert nowhere.code == 1
    assert "error[invalid-value]" in nowhere.err
    assert "write HOST:PORT" in nowhere.err
    nothing = run("render", still.name, *FAST, "--tev", "localhost:1", "--tev-aov", "RGBa")
    assert nothing.code == 1
    assert "error[unknown-layer]" in nothing.err
    assert 'did you mean "RGBA"?' in nothing.err
    assert not (tmp_path / "still.exr").exists()
