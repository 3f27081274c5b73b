"""What the command line says of a render when it is done, and of its memory beforehand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lightsieve import statistics
from lightsieve.cli import _output, _scene_options
from lightsieve.cli._output import plural, tell

if TYPE_CHECKING:
    from collections.abc import Mapping

    from lightsieve._core import CompiledScene, Outcome, SceneSummary

# Layers, codes and kinds that are named where not everything is asked for.
_N_NAMED = 4
_KIB, _GIB = 2**10, 2**30


def size_text(n_bytes: int) -> str:
    """`17 MiB`, `3.2 GiB`."""
    if n_bytes >= _GIB:
        return f"{n_bytes / _GIB:.1f} GiB"
    if n_bytes >= _KIB**2 or n_bytes == 0:
        return f"{n_bytes / _KIB**2:.0f} MiB"
    return f"{n_bytes / _KIB:.0f} KiB"


def _largest(sizes: Mapping[str, int], n: int) -> str:
    """The largest with their sizes; what is nothing is left out."""
    ordered = sorted(sizes.items(), key=lambda pair: -pair[1])
    return ", ".join(f"{name} {size_text(size)}" for name, size in ordered[:n] if size > 0)


def forecast_rows(summary: SceneSummary) -> list[tuple[str, str]]:
    """What a render would take, one line a fact."""
    memory = summary.forecast
    rows = [
        ("memory", f"up to {size_text(sum(memory.values()))}: {_largest(memory, len(memory))}")
    ]
    if summary.file_bytes:
        files = f"{size_text(sum(summary.file_bytes))} a frame before compression"
        if summary.checkpoint_bytes:
            files += f"; a checkpoint up to {size_text(summary.checkpoint_bytes)}"
        rows.append(("files", files))
    return rows


def say_forecast(summary: SceneSummary) -> None:
    """Says before a render what it will take."""
    for head, text in forecast_rows(summary):
        _output.say(f"{head}: {text}")


def _noise(outcome: Outcome, n: int) -> str:
    """The layers that are noisiest for how bright they are, worst first."""
    shares = [(error / level, name) for name, _, level, error in outcome.noise if level > 0]
    return ", ".join(f"{name} {share:.1%}" for share, name in sorted(shares)[: -n - 1 : -1])


def _times(compiled: CompiledScene, outcome: Outcome) -> str:
    times = {**compiled.times, "render": outcome.seconds, "write": outcome.output_seconds}
    return ", ".join(f"{stage} {seconds:.1f} s" for stage, seconds in times.items())


def _rays(outcome: Outcome) -> str:
    kinds = sorted(outcome.rays_by_kind.items(), key=lambda pair: -pair[1])
    shares = ", ".join(f"{kind} {n / outcome.rays:.0%}" for kind, n in kinds if n > 0)
    rate = outcome.rays / outcome.seconds if outcome.seconds > 0 else 0.0
    return f"{outcome.rays:,} ({rate:,.0f}/s): {shares}"


def print_render(compiled: CompiledScene, outcome: Outcome, *, everything: bool) -> None:
    """Prints what was written, what it took, and how good it is.

    Args:
        compiled: What was rendered.
        outcome: What came of it.
        everything: All layers and kinds, not only what stands out.
    """
    for path in outcome.files:
        tell(f"wrote {path}")
    rate = outcome.samples / outcome.seconds if outcome.seconds > 0 else 0.0
    tell(
        f"{outcome.width} x {outcome.height} in {outcome.seconds:.1f} s "
        f"(+ {outcome.output_seconds:.1f} s output): "
        f"{outcome.samples:,} samples, {rate:,.0f} samples/s"
    )
    if outcome.training_samples:
        tell(f"{outcome.training_samples:,} samples more for guiding")
    if outcome.resumed_samples:
        tell(f"{outcome.resumed_samples:,} samples were in the checkpoint")
    if outcome.checkpoint:
        tell(f"--resume goes on from {outcome.checkpoint}")
    if outcome.dropped_samples:
        tell(f"{plural(outcome.dropped_samples, 'sample')} dropped: not finite")
    n_named = len(outcome.noise) if everything else _N_NAMED
    if noisy := _noise(outcome, n_named):
        tell(f"noise left in a pixel, of the layer's level: {noisy}")
    tell(f"time: {_times(compiled, outcome)}")
    if outcome.rays:
        tell(f"rays: {_rays(outcome)}")
    n_kinds = len(outcome.memory) if everything else _N_NAMED
    tell(
        f"memory: {size_text(outcome.peak_memory)} at most; "
        f"at the end {_largest(outcome.memory, n_kinds)}"
    )
    summary = compiled.summary()
    tell(
        f"AOVs: {plural(len(summary.layers), 'layer')}, {plural(summary.n_states, 'state')}, "
        f"{plural(summary.n_atoms, 'atom')}"
    )
    codes = list(statistics.warning_codes(compiled).items())
    if codes:
        named = codes if everything else codes[:_N_NAMED]
        more = f", {plural(len(codes) - len(named), 'other code')}" if codes != named else ""
        tell(f"warnings: {', '.join(f'{code} {n}' for code, n in named)}{more}")
    tell(_scene_options.count_text(compiled))
