"""What a scene's AOVs are to one another: which add up, what is missing, which are the same."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from lightsieve import _lpe, lpe
from lightsieve.errors import LightsieveError

if TYPE_CHECKING:
    from lightsieve._core import CompiledScene

BEAUTY = "RGBA"
"""What all light is called."""
_COLOUR_CHANNELS = 3


class Sum(NamedTuple):
    """Layers that take each path of a whole exactly once, and nothing else: proved."""

    whole: str
    """A layer, or RGBA."""
    parts: list[str]
    """Layers."""
    everywhere: bool
    """Over all paths; false: only over those that this scene can make."""
    lost_elsewhere: lpe.Path | None
    """If not everywhere: a path of other scenes that would be lost."""


class LeftOut(NamedTuple):
    """A layer that cannot be added to others, because it shares paths with one of them."""

    name: str
    overlaps: str
    """The layer that it shares paths with."""
    example: lpe.Path
    """A shortest path that would be counted twice."""


class Missing(NamedTuple):
    """What the layers that come nearest to adding up to the beauty leave over."""

    parts: list[str]
    """Those layers."""
    expression: str
    """One AOV with this expression makes them add up."""
    builtins: list[str]
    """Built-in AOVs that do as well; may be empty."""
    example: lpe.Path
    """A shortest path that is missing."""
    left_out: list[LeftOut]
    """Layers that overlap those parts."""

    def to_dict(self) -> dict[str, object]:
        """As `lightsieve check --json` prints it."""
        return {
            **self._asdict(),
            "example": self.example._asdict(),
            "left_out": [
                {**one._asdict(), "example": one.example._asdict()} for one in self.left_out
            ],
        }


class Survey(NamedTuple):
    """What a scene's AOVs are to one another."""

    sums: list[Sum]
    """For the beauty and for every layer; sums of sums are left out."""
    missing: Missing | None
    """None if something adds up to the beauty, in this scene at least, or nothing comes near."""
    equal: list[tuple[str, str]]
    """AOVs that take the same paths."""
    contained: list[tuple[str, str]]
    """AOVs the first of which takes a part of what the second takes. Left out: the beauty, and
    layers of the same light group."""
    dead: list[str]
    """AOVs that take no path of this scene: black."""

    def to_dict(self) -> dict[str, object]:
        """The survey as `lightsieve check --json` prints it."""
        return {
            "sums": [
                {
                    **one._asdict(),
                    "lost_elsewhere": one.lost_elsewhere and one.lost_elsewhere._asdict(),
                }
                for one in self.sums
            ],
            "missing": self.missing and self.missing.to_dict(),
            "equal": [list(pair) for pair in self.equal],
            "contained": [list(pair) for pair in self.contained],
            "dead": self.dead,
        }


class _Member(NamedTuple):
    """An AOV of the scene."""

    name: str
    expression: _lpe.Expression | None
    group: str
    samples: tuple[int, int] | None
    """Layers of the same pair can be added up; None: it is defined, but no layer."""


class _Surveyor:
    """Finds out about one scene."""

    def __init__(self, scene: CompiledScene) -> None:
        table: lpe.Table = "arnold7" if scene.lpe_table == "arnold7" else "reference"
        self.definitions = dict(scene.definitions)
        self.context = lpe.Context(table, definitions=self.definitions)
        self.table = table
        self.members = [self._beauty(), *self._members(scene)]
        rows = [(member.expression, member.group) for member in self.members]
        self.groups = scene.summary().light_groups
        self.all_paths = _lpe.AovSet(rows, self.groups)
        self.here = _lpe.AovSet(rows, self.groups, scene.events)

    def _beauty(self) -> _Member:
        return _Member(BEAUTY, _lpe.read("C.*", self.context._names), "", None)

    def _members(self, scene: CompiledScene) -> list[_Member]:
        found: dict[tuple[str, str, str], _Member] = {}
        for layer, samples in zip(scene.summary().layers, scene.layer_samples, strict=True):
            if layer.expression and layer.n_channels >= _COLOUR_CHANNELS:
                expression = self.context._names.find(layer.aov)
                key = (layer.name, layer.aov, layer.light_group)
                found.setdefault(key, _Member(layer.name, expression, layer.light_group, samples))
        written = {aov for _, aov, group in found if not group}
        for name in self.definitions:
            if name not in written:
                expression = self.context._names.find(name)
                found[name, name, ""] = _Member(name, expression, "", None)
        # A layer of all light is the beauty, which stands first already.
        return [m for m in found.values() if (m.name, m.group) != (BEAUTY, "")]

    def run(self) -> Survey:
        dead = [i for i in self._indices() if self.here.example([i], []) is None]
        sums = self._sums(set(dead))
        has_sum = any(one.whole == BEAUTY for one in sums)
        live = [i for i in self._indices() if self.all_paths.example([i], []) is not None]
        relations = {(a, b): self.all_paths.relation(a, b) for a, b in combinations(live, 2)}
        subset = [pair for pair, relation in relations.items() if relation == "subset"]
        subset += [(b, a) for (a, b), relation in relations.items() if relation == "superset"]
        return Survey(
            sums,
            None if has_sum else self._missing(),
            [self._names(pair) for pair, relation in relations.items() if relation == "equal"],
            [self._names(pair) for pair in sorted(subset) if not self._same_group(*pair)],
            [self.members[i].name for i in dead],
        )

    def _indices(self) -> range:
        """All but the beauty."""
        return range(1, len(self.members))

    def _names(self, pair: tuple[int, int]) -> tuple[str, str]:
        return self.members[pair[0]].name, self.members[pair[1]].name

    def _same_group(self, a: int, b: int) -> bool:
        return self.members[a].group == self.members[b].group != ""

    def _can_be_added(self, whole: int, parts: list[int]) -> bool:
        samples = {self.members[part].samples for part in parts}
        if whole != 0:
            samples.add(self.members[whole].samples)
        return len(samples) == 1 and None not in samples

    def _sums(self, dead: set[int]) -> list[Sum]:
        out = []
        for whole in range(len(self.members)):
            # A layer that takes all light has the sums of the beauty.
            if whole != 0 and self.all_paths.relation(0, whole) == "equal":
                continue
            proved = [p for p in self.all_paths.sums(whole) if self._can_be_added(whole, p)]
            known = [set(parts) - dead for parts in proved]
            here = [
                parts
                for parts in self.here.sums(whole)
                if self._can_be_added(whole, parts) and set(parts) not in known
            ]
            out += [self._sum(whole, parts, True) for parts in proved]
            # What adds up only here is worth saying only if nothing adds up everywhere.
            out += [] if proved else [self._sum(whole, parts, False) for parts in here]
        return out

    def _sum(self, whole: int, parts: list[int], everywhere: bool) -> Sum:
        lost = None if everywhere else self.all_paths.example([whole], parts)
        return Sum(
            self.members[whole].name,
            [self.members[part].name for part in parts],
            everywhere,
            None if lost is None else lpe.Path(*lost),
        )

    def _missing(self) -> Missing | None:
        near = [part for part in self.all_paths.nearest(0) if self.members[part].samples]
        chosen = [self.members[part] for part in near]
        example = self.all_paths.example([0], near)
        if not chosen or example is None or len({m.samples for m in chosen}) > 1:
            return None
        texts = [_as_expression(member, self.groups) for member in chosen]
        rest = lpe.rest(*texts, context=self.context)
        if rest is None:
            return None
        return Missing(
            [member.name for member in chosen],
            rest.text,
            self._builtins_for(rest.text),
            lpe.Path(*example),
            self._left_out(near),
        )

    def _builtins_for(self, rest: str) -> list[str]:
        """The fewest built-ins that add up to an expression."""
        names = [row.name for row in lpe.builtins(self.table) if row.name not in self.definitions]
        texts = [rest, *(f"${name}" for name in names)]
        rows = [(_lpe.read(text, self.context._names), "") for text in texts]
        built = _lpe.AovSet(rows, self.groups)
        for i in range(1, len(rows)):
            if built.relation(0, i) == "equal":
                return [names[i - 1]]
        sums = built.sums(0)
        return [names[i - 1] for i in sums[0]] if sums else []

    def _left_out(self, near: list[int]) -> list[LeftOut]:
        """Layers that share paths with one of those, but are neither a part nor a sum of them."""
        out = []
        for i in self._indices():
            shared = [n for n in near if self.all_paths.relation(i, n) == "overlapping"]
            if i in near or not shared or self.members[i].samples is None:
                continue
            example = self.all_paths.example([i, shared[0]], [])
            assert example is not None
            names = self.members[i].name, self.members[shared[0]].name
            out.append(LeftOut(*names, lpe.Path(*example)))
        return out


def _as_expression(member: _Member, groups: list[str]) -> str:
    """The member's paths as one expression, its light group included."""
    if member.expression is None:
        return "C"
    text = f"({member.expression.text})"
    if member.group == "default":
        return " - ".join([text, *(f"(C.*<[LB].'{group}'>)" for group in groups)])
    return f"{text} & (C.*<[LB].'{member.group}'>)" if member.group else text


def survey(scene: CompiledScene) -> Survey | None:
    """Proves what the AOVs of a compiled scene are to one another.

    Sums are looked for among all of its layers of light, custom expressions and light groups
    included, not only among well-known sets.

    Args:
        scene: As `rendering.compile_scene` gives it; it must be `usable`.

    Returns:
        The survey; None if the AOVs are too many or too large to be proved anything about at once.

    Example:
        >>> from lightsieve.rendering import compile_scene
        >>> outputs = ["diffuse RGB", "diffuse_direct RGB", "diffuse_indirect RGB"]
        >>> scene = compile_scene("scene.ass", capture=True, write_files=False, aovs=outputs)
        >>> [(one.whole, one.parts) for one in survey(scene).sums]
        [('diffuse', ['diffuse_direct', 'diffuse_indirect'])]
    """
    try:
        return _Surveyor(scene).run()
    except LightsieveError:
        return None
