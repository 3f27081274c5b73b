"""The reference engine's parser: recursive descent over the grammar, stopping at the first error.

It shares no line with the parser in `src/lpe`. A `Fault` is a mistake that the reference engine
makes when it is asked to; the corpus must notice every one of them.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from typing import NoReturn

sys.setrecursionlimit(20_000)

BLANKS = " \t\n\r\f\v"
QUANTIFIERS = "*+?{"
KINDS = "CRTVLOBA"
EVENT_LETTERS = "CDSRTVLOBA"
LETTERS = EVENT_LETTERS + "."
MAX_LENGTH = 64 * 1024
MAX_NESTING = 256
MAX_REPEAT = 256
UNBOUNDED = 1 << 30

#: Characters of other alphabets and of word processors that look like one of the language's.
LOOK_ALIKES = frozenset(
    "\u0391\u0392\u039f\u03a4\u03f9\u0405\u0410\u0412\u041e\u0421\u0422\u0441\u0474\u054d\u0555\u053c"
    "\u13a1\u13a2\u13da\u13d9\u13df\u13a0\u13de\u13aa\u00a0\u2018\u2019\u2032\u02bc\u2217\u2039\u203a"
    "\u2024\u2223\u2010\u2013\u2014\u2212"
) | {chr(code) for code in range(0xFF01, 0xFF5F)}


#: What `$name` stands for: the built-in AOVs that need no more than one line.
LOBES = {
    "diffuse": "<RD>",
    "specular": "<RS[^'coat']>",
    "coat": "<RS'coat'>",
    "sheen": "<RS'sheen'>",
    "transmission": "<TS>",
    "sss": "<TD>",
    "volume": "V",
}
NAMES = {
    "RGBA": "C.*",
    "RGB": "C.*",
    "direct": "C[DSV]L",
    "indirect": "C[DSV][DSVOB].*",
    "emission": "C[LO]",
    "background": "CB",
    "albedo": "C[DSV]A",
    "denoise_albedo": "((C<TD>A)|(CVA)|(C<RD>A))",
    **{name: f"C{lobe}.*" for name, lobe in LOBES.items()},
    **{f"{name}_direct": f"C{lobe}L" for name, lobe in LOBES.items()},
    **{f"{name}_indirect": f"C{lobe}[DSVOB].*" for name, lobe in LOBES.items()},
    **{f"{name}_albedo": f"C{lobe}A" for name, lobe in LOBES.items()},
}


class Fault(Enum):
    """Mistakes that this engine makes when asked to; the corpus must catch each."""

    # letters and the dot
    DOT_TAKES_PROBE = "`.` takes A"
    DOT_SKIPS_TERMINALS = "`.` takes scattering events only"
    S_TAKES_DIFFUSE = "S takes lobes that are D"
    D_IS_REFLECTION = "D takes reflections only"
    VOLUME_IS_DIFFUSE = "D takes volume events"
    B_IS_LIGHT = "B takes L"
    O_IS_LIGHT = "O takes L"
    L_TAKES_PROBE = "L takes A"
    CAMERA_ANYWHERE = "a C that is not first is skipped"
    LOWER_CASE = "small letters are events"
    # brackets
    NEGATION_SKIPS_TERMINALS = "[^..] takes scattering events only"
    NEGATION_TAKES_CAMERA = "[^..] takes the camera"
    NEGATION_TAKES_PROBE = "[^..] takes A"
    # angles
    LOBE_IGNORED = "<RD> is any reflection"
    MISSING_LOBE_IS_NONE = "<R> takes only events without a lobe"
    DOT_LOBE_NEEDS_LOBE = "<..> and <V.> need an event with a lobe"
    ANY_KIND_TAKES_PROBE = "<.> and <[^R]> take A"
    # labels
    NEGATION_EXCLUDES_UNLABELLED = "[^'x'] does not take an event without labels"
    LABEL_PREFIX = "labels are compared by their beginnings"
    LABEL_CASE = "labels are compared without their case"
    LABEL_TRIMMED = "blanks round a label do not count"
    ONE_LABEL_ONLY = "only the first label of an event counts"
    LABEL_TESTS_ANY = "one of several label tests is enough"
    LABEL_CHOICE_ALL = "['a''b'] asks for both labels"
    NO_DEFAULT_GROUP = "a light without a group has no group `default`"
    DEFAULT_TAKES_ALL = "`default` takes lights of every group"
    # quantifiers
    STAR_NEEDS_ONE = "* needs one"
    PLUS_ALLOWS_NONE = "+ allows none"
    GREEDY_OPTIONAL = "? never gives back what it took"
    GREEDY_STAR = "* never gives back what it took"
    MINIMUM_TOO_HIGH = "{n,m} asks for n + 1"
    MINIMUM_TOO_LOW = "{n,m} asks for n - 1"
    MAXIMUM_TOO_HIGH = "{n,m} takes m + 1"
    MAXIMUM_TOO_LOW = "{n,m} takes m - 1"
    # structure
    TIGHT_ALTERNATION = "| joins one event on each side"
    FIRST_ALTERNATIVE = "the first alternative that can begin is the only one tried"
    BLANKS_MEAN_NOTHING = "((a) (b)) is a sequence"
    GROUPS_ARE_ALTERNATIVES = "((a)(b)) is an alternation"
    UNANCHORED = "the beginning of a path is enough"
    # extensions
    COMPLEMENT_OF_WORDS = "!(a) takes everything that a does not, probes too"
    DIFFERENCE_FROM_THE_RIGHT = "a - b - c is a - (b - c)"
    TIGHT_INTERSECTION = "& joins one event on each side"
    # what must be refused
    TRAILING_GARBAGE = "what follows a ) too many is not read"
    EMPTY_ALTERNATIVES = "an empty alternative is accepted"
    SECOND_QUANTIFIER = "a second quantifier is accepted"
    COUNTS_SWAPPED = "{3,2} is read as {2,3}"


class RefusedError(Exception):
    """The first error of an expression: its code and its column in characters, from 1."""

    def __init__(self, code: str, column: int) -> None:
        super().__init__(f"{code}@{column}")
        self.code = code
        self.column = column


@dataclass(frozen=True)
class Event:
    """One event of a path."""

    kind: str
    lobe: str = ""
    labels: tuple[str, ...] = ()


Test = Callable[[Event], bool]


@dataclass(frozen=True, eq=False)
class Node:
    """One part of an expression; `form` says which fields count."""

    form: str  # a method of Matcher
    parts: tuple[Node, ...] = ()
    test: Test = lambda event: False
    least: int = 0
    most: int = 0
    is_camera: bool = False


NOTHING = Node("nothing")


class Parser:
    """Recursive descent over the grammar; the first error is raised."""

    def __init__(self, text: str, standard: bool, faults: Iterable[Fault]) -> None:
        self.text = text
        self.standard = standard
        self.faults = frozenset(faults)
        self.at = 0
        self.depth = 0
        self.chained = 0
        self.first = True

    # -- characters

    def peek(self, among: str = "") -> str:
        """The next character if it is one of these (any if none are given), else ""."""
        here = self.text[self.at : self.at + 1]
        return here if not among or here in among else ""

    def take(self, wanted: str) -> bool:
        """Goes past this character if it is next."""
        if self.peek() != wanted:
            return False
        self.at += 1
        return True

    def blanks(self) -> bool:
        """Goes past blanks; were there any?"""
        begin = self.at
        while self.peek(BLANKS):
            self.at += 1
        return self.at > begin

    def refuse(self, code: str, at: int | None = None) -> NoReturn:
        """Raises an error at this place, or here."""
        place = self.at if at is None else at
        raise RefusedError(code, place - (self.text.rfind("\n", 0, place) + 1) + 1)

    def refuse_character(self) -> NoReturn:
        """Raises the error for a character that cannot stand here."""
        here = self.peek()
        if here in LOOK_ALIKES:
            self.refuse("lpe-look-alike")
        if here and here in ")]}>":
            self.refuse("lpe-unclosed")
        self.refuse("lpe-event" if here.isascii() and here.isalpha() else "lpe-character")

    # -- structure

    def parse(self) -> Node:
        """The whole text."""
        if len(self.text.encode()) > MAX_LENGTH:
            self.refuse("limit-lpe-length", 0)
        node = self.alternation(inside=False)
        if self.at < len(self.text) and Fault.TRAILING_GARBAGE not in self.faults:
            self.refuse_character()
        return node

    def alternation(self, inside: bool) -> Node:
        """Alternatives between `|`; in parentheses also between groups with blanks."""
        self.blanks()
        first = self.first
        parts: list[Node] = []
        while True:
            self.first = first
            items = self.sequence()
            if not items and ((not parts and not self.peek("|&-")) or not self.empty_is_fine()):
                self.refuse("lpe-operator" if self.peek("&-") else "lpe-empty")
            if inside and not parts and not self.peek("|&-") and self.blanks_divide(items):
                parts = [node for node, *_ in items]
                break
            self.first = first
            parts.append(self.algebra(join([node for node, *_ in items])))
            if not self.take("|"):
                break
        return parts[0] if len(parts) == 1 else Node("alternation", tuple(parts))

    def empty_is_fine(self) -> bool:
        return Fault.EMPTY_ALTERNATIVES in self.faults and not self.peek("&-")

    def blanks_divide(self, items: list[tuple[Node, bool, bool, bool]]) -> bool:
        """Are these nothing but two or more groups, all of them divided by blanks?"""
        plain = all(is_group and not repeated for _, is_group, repeated, _ in items)
        if len(items) < 2 or not plain or Fault.BLANKS_MEAN_NOTHING in self.faults:
            return False
        divided = all(blank for *_, blank in items[1:])
        return divided or Fault.GROUPS_ARE_ALTERNATIVES in self.faults

    def algebra(self, left: Node) -> Node:
        """Sequences between `&` and `-`, from left to right."""
        first = self.first
        while operator := self.peek("&-"):
            self.operator()
            self.first = first
            items = self.sequence()
            if not items:
                self.refuse("lpe-operator")
            right = join([node for node, *_ in items])
            if operator == "-" and Fault.DIFFERENCE_FROM_THE_RIGHT in self.faults:
                right = self.algebra(right)
            left = Node("both" if operator == "&" else "minus", (left, right))
        return left

    def operator(self) -> None:
        """Goes past `&` or `-`."""
        at = self.at
        self.at += 1
        if self.standard:
            self.refuse("lpe-standard", at)
        before, after = self.text[max(at - 1, 0) : at], self.text[at + 1 : at + 2]
        if not (before and after and before in BLANKS and after in BLANKS):
            self.refuse("lpe-operator", at)
        self.chained += 1
        if self.chained > MAX_NESTING:
            self.refuse("limit-lpe-nesting", at)

    def sequence(self) -> list[tuple[Node, bool, bool, bool]]:
        """Parts up to an operator: node, is a group, is repeated, stands after blanks."""
        items: list[tuple[Node, bool, bool, bool]] = []
        first = self.first
        blank = self.blanks()
        while self.at < len(self.text) and not self.peek("|)&-"):
            only_groups = all(is_group and not repeated for _, is_group, repeated, _ in items)
            if first and only_groups and blank and self.peek("("):
                self.first = True
            items.append((*self.joined(), blank))
            blank = self.blanks()
            self.first = False
        return items

    def joined(self) -> tuple[Node, bool, bool]:
        """One repeat; with some faults, operators bind more tightly than a sequence."""
        item = self.repeat()
        for fault, letter, form in (
            (Fault.TIGHT_ALTERNATION, "|", "alternation"),
            (Fault.TIGHT_INTERSECTION, "&", "both"),
        ):
            begin = self.at
            self.blanks()
            while fault in self.faults and self.peek(letter):
                self.at += 1
                self.blanks()
                item = (Node(form, (item[0], self.repeat()[0])), False, False)
                begin = self.at
                self.blanks()
            self.at = begin
        return item

    def repeat(self) -> tuple[Node, bool, bool]:
        """One atom with its quantifier: node, is a group, is repeated."""
        begin = self.at
        if self.peek(QUANTIFIERS):
            self.quantifier()
            self.refuse("lpe-quantifier", begin)
        is_group = self.peek() == "("
        node = self.atom()
        end = self.at
        repeated = False
        self.blanks()
        while self.peek(QUANTIFIERS):
            begin = self.at
            least, most = self.quantifier()
            if repeated and Fault.SECOND_QUANTIFIER not in self.faults:
                self.refuse("lpe-quantifier", begin)
            node = Node("repeat", (node,), least=least, most=most)
            repeated = True
            end = self.at
            self.blanks()
        self.at = end
        return node, is_group, repeated

    def quantifier(self) -> tuple[int, int]:
        """`*`, `+`, `?` or counts: least and most."""
        begin = self.at
        sign = self.peek()
        self.at += 1
        if sign == "*":
            return int(Fault.STAR_NEEDS_ONE in self.faults), UNBOUNDED
        if sign == "+":
            return int(Fault.PLUS_ALLOWS_NONE not in self.faults), UNBOUNDED
        return (0, 1) if sign == "?" else self.counts(begin)

    def counts(self, begin: int) -> tuple[int, int]:
        """What follows `{`."""
        least = self.number()
        comma = self.take(",")
        most = self.number() if comma else least
        if not self.take("}"):
            closed = self.text.find("}", begin) >= 0
            self.refuse("lpe-quantifier" if closed else "lpe-unclosed", begin)
        if least is None:
            self.refuse("lpe-quantifier", begin)
        if max(least, most or 0) > MAX_REPEAT:
            self.refuse("limit-lpe-repeat", begin)
        if most is not None and most < least:
            if Fault.COUNTS_SWAPPED not in self.faults:
                self.refuse("lpe-quantifier", begin)
            least, most = most, least
        least += Fault.MINIMUM_TOO_HIGH in self.faults
        least -= Fault.MINIMUM_TOO_LOW in self.faults and least > 0
        if most is None:
            return least, UNBOUNDED
        most += Fault.MAXIMUM_TOO_HIGH in self.faults
        most -= Fault.MAXIMUM_TOO_LOW in self.faults
        return least, most

    def number(self) -> int | None:
        """Digits between blanks."""
        self.blanks()
        begin = self.at
        while self.peek("0123456789"):
            self.at += 1
        digits = self.text[begin : self.at]
        self.blanks()
        return int(digits) if digits else None

    def atom(self) -> Node:
        """A group, a complement, a name or one event."""
        begin = self.at
        if self.peek() == "(":
            return self.group()
        if self.take("!"):
            if self.standard:
                self.refuse("lpe-standard", begin)
            self.blanks()
            if self.peek() != "(":
                self.refuse("lpe-operator", begin)
            return Node("complement", (self.group(),))
        if re.match(r"\$[\w{]", self.text[self.at :], re.ASCII):
            return self.reference()
        is_camera = self.peek() == "C"
        return Node("event", test=self.event(), is_camera=is_camera)

    def group(self) -> Node:
        """A parenthesis."""
        begin = self.at
        self.at += 1
        if self.depth >= MAX_NESTING:
            self.refuse("limit-lpe-nesting", begin)
        self.depth += 1
        node = self.alternation(inside=True)
        self.depth -= 1
        if not self.take(")"):
            self.refuse("lpe-unclosed", begin)
        return node

    def reference(self) -> Node:
        """`$name` or `${name}`."""
        begin = self.at
        found = re.compile(r"\$(?:\{([^}]*)\}|(\w+))", re.ASCII).match(self.text, begin)
        if found is None:
            self.refuse("lpe-unclosed", begin)
        self.at = found.end()
        name = found.group(1) or found.group(2) or ""
        if not name:
            self.refuse("lpe-reference", begin)
        if self.standard:
            self.refuse("lpe-standard", begin)
        if name not in NAMES:
            self.refuse("lpe-reference", begin)
        return Parser(NAMES[name], False, self.faults).parse()

    # -- one event

    def event(self) -> Test:
        """A letter, `.`, a label, `<..>` or `[..]`."""
        here = self.peek()
        if here and here in LETTERS:
            self.at += 1
            return self.letter(here)
        if here == "<":
            return self.angle()
        if here == "[":
            return self.brackets()
        if here == "'":
            label = self.label()
            return lambda event: event.kind not in "CA" and self.carries(event, label)
        small = here in "cdsrtvloba" and here != ""
        if small and ((here == "c" and self.first) or Fault.LOWER_CASE in self.faults):
            self.at += 1
            return self.letter(here.upper())
        return self.refuse_character()

    def letter(self, letter: str) -> Test:
        """What one letter takes."""
        kinds, lobes = letter, ""
        if letter == ".":
            kinds = "RTV" if Fault.DOT_SKIPS_TERMINALS in self.faults else "RTVLOB"
            kinds += "A" * (Fault.DOT_TAKES_PROBE in self.faults)
        elif letter in "DS":
            kinds, lobes = "RT", letter
            if letter == "D" and Fault.D_IS_REFLECTION in self.faults:
                kinds = "R"
            if letter == "S" and Fault.S_TAKES_DIFFUSE in self.faults:
                lobes = "DS"
        volume = letter == "D" and Fault.VOLUME_IS_DIFFUSE in self.faults
        if (letter == "B" and Fault.B_IS_LIGHT in self.faults) or (
            letter == "O" and Fault.O_IS_LIGHT in self.faults
        ):
            kinds += "L"
        if letter == "L" and Fault.L_TAKES_PROBE in self.faults:
            kinds += "A"
        return lambda event: (
            (event.kind in kinds and (not lobes or event.lobe in lobes))
            or (volume and event.kind == "V")
        )

    def label(self) -> str:
        """A quoted label."""
        begin = self.at
        end = self.text.find("'", begin + 1)
        if end < 0:
            self.refuse("lpe-unclosed", begin)
        if end == begin + 1:
            self.refuse("lpe-label", begin)
        self.at = end + 1
        return self.text[begin + 1 : end]

    def carries(self, event: Event, wanted: str) -> bool:
        """Does the event carry this label?"""
        labels: tuple[str, ...] = event.labels
        if Fault.ONE_LABEL_ONLY in self.faults:
            labels = labels[:1]
        if Fault.DEFAULT_TAKES_ALL in self.faults and wanted == "default":
            return event.kind == "L" or wanted in labels
        if Fault.NO_DEFAULT_GROUP in self.faults and event.kind == "L":
            labels = tuple(label for label in labels if label != "default")
        if Fault.LABEL_CASE in self.faults:
            labels, wanted = tuple(label.lower() for label in labels), wanted.lower()
        if Fault.LABEL_TRIMMED in self.faults:
            labels, wanted = tuple(label.strip() for label in labels), wanted.strip()
        if Fault.LABEL_PREFIX in self.faults:
            return any(label.startswith(wanted) for label in labels)
        return wanted in labels

    def find_close(self, opens: str, closes: str) -> int:
        """Where the bracket here is closed, labels left out; -1 if it is not."""
        depth = 0
        at = self.at
        while at < len(self.text):
            here = self.text[at]
            if here == "'":
                at = self.text.find("'", at + 1)
                if at < 0:
                    return -1
            elif here == opens:
                if opens == "<" and depth > 0:
                    return -1
                depth += 1
            elif here == closes:
                depth -= 1
                if depth == 0:
                    return at
            at += 1
        return -1

    def brackets(self) -> Test:
        """`[..]` or `[^..]`."""
        begin = self.at
        if self.find_close("[", "]") < 0:
            self.refuse("lpe-unclosed")
        self.at += 1
        self.blanks()
        negated = self.take("^")
        items: list[Test] = []
        self.blanks()
        while not self.take("]"):
            self.refuse_inside("[")
            first, self.first = self.first, False
            items.append(self.event())
            self.first = first
            self.blanks()
        if not items:
            self.refuse("lpe-empty", begin)
        return self.none_of(items) if negated else lambda event: any(item(event) for item in items)

    def none_of(self, items: list[Test]) -> Test:
        """What [^..] takes."""
        kinds = "RTV" if Fault.NEGATION_SKIPS_TERMINALS in self.faults else "RTVLOB"
        kinds += "C" * (Fault.NEGATION_TAKES_CAMERA in self.faults)
        kinds += "A" * (Fault.NEGATION_TAKES_PROBE in self.faults)
        return lambda event: event.kind in kinds and not any(item(event) for item in items)

    def refuse_inside(self, more: str) -> None:
        """Raises an error if what is next cannot stand between brackets."""
        if self.peek(QUANTIFIERS):
            self.refuse("lpe-quantifier")
        if self.peek("&-!"):
            self.refuse("lpe-operator")
        if self.peek("|()" + more):
            self.refuse("lpe-character")

    def angle(self) -> Test:
        """`<kind lobe labels>`."""
        if self.find_close("<", ">") < 0:
            self.refuse("lpe-unclosed")
        self.at += 1
        kind = self.kind()
        lobe = self.lobe()
        labels = self.label_tests()
        any_label = Fault.LABEL_TESTS_ANY in self.faults and labels

        def test(event: Event) -> bool:
            held = [label(event) for label in labels]
            return kind(event) and lobe(event) and (any(held) if any_label else all(held))

        return test

    def kind(self) -> Test:
        """The first place of `<..>`."""
        self.blanks()
        others = "CA" if Fault.ANY_KIND_TAKES_PROBE not in self.faults else "C"
        if self.take("."):
            return lambda event: event.kind not in others
        if letter := self.peek(KINDS):
            self.at += 1
            return lambda event: event.kind == letter
        if self.peek() == "[":
            negated, letters = self.letter_set(KINDS)
            if negated:
                return lambda event: event.kind not in letters + others
            return lambda event: event.kind in letters
        return self.refuse_kind()

    def refuse_kind(self) -> NoReturn:
        """Raises the error for what is no kind."""
        if self.peek() == ">":
            self.refuse("lpe-empty", self.at - 1)
        if self.peek("DS"):
            self.refuse("lpe-event")
        if self.peek() == "'":
            self.refuse("lpe-label")
        self.refuse_inside("")
        self.refuse_character()

    def lobe(self) -> Test:
        """The second place of `<..>`."""
        self.blanks()
        if self.take("."):
            needed = Fault.DOT_LOBE_NEEDS_LOBE in self.faults
            return lambda event: event.lobe != "" or not needed
        if letter := self.peek("DS"):
            self.at += 1
            ignored = Fault.LOBE_IGNORED in self.faults
            return lambda event: event.lobe == letter or ignored
        if self.peek() == "[" and not re.match(r"\[\s*\^?\s*'", self.text[self.at :]):
            negated, letters = self.letter_set("DS")
            return lambda event: (event.lobe != "" and event.lobe in letters) != negated
        if self.peek(KINDS):
            self.refuse("lpe-event")
        absent = Fault.MISSING_LOBE_IS_NONE in self.faults
        return lambda event: event.lobe == "" or not absent

    def letter_set(self, allowed: str) -> tuple[bool, str]:
        """A set of letters: negated, letters."""
        begin = self.at
        self.at += 1
        self.blanks()
        negated = self.take("^")
        letters = ""
        self.blanks()
        while not self.take("]"):
            if self.peek() == ">":
                self.refuse("lpe-unclosed", begin)
            if not self.peek(allowed):
                if self.peek(EVENT_LETTERS):
                    self.refuse("lpe-event")
                self.refuse_inside("")
                self.refuse_character()
            letters += self.peek()
            self.at += 1
            self.blanks()
        if not letters:
            self.refuse("lpe-empty", begin)
        return negated, letters

    def label_tests(self) -> list[Test]:
        """Label tests up to the `>`."""
        tests: list[Test] = []
        self.blanks()
        while not self.take(">"):
            if self.peek() == "'":
                tests.append(self.label_test(False, [self.label()]))
            elif self.peek() == "[":
                tests.append(self.label_set())
            elif self.peek() != "." and self.peek(LETTERS):
                self.refuse("lpe-event")
            elif not self.take("."):
                self.refuse_inside("")
                self.refuse_character()
            self.blanks()
        return tests

    def label_set(self) -> Test:
        """`['a''b']` or `[^'a''b']`."""
        begin = self.at
        self.at += 1
        self.blanks()
        negated = self.take("^")
        labels: list[str] = []
        self.blanks()
        while not self.take("]"):
            if self.peek() == ">":
                self.refuse("lpe-unclosed", begin)
            if self.peek() != "'":
                self.refuse_inside("")
                self.refuse_character()
            labels.append(self.label())
            self.blanks()
        if not labels:
            self.refuse("lpe-empty", begin)
        return self.label_test(negated, labels)

    def label_test(self, negated: bool, labels: list[str]) -> Test:
        """One of the labels, or none of them."""
        if negated:
            strict = Fault.NEGATION_EXCLUDES_UNLABELLED in self.faults
            return lambda event: (
                not any(self.carries(event, label) for label in labels)
                and (event.labels != () or not strict)
            )
        every = all if Fault.LABEL_CHOICE_ALL in self.faults else any
        return lambda event: every(self.carries(event, label) for label in labels)


def join(nodes: list[Node]) -> Node:
    """A sequence of these."""
    if not nodes:
        return NOTHING
    return nodes[0] if len(nodes) == 1 else Node("sequence", tuple(nodes))


def compile_text(text: str, standard: bool = False, faults: Iterable[Fault] = ()) -> Node:
    """The tree of an expression; raises RefusedError."""
    return Parser(text, standard, faults).parse()
