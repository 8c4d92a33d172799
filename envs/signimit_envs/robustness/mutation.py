"""Mutation of files: bytes, text and JSON with something wrong in them, from a seeded generator."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np

Rng = np.random.Generator
T = TypeVar("T")

NUMBERS = (
    *("1e999", "-1e999", "nan", "NaN", "inf", "-Infinity", "1e308", "-1e308", "1e200", "1e100", "1e50", "1e18"),
    *("0", "-0", "-1", "1", "0.5", "1e-9", "1e-100", "5e-324", "1e-999", "2147483648", "9223372036854775808"),
    *("1" * 50, "9" * 5000, "0x10", "1_0", "1,5", "+1", ".", "-", "e5", "--1", "1e", "١٢", "½", "１"),
)
"""Numbers as text that readers stumble over."""

WORDS = (
    *(
        "",
        " ",
        "\t",
        "\n",
        "\r",
        "\r\n",
        "\x00",
        "\x0b",
        "\x1f",
        "\x7f",
        "\x85",
        "\u2028",
        "\ufeff",
        "\u202e",
        "\ufffd",
    ),
    *(
        "é",
        "ß",
        "日本",
        "🖐",
        "e\u0301",
        "<",
        ">",
        "&",
        "&amp;",
        "&#0;",
        "&x;",
        "<!--",
        "]]>",
        '"',
        "'",
        "`",
        ";",
        ",",
        ":",
    ),
    *(
        "{",
        "}",
        "[",
        "]",
        "(",
        ")",
        "/",
        "\\",
        "..",
        "../../x",
        "#",
        "#x",
        "*",
        "!",
        "%s",
        "{0}",
        "None",
        "true",
        "null",
    ),
)
"""Pieces of text that readers stumble over."""

JSON_VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1, 2**31, 2**63, 10**30, -(10**400), 0.5, -0.0, 1e308, 1e-308, 1e100, 1e13),
    *(float("nan"), float("inf"), "", "text", "0", "1.5", "\x00", "\ud800", "é\U0001f590", "../x", "x" * 2000),
    *([], {}, [[]], [None], [0], [1.0, 2.0], ["a"], {"a": 1}, [[0.0, 0.0], [1.0, 1.0]], {"event": "undone"}),
)
"""Values for a place in JSON."""

_TOKEN = re.compile(r"[+-]?\d[\w.+-]*|\w+|\s+|[^\w\s]")
_NUMBER = re.compile(r"[+-]?\d*\.?\d+(?:[eE][+-]?\d+)?")
_ENCODINGS = ("utf-16", "utf-16-le", "utf-32", "latin-1", "cp1252", "utf-8-sig", "utf-7")
_LONGEST = 2**18  # bytes that repeating may make of a file


def pick(rng: Rng, choices: Sequence[T]) -> T:
    """Return one of several things."""
    return choices[int(rng.integers(len(choices)))]


def mutate_bytes(content: bytes, rng: Rng) -> bytes:
    """Flip, cut, insert, remove, repeat or overwrite bytes of any file."""
    if not content:
        return rng.bytes(int(rng.integers(1, 64)))
    start = int(rng.integers(len(content)))
    stop = min(len(content), start + int(rng.integers(1, 33)))
    match int(rng.integers(8)):
        case 0 | 1:
            flipped = bytearray(content)
            for at in rng.integers(len(content), size=int(rng.integers(1, 5))):
                flipped[at] ^= 1 << int(rng.integers(8))
            return bytes(flipped)
        case 2:
            return content[:start]
        case 3:
            return content[:start] + rng.bytes(stop - start) + content[start:]
        case 4:
            return content[:start] + content[stop:]
        case 5:
            return content[:stop] + content[start:]
        case 6:
            return content[:start] + pick(rng, (b"\x00", b"\xff")) * (stop - start) + content[stop:]
        case _:
            return content[start:] + content[:start]


def mutate_text(content: bytes, rng: Rng) -> bytes:
    """Change tokens, numbers or lines of a text, or its encoding."""
    text = content.decode("utf-8", errors="replace")
    match int(rng.integers(7)):
        case 0 | 1:
            text = _mutate_numbers(text, rng)
        case 2 | 3:
            text = "".join(_mutate_items(_TOKEN.findall(text), rng, WORDS + NUMBERS))
        case 4 | 5:
            text = "".join(_mutate_items(text.splitlines(keepends=True), rng, [word + "\n" for word in WORDS]))
        case _:
            return text.encode(pick(rng, _ENCODINGS), errors="replace")
    return text.encode("utf-8", errors="surrogatepass")


def _mutate_numbers(text: str, rng: Rng) -> str:
    """Replace some numbers of a text by others."""
    found = list(_NUMBER.finditer(text))
    if not found:
        return text + pick(rng, NUMBERS)
    for _ in range(int(rng.integers(1, 4))):
        number = pick(rng, found)
        scaled = f"{float(number.group()) * 10.0 ** float(rng.integers(-300, 301)):g}"
        text = text[: number.start()] + pick(rng, (pick(rng, NUMBERS), scaled)) + text[number.end() :]
        found = list(_NUMBER.finditer(text)) or found[:0]
        if not found:
            break
    return text


def _mutate_items(items: list[str], rng: Rng, foreign: Sequence[str]) -> list[str]:
    """Drop, repeat, exchange, insert, reorder or cut some items."""
    if not items:
        return [pick(rng, foreign)]
    for _ in range(int(rng.integers(1, 4))):
        at, other = (int(i) for i in rng.integers(len(items), size=2))
        match int(rng.integers(8)):
            case 0:
                del items[at]
            case 1:
                items.insert(at, items[other])
            case 2:
                items[at], items[other] = items[other], items[at]
            case 3:
                items[at] = pick(rng, foreign)
            case 4:
                items.insert(at, pick(rng, foreign))
            case 5:
                items[at] = items[at] * min(int(rng.integers(2, 1000)), _LONGEST // max(1, len(items[at])))
            case 6:
                del items[at : other + 1]
            case _:
                items[at] = items[at].swapcase() if rng.integers(2) else items[at][::-1]
        if not items:
            break
    return items


def mutate_json(content: bytes, rng: Rng) -> bytes:
    """Change a value somewhere in JSON, remove or rename it, or change the text."""
    if not rng.integers(6):
        return mutate_text(content, rng)
    return json.dumps(mutate_value(json.loads(content), rng)).encode()


def mutate_value(value: Any, rng: Rng) -> Any:
    """Change something in a JSON value, at any depth; the value itself is not kept."""
    if not isinstance(value, (dict, list)) or not value or not rng.integers(8):
        return _other_value(value, rng)
    keys = list(value) if isinstance(value, dict) else range(len(value))
    key = pick(rng, keys)
    match int(rng.integers(10)):
        case 0:
            del value[key]
        case 1 if isinstance(value, dict):
            value[pick(rng, (*value, *WORDS))] = value.pop(key)
        case 1 if isinstance(value, list):
            value.insert(key, value[pick(rng, keys)])
        case 2:
            value[key], other = value[pick(rng, keys)], value[key]
            value[pick(rng, keys)] = other
        case _:
            value[key] = mutate_value(value[key], rng)
    return value


def _other_value(value: Any, rng: Rng) -> Any:
    """Return another value for a place in JSON, often of the same type."""
    if isinstance(value, (int, float)) and rng.integers(2):
        with np.errstate(all="ignore"):
            return float(np.float64(value) * 10.0 ** float(rng.integers(-300, 301)))
    if isinstance(value, str) and rng.integers(2):
        return "".join(_mutate_items(list(value), rng, WORDS))
    return pick(rng, (pick(rng, JSON_VALUES), [value], {"a": value}, str(value)))


def mutate_json_lines(content: bytes, rng: Rng) -> bytes:
    """Change one line of a file of JSON lines, or the order and number of its lines."""
    lines = content.splitlines(keepends=True)
    if not lines or not rng.integers(4):
        return pick(rng, (mutate_text, mutate_bytes))(content, rng)
    at = int(rng.integers(len(lines)))
    if not rng.integers(4):
        other = int(rng.integers(len(lines)))
        lines[at], lines[other] = lines[other], lines[at]
        del lines[at : at + int(rng.integers(2))]
    else:
        lines[at] = mutate_json(lines[at].rstrip(b"\n"), rng) + b"\n"
    return b"".join(lines)


Mutator = Callable[[bytes, Rng], bytes]
