"""Scenes, nodes, rendering and picture files. Private; use lightsieve."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy

import lightsieve.errors


version: str = '0.1.0'

def exit_3_on_bug() -> None:
    """
    Makes a crash or a broken assertion end the process with exit code 3. For programs, not for libraries.
    """

def nodes() -> list[dict[str, Any]]:
    """Every node type with its parameters and lobes, by name."""

class ExrLayer:
    """One layer of an EXR file."""

    @property
    def name(self) -> str:
        """`RGBA` for bare R, G, B, or what the header calls them."""

    @property
    def suffixes(self) -> list[str]:
        """`R`, `G`, ...; empty text for a channel that is the layer."""

    @property
    def type(self) -> str:
        """`half`, `float` or `uint`."""

    @property
    def source(self) -> str:
        """The AOV, before renaming; empty if the header does not say."""

    @property
    def filter(self) -> str:
        """Empty if the header does not say."""

    @property
    def filter_width(self) -> float:
        """[pixels]"""

    @property
    def expression(self) -> str:
        """Light path expression; empty if none."""

    @property
    def light_group(self) -> str:
        """Empty if none."""

    @property
    def camera(self) -> str:
        """That its output names; empty: the scene's."""

class ExrInfo:
    """The header and the layers of an EXR file."""

    @property
    def layers(self) -> list[ExrLayer]:
        """The unnamed one first, then by name."""

    @property
    def width(self) -> int:
        """Of the display window [pixels]."""

    @property
    def height(self) -> int:
        """Of the display window [pixels]."""

    @property
    def data_window(self) -> tuple[int, int, int, int]:
        """x, y, width and height, relative to the display window."""

    @property
    def tiled(self) -> bool:
        """Tiles, not scanlines."""

    @property
    def n_parts(self) -> int:
        """Parts of the file."""

    @property
    def n_channels(self) -> int:
        """Channels of all parts."""

    @property
    def compression(self) -> str:
        """As in driver_exr.compression."""

    @property
    def lossy(self) -> bool:
        """The compression changes values by more than sums of layers may be off."""

    @property
    def attributes(self) -> dict[str, int | float | str | list[float]]:
        """Header attributes of the first part."""

def exr_info(path: str) -> ExrInfo:
    """Reads a header."""

def exr_read(path: str) -> list[tuple[ExrLayer, numpy.ndarray]]:
    """
    Each layer with its pixels over the data window: shape (height, width, channels), row 0 at the top.
    """

def exr_rewrite(path: str, output: str, pixels: dict[str, numpy.ndarray], attributes: dict[str, str]) -> None:
    """
    Copies a file with other pixels in some layers: shape (height, width, channels) of the data window. All else stays bit for bit.
    """

class ExrSumCheck:
    """One sum that was checked."""

    @property
    def text(self) -> str:
        """`RGBA = diffuse + specular`"""

    @property
    def checked(self) -> bool:
        """False if it could not be: see `reason`."""

    @property
    def passed(self) -> bool:
        """No pixel is above its tolerance."""

    @property
    def reason(self) -> str:
        """Why it could not be checked."""

    @property
    def worst_x(self) -> int:
        """Pixel with the largest residual for its tolerance."""

    @property
    def worst_y(self) -> int:
        """Pixel with the largest residual for its tolerance."""

    @property
    def worst_channel(self) -> str:
        """`R`, `G` or `B`."""

    @property
    def whole(self) -> float:
        """The left side, there."""

    @property
    def sum(self) -> float:
        """The right side, there."""

    @property
    def residual(self) -> float:
        """Their difference."""

    @property
    def tolerance(self) -> float:
        """What is allowed there."""

    @property
    def n_failed(self) -> int:
        """Pixels above their tolerance."""

class ExrVerifyResult:
    """What `exr verify` found."""

    @property
    def checks(self) -> list[ExrSumCheck]:
        """One a sum."""

    @property
    def passed(self) -> bool:
        """Something was checked, and all of it passed."""

def exr_verify(path: str) -> ExrVerifyResult:
    """Re-checks the sums that the header names."""

class ExrLayerDiff:
    """How one layer of two files differs."""

    @property
    def name(self) -> str:
        """The layer."""

    @property
    def n_values(self) -> int:
        """Compared: pixels times channels."""

    @property
    def n_different(self) -> int:
        """Not the same value."""

    @property
    def n_nonfinite(self) -> int:
        """NaN or infinite in either file, left out of the figures."""

    @property
    def rmse(self) -> float:
        """Root of the mean squared difference."""

    @property
    def relative_mse(self) -> float:
        """Mean of (a-b)^2 / (b^2 + 0.01)."""

    @property
    def max_difference(self) -> float:
        """Largest difference."""

    @property
    def max_x(self) -> int:
        """Pixel of the largest difference."""

    @property
    def max_y(self) -> int:
        """Pixel of the largest difference."""

class ExrDiffResult:
    """How two files differ."""

    @property
    def layers(self) -> list[ExrLayerDiff]:
        """Those that both have."""

    @property
    def only_a(self) -> list[str]:
        """Names of layers."""

    @property
    def only_b(self) -> list[str]:
        """Names of layers."""

def exr_diff(a: str, b: str, picture: str = '', layer: str = '') -> ExrDiffResult:
    """
    Compares a with the reference b; `picture` gets the absolute difference.
    """

class RenderOptions:
    """What a caller may say beyond the scene; empty or 0: as the scene says."""

    def __init__(self) -> None: ...

    @property
    def output(self) -> str:
        """A folder for the drivers' relative names, or the first driver's file."""

    @output.setter
    def output(self, arg: str, /) -> None: ...

    @property
    def aa_samples(self) -> int:
        """AA_samples: n * n samples a pixel."""

    @aa_samples.setter
    def aa_samples(self, arg: int, /) -> None: ...

    @property
    def spp(self) -> int:
        """Samples a pixel, wins over aa_samples."""

    @spp.setter
    def spp(self, arg: int, /) -> None: ...

    @property
    def width(self) -> int:
        """Of the frame [pixels]."""

    @width.setter
    def width(self, arg: int, /) -> None: ...

    @property
    def height(self) -> int:
        """Of the frame [pixels]."""

    @height.setter
    def height(self, arg: int, /) -> None: ...

    @property
    def threads(self) -> int:
        """0: as many as the machine has."""

    @threads.setter
    def threads(self, arg: int, /) -> None: ...

    @property
    def seed(self) -> int | None:
        """Of the samples; None: as the scene says."""

    @seed.setter
    def seed(self, arg: int | None, /) -> None: ...

    @property
    def camera(self) -> str:
        """Name of a camera node."""

    @camera.setter
    def camera(self, arg: str, /) -> None: ...

    @property
    def aovs(self) -> list[str]:
        """`NAME TYPE`: outputs added to the first driver."""

    @aovs.setter
    def aovs(self, arg: Sequence[str], /) -> None: ...

    @property
    def lpes(self) -> list[str]:
        """`NAME EXPRESSION`: expressions defined and output as RGB."""

    @lpes.setter
    def lpes(self, arg: Sequence[str], /) -> None: ...

    @property
    def lpe_standard(self) -> bool:
        """Extensions of the language are errors."""

    @lpe_standard.setter
    def lpe_standard(self, arg: bool, /) -> None: ...

    @property
    def lpe_table(self) -> str:
        """Empty, `reference` or `arnold7`."""

    @lpe_table.setter
    def lpe_table(self, arg: str, /) -> None: ...

    @property
    def rendering_space(self) -> str:
        """Colour space that light is computed in; empty: as the scene says."""

    @rendering_space.setter
    def rendering_space(self, arg: str, /) -> None: ...

    @property
    def isa(self) -> str:
        """Empty, `sse2`, `avx2` or `avx512`: pins the ray kernels."""

    @isa.setter
    def isa(self, arg: str, /) -> None: ...

    @property
    def roulette_depth(self) -> int:
        """Scatterings before Russian roulette may end a path; negative: never."""

    @roulette_depth.setter
    def roulette_depth(self, arg: int, /) -> None: ...

    @property
    def checkpoints(self) -> bool:
        """
        Keep what is done beside the first file when the render ends before time.
        """

    @checkpoints.setter
    def checkpoints(self, arg: bool, /) -> None: ...

    @property
    def checkpoint_minutes(self) -> float:
        """
        Between two writes of what is done; 0: only when the render ends before time.
        """

    @checkpoint_minutes.setter
    def checkpoint_minutes(self, arg: float, /) -> None: ...

    @property
    def resume(self) -> bool:
        """Go on from there."""

    @resume.setter
    def resume(self, arg: bool, /) -> None: ...

    @property
    def guiding(self) -> bool:
        """Learn where light comes from, before the first sample."""

    @guiding.setter
    def guiding(self, arg: bool, /) -> None: ...

    @property
    def keep_checkpoint(self) -> bool:
        """Keep it also when the render is done."""

    @keep_checkpoint.setter
    def keep_checkpoint(self, arg: bool, /) -> None: ...

    @property
    def max_memory(self) -> int:
        """A forecast above it is an error [bytes]; 0: no limit."""

    @max_memory.setter
    def max_memory(self, arg: int, /) -> None: ...

    @property
    def viewer(self) -> str:
        """HOST:PORT of a tev that shows the picture as it grows; empty: none."""

    @viewer.setter
    def viewer(self, arg: str, /) -> None: ...

    @property
    def viewer_layers(self) -> list[str]:
        """Names of the layers that it shows, `*` for all; empty: the first."""

    @viewer_layers.setter
    def viewer_layers(self, arg: Sequence[str], /) -> None: ...

    @property
    def capture(self) -> bool:
        """Keep the layers in memory."""

    @capture.setter
    def capture(self, arg: bool, /) -> None: ...

    @property
    def write_files(self) -> bool:
        """Hand the pixels to the drivers."""

    @write_files.setter
    def write_files(self, arg: bool, /) -> None: ...

    def set_region(self, x0: int, y0: int, x1: int, y1: int) -> None:
        """Pixels x0..x1, y0..y1, both ends included, from the upper left corner."""

class ImageLayer:
    """One layer of a picture file."""

    @property
    def name(self) -> str:
        """As asked for, e.g. `diffuse_key`."""

    @property
    def aov(self) -> str:
        """The AOV, before renaming."""

    @property
    def aov_type(self) -> str:
        """`RGBA`, `RGB`, `FLOAT`, `VECTOR`, ..."""

    @property
    def expression(self) -> str:
        """Empty if it is no light path expression."""

    @property
    def light_group(self) -> str:
        """Empty if it is not restricted to one."""

    @property
    def filter(self) -> str:
        """Node type of the filter."""

    @property
    def filter_width(self) -> float:
        """[pixels]"""

    @property
    def half(self) -> bool:
        """HALF was asked for this output."""

    @property
    def n_channels(self) -> int:
        """1 to 4."""

class SceneSummary:
    """What a compiled scene holds and what a render of it would write."""

    @property
    def n_shapes(self) -> int:
        """Shapes."""

    @property
    def n_instances(self) -> int:
        """Shapes as placed, copies by instancers included."""

    @property
    def n_triangles(self) -> int:
        """Triangles of all meshes, each mesh once."""

    @property
    def n_spheres(self) -> int:
        """Spheres."""

    @property
    def n_lights(self) -> int:
        """Lights."""

    @property
    def n_shaders(self) -> int:
        """Shaders."""

    @property
    def light_groups(self) -> list[str]:
        """Named ones, sorted."""

    @property
    def n_aovs(self) -> int:
        """Expressions with their groups."""

    @property
    def n_states(self) -> int:
        """States of the automata."""

    @property
    def n_atoms(self) -> int:
        """Sets of paths that the AOVs tell apart."""

    @property
    def width(self) -> int:
        """Of the frame [pixels]."""

    @property
    def height(self) -> int:
        """Of the frame [pixels]."""

    @property
    def samples_per_pixel(self) -> int:
        """Camera samples."""

    @property
    def files(self) -> list[str]:
        """What a render would write."""

    @property
    def layers(self) -> list[ImageLayer]:
        """All layers of all files."""

    @property
    def layer_file(self) -> list[int]:
        """Index into `files` of each layer."""

    @property
    def partitions(self) -> list[str]:
        """Sums that were proved for the layers of one file."""

    @property
    def forecast(self) -> dict[str, int]:
        """Memory that a render may take at most, by what it holds [bytes]."""

    @property
    def file_bytes(self) -> list[int]:
        """Of each file, before compression."""

    @property
    def checkpoint_bytes(self) -> int:
        """
        Of the file that a stopped render leaves, at most; 0: there will be none.
        """

    @property
    def log(self) -> LogSettings:
        """What the scene asks of the log."""

class LogSettings:
    """What a scene asks of the log."""

    @property
    def verbosity(self) -> int:
        """
        0: errors; 1: warnings, progress and a summary; 2 and more: everything.
        """

    @property
    def max_warnings(self) -> int:
        """Warnings that are printed."""

    @property
    def file(self) -> str:
        """Gets what is printed; empty: none."""

    @property
    def stats_file(self) -> str:
        """For statistics; empty: none."""

    @property
    def stats_append(self) -> bool:
        """After what that file holds."""

class RenderProgress:
    """How far a render is."""

    @property
    def samples_done(self) -> int:
        """Camera samples taken."""

    @property
    def samples_total(self) -> int:
        """Camera samples in all; 0 before the first bucket."""

    @property
    def seconds(self) -> float:
        """Since the first ray."""

    @property
    def noise(self) -> float:
        """
        Of the buckets that are done: a pixel's standard error over how bright pixels are; below 0: not known yet.
        """

class Outcome:
    """What a render gave."""

    @property
    def stopped(self) -> bool:
        """Ended early: what was done is in the files."""

    @property
    def interrupted(self) -> bool:
        """By Ctrl-C."""

    @property
    def seconds(self) -> float:
        """Sampling, without compile and files."""

    @property
    def output_seconds(self) -> float:
        """Spent in drivers."""

    @property
    def samples(self) -> int:
        """Camera samples taken."""

    @property
    def training_samples(self) -> int:
        """Camera samples that guiding learned from, not in `samples`."""

    @property
    def resumed_samples(self) -> int:
        """Camera samples that a checkpoint had, not in `samples`."""

    @property
    def checkpoint(self) -> str:
        """File from which a later render can go on; empty if there is none."""

    @property
    def rays(self) -> int:
        """Closest-hit and shadow rays."""

    @property
    def rays_by_kind(self) -> dict[str, int]:
        """The same, by what they were traced for."""

    @property
    def memory(self) -> dict[str, int]:
        """
        Memory by what it holds [bytes], at the end; `other` is the rest of `peak_memory`.
        """

    @property
    def peak_memory(self) -> int:
        """The most that the process ever held [bytes]; 0: not known."""

    @property
    def noise(self) -> list[tuple[str, float, float, float]]:
        """
        Of each layer of light its name, mean luminance, root mean square luminance, and the standard error of a pixel's luminance (root mean square), as halves of the samples tell.
        """

    @property
    def dropped_samples(self) -> int:
        """Contributions that were not finite."""

    @property
    def files(self) -> list[str]:
        """Written."""

    @property
    def width(self) -> int:
        """Of the rendered region [pixels]."""

    @property
    def height(self) -> int:
        """Of the rendered region [pixels]."""

    @property
    def layers(self) -> list[tuple[ImageLayer, numpy.ndarray]]:
        """
        If they were captured: each layer with its pixels, shape (height, width, channels), row 0 at the top.
        """

class CompiledScene:
    """A scene, read and compiled, ready to render."""

    def __init__(self, path: str, options: RenderOptions, strict: bool = False, assignments: Sequence[str] = []) -> None:
        """
        Reads and compiles; never raises for bad input: `diagnostics` has it, `usable` tells.
        """

    @property
    def usable(self) -> bool:
        """False if there were errors that forbid rendering."""

    @property
    def diagnostics(self) -> tuple[lightsieve.errors.Diagnostic, ...]:
        """Everything kept so far, also of rendering."""

    @property
    def n_errors(self) -> int:
        """Errors, also those not kept."""

    @property
    def n_warnings(self) -> int:
        """Warnings, also those not kept."""

    @property
    def n_lints(self) -> int:
        """Lints, also those not kept."""

    @property
    def times(self) -> dict[str, float]:
        """Where the time went so far, by stage [s]; only if it is usable."""

    def summary(self) -> SceneSummary:
        """What the scene holds; only if it is usable."""

    @property
    def events(self) -> list[str]:
        """
        Every event that its paths can be made of, as text; only if it is usable.
        """

    @property
    def definitions(self) -> list[tuple[str, str]]:
        """
        Name and text of the expressions that it defines; only if it is usable.
        """

    @property
    def lpe_table(self) -> str:
        """`reference` or `arnold7`; only if it is usable."""

    @property
    def layer_samples(self) -> list[tuple[int, int]]:
        """
        Two numbers a layer of the summary: layers with the same two are sums of the same samples and can be added up.
        """

    def render(self, progress: Callable[[RenderProgress], object] | None = None) -> Outcome:
        """
        Renders; Ctrl-C ends it early. `progress` is called about ten times a second.
        """
