"""Bodies of hostile requests: JSON as the server describes it, more or less, and files as it would export them."""

from __future__ import annotations

import io
import json
import random
import zipfile
from collections.abc import Mapping
from typing import Any

Json = dict[str, Any]
HOSTILE: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1, 2**31, 2**63, 10**400, -0.0, 5e-324, 1e308, -1e308, float("nan"), float("inf")),
    *("", "0", "x", "\x00", "\ud800", "\x1b]0;x\x07\n", "é🖐\u202e", "../../x", "x" * 5000, "9" * 5000),
    *([], {}, [[]], [None], [[0, 0]], [[float("nan"), 0], [1, 1]], {"points": [], "times": []}),
)
_DEEP = ("[" * 100_000, '{"a":' * 50_000, "[" * 500 + "]" * 500)
_BROKEN = (
    b"",
    b"\x00",
    b"\xff\xfe",
    b"\xc3\x28",
    b"{",
    b'{"a":1}x',
    b"nul",
    b"\xef\xbb\xbf{}",
    b"--x\r\n\r\n",
    b"a=1&b=2",
)


class SchemaBodies:
    """Makes values of the JSON schemas in the server's description of itself."""

    def __init__(self, description: Json) -> None:
        """Take ``openapi.json``."""
        self._known = description.get("components", {}).get("schemas", {})

    def make(self, schema: Mapping[str, Any], rng: random.Random, hostility: float) -> Any:
        """Return a value; ``hostility`` is the probability that a part of it is something else."""
        if rng.random() < hostility:
            return rng.choice(HOSTILE)
        if "$ref" in schema:
            return self.make(self._known[schema["$ref"].rpartition("/")[2]], rng, hostility)
        for choice in ("anyOf", "oneOf"):
            if choice in schema:
                return self.make(rng.choice(schema[choice]), rng, hostility)
        if "enum" in schema:
            return rng.choice(schema["enum"])
        if "const" in schema:
            return schema["const"]
        match schema.get("type"):
            case "object":
                return self._object(schema, rng, hostility)
            case "array":
                return self._array(schema, rng, hostility)
            case "integer":
                return rng.choice((schema.get("minimum", 0), rng.randint(0, 3), schema.get("maximum", 7)))
            case "number":
                return round(rng.uniform(-0.4, 0.4), 4)
            case "string":
                return rng.choice(("", "paper", "free", "é", "five movements"))
            case "boolean":
                return rng.random() < 0.5
        return None

    def _object(self, schema: Mapping[str, Any], rng: random.Random, hostility: float) -> Json:
        asked = set(schema.get("required", ()))
        properties = schema.get("properties", {})
        made = {
            name: self.make(inner, rng, hostility)
            for name, inner in properties.items()
            if (name in asked) != (rng.random() < max(hostility, 0.3 * (name not in asked)))
        }
        if not properties and "additionalProperties" in schema:
            places = schema.get("propertyNames", {}).get("enum", ["hand", "question"])
            drawing = self.make(schema["additionalProperties"], rng, hostility)
            made = {str(rng.choice(places)): drawing}
        if isinstance(made.get("points"), list) and isinstance(made.get("times"), list) and rng.random() < 0.9:
            made["times"] = [0.02 * n for n in range(len(made["points"]))]  # or hardly a stroke would be one
        if rng.random() < hostility:
            made[rng.choice(("more", "__proto__", "\x1b[2J", "k" * 3000))] = rng.choice(HOSTILE)
        return made

    def _array(self, schema: Mapping[str, Any], rng: random.Random, hostility: float) -> list[Any]:
        if "prefixItems" in schema:
            return [self.make(item, rng, hostility) for item in schema["prefixItems"]]
        least, most = schema.get("minItems", 0), schema.get("maxItems", 6)
        count = rng.choice((least, least + 4, least + 9)) if rng.random() > hostility else rng.randint(0, 12)
        return [self.make(schema.get("items", {}), rng, hostility) for _ in range(min(count, most))]


def json_bytes(value: Any, rng: random.Random) -> bytes:
    """Return a value as JSON, in one of the ways to write it."""
    text = json.dumps(value, ensure_ascii=rng.random() < 0.7)
    return text.encode(rng.choice(("utf-8",) * 6 + ("utf-16", "utf-32", "utf-7")), "surrogatepass")


def broken_bytes(rng: random.Random, most: int) -> bytes:
    """Return what is no JSON, or more of it than the server takes."""
    match rng.randrange(20):
        case 0:
            return b"[" + b"0," * (most // 2) + b"0]"
        case 1:
            return rng.choice(_DEEP).encode()
        case 2:
            return b'{"seed":' + b"9" * 20_000 + b"}"
        case 3 | 4 | 5 | 6:
            return rng.randbytes(rng.randrange(2000))
    return rng.choice(_BROKEN)


def file_bytes(name: str, sample: bytes, rng: random.Random, secret: str) -> bytes:
    """Return a file that is not as the server exported it.

    Args:
        name: Name of its format.
        sample: The file as the server exported it.
        rng: Decides.
        secret: Path of a file that the server must not read.
    """
    kind = rng.randrange(8)
    if kind == 0 and name.endswith(".inkml"):
        entity = rng.choice((f'SYSTEM "file://{secret}"', '"' + "a" * 50_000 + '"', f'PUBLIC "x" "file://{secret}"'))
        return f"<!DOCTYPE ink [<!ENTITY a {entity}>]><ink><trace>{'&a;' * 1000}</trace></ink>".encode()
    if kind == 1 and name.endswith(".npz"):
        return _archive(rng, secret)
    if kind == 2:
        return sample[: rng.randrange(len(sample) + 1)]
    if kind == 3:
        return sample * rng.randint(2, 5)
    if kind == 4:
        return rng.randbytes(rng.randrange(3000))
    changed = bytearray(sample)
    for _ in range(rng.randint(1, 8)):
        start = rng.randrange(len(changed))
        changed[start : start + rng.choice((0, 1, 4))] = rng.choice((b"", b"0", b"nan", b"1e999", rng.randbytes(4)))
        if not changed:
            break
    return bytes(changed)


def _archive(rng: random.Random, secret: str) -> bytes:
    """Return an archive whose names lead elsewhere, or that has far more in it than it is long."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        if rng.random() < 0.1:
            archive.writestr("signs.npy", bytes(80 * 2**20))
        for name in (f"../../../..{secret}", secret, "hand.npy", "a\\..\\b", "signimit.npy"):
            archive.writestr(name, rng.randbytes(20))
    return file.getvalue()
