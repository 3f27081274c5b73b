"""Damage, drawn from a generator of random numbers: texts of scenes and the bytes of files."""

from __future__ import annotations

import random
import re
import struct

NUMBERS = """
0 -1 1 2 1e38 -1e38 nan -nan inf -inf 1e-45 2147483647 -2147483648 4294967295 -4294967296
99999999999999999999 1000000 65536 0.5 1.5.2 0x10 --1 1e
"""
"""What takes a number's place."""

WORDS = """
STRING FLOAT INT UINT BYTE BOOL RGB RGBA VECTOR VECTOR2 MATRIX NODE ENUM ARRAY b85 b64 on off
declare constant uniform varying indexed include name "" "%n%s" { } [ ] # probe ball cam
"""
"""What takes a word's place."""

WORD = re.compile(r'"[^"]*"|[{}]|[^\s{}"]+')
LENGTHS = (0, 1, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
"""What takes the place of four bytes that may be a length or an offset."""


def _word(text: str, rng: random.Random) -> re.Match[str] | None:
    words = list(WORD.finditer(text))
    return rng.choice(words) if words else None


def _replace_word(text: str, rng: random.Random) -> str:
    word = _word(text, rng)
    if word is None:
        return rng.choice(WORDS.split())
    is_number = word[0][0] in "+-.0123456789"
    if rng.random() < 0.2:
        # A name of something else: links where none should be, circles.
        other = _word(text, rng)
        new = other[0] if other is not None else ""
    else:
        new = rng.choice((NUMBERS if is_number else WORDS).split())
    return text[: word.start()] + new + text[word.end() :]


def _numbers_near_one_another(text: str, rng: random.Random) -> str:
    """All numbers of a line."""
    lines = text.split("\n")
    at = rng.randrange(len(lines))
    new = rng.choice(NUMBERS.split())
    lines[at] = re.sub(r"(?<![\w\"])[-+]?\d[\d.e+-]*", lambda _: new, lines[at])
    return "\n".join(lines)


def _swap_words(text: str, rng: random.Random) -> str:
    first, second = _word(text, rng), _word(text, rng)
    if first is None or second is None or first.start() >= second.start():
        return text
    return (
        text[: first.start()]
        + second[0]
        + text[first.end() : second.start()]
        + first[0]
        + text[second.end() :]
    )


def _cut_or_double(text: str, rng: random.Random) -> str:
    lines = text.split("\n")
    begin = rng.randrange(len(lines))
    end = begin + rng.choice((1, 1, 2, 8))
    part = lines[begin:end] if rng.random() < 0.5 else []
    return "\n".join(lines[:begin] + part + part + lines[end:])


def _bytes(text: str, rng: random.Random) -> str:
    return mutate_bytes(text.encode("latin-1", "replace"), rng, 1).decode("latin-1")


TEXT_DAMAGE = (
    _replace_word,
    _replace_word,
    _replace_word,
    _numbers_near_one_another,
    _swap_words,
    _cut_or_double,
    _bytes,
)


def mutate_text(text: str, rng: random.Random) -> str:
    """A scene with one to six changes."""
    for _ in range(rng.choice((1, 1, 2, 3, 6))):
        text = rng.choice(TEXT_DAMAGE)(text, rng)
    return text


def mutate_bytes(data: bytes, rng: random.Random, n: int = 0, head: int = 600) -> bytes:
    """A file with `n` changes, or one to sixteen; most of them in its first `head` bytes."""
    for _ in range(n or rng.choice((1, 1, 2, 4, 16))):
        size = max(len(data), 1)
        at = rng.randrange(size if rng.random() < 0.4 else min(head, size))
        kind = rng.randrange(6)
        if kind == 0:
            data = data[:at]
        elif kind == 1 and at < len(data):
            flipped = data[at] ^ 1 << rng.randrange(8)
            data = data[:at] + bytes([flipped]) + data[at + 1 :]
        elif kind == 2:
            data = data[:at] + bytes([rng.choice((0, 1, 127, 128, 255))]) + data[at + 1 :]
        elif kind == 3:
            word = struct.pack(rng.choice("<>") + "I", rng.choice(LENGTHS))
            data = data[:at] + word + data[at + 4 :]
        elif kind == 4:
            data = data[:at] + data[at : at + rng.randrange(1, 200)] + data[at:]
        else:
            data = data[:at] + data[at + rng.randrange(1, 60) :]
    return data
