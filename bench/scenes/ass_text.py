"""Writes nodes of the .ass format: the few lines that the scenes of this folder share."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


class Array:
    """An array parameter: `n 1 TYPE values`.

    Args:
        kind: type as the format names it, e.g. "VECTOR" or "UINT".
        n: number of elements.
        numbers: all components, one after the other.
    """

    def __init__(self, kind: str, n: int, numbers: Iterable[float | int | str]) -> None:
        self.kind = kind
        self.n = n
        self.numbers = numbers

    def __str__(self) -> str:
        words = [f"{x:.7g}" if isinstance(x, float) else str(x) for x in self.numbers]
        lines = [" ".join(words[i : i + 24]) for i in range(0, len(words), 24)]
        return f"{self.n} 1 {self.kind}\n  " + "\n  ".join(lines)


# What a parameter may be: a name or text, a number, a switch, a colour or point, or an array.
Value = str | float | int | bool | Sequence[float] | Array


def node(kind: str, /, **params: Value) -> str:
    """One node as text.

    Args:
        kind: node type, e.g. "quad_light".
        params: parameters in the order of writing; text goes into quotes but for `name`.
    Returns:
        The node with its braces and a blank line after it.
    Example:
        >>> print(node("box_filter", name="f", width=1), end="")
        box_filter
        {
         name f
         width 1
        }
        <BLANKLINE>
    """
    lines = [kind, "{"]
    for key, value in params.items():
        if isinstance(value, bool):
            text = "on" if value else "off"
        elif isinstance(value, str):
            text = value if key == "name" else f'"{value}"'
        elif isinstance(value, Array):
            text = str(value)
        elif isinstance(value, (int, float)):
            text = format(value, ".9g")
        else:
            text = " ".join(format(x, ".9g") for x in value)
        lines.append(f" {key} {text}")
    return "\n".join([*lines, "}", "", ""])


def options(width: int, height: int, samples: int, depth: int) -> str:
    """The options node, camera `camera`, box filter, and a file for the beauty.

    Args:
        width: of the picture [pixels].
        height: of the picture [pixels].
        samples: AA_samples; the square is samples a pixel.
        depth: every GI depth.

    A camera sample does not split: samples a second are comparable with renderers that do not split theirs.
    """
    return (
        node(
            "options",
            AA_samples=samples,
            xres=width,
            yres=height,
            camera="camera",
            GI_diffuse_depth=depth,
            GI_specular_depth=depth,
            GI_transmission_depth=depth,
            GI_volume_depth=depth,
            GI_total_depth=depth,
            **dict.fromkeys(
                (
                    f"GI_{kind}_samples"
                    for kind in ("diffuse", "specular", "transmission", "sss", "volume")
                ),
                1,
            ),
            indirect_sample_clamp=1e30,
            outputs=Array("STRING", 1, ['"RGBA RGBA filter driver"']),
        )
        + node("box_filter", name="filter", width=1)
        + node("driver_exr", name="driver", filename="bench.exr", color_space="")
    )
