"""Which code and which libraries made a result."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np
import scipy

import signimit


@cache
def code_hash() -> str:
    """Return a short SHA-256 of all modules of signimit, the same wherever and however it is installed."""
    folder, sha = Path(signimit.__file__).parent, hashlib.sha256()
    for path in sorted(folder.rglob("*.py"), key=lambda p: p.relative_to(folder).as_posix()):
        sha.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes().replace(b"\r\n", b"\n"))
    return sha.hexdigest()[:16]


def versions() -> dict[str, str]:
    """Return the versions that a result may depend on; libraries of some entries only where they are installed."""
    optional = {name: found for name in ("scikit-learn", "torch") if (found := _installed(name))}
    return optional | {
        "signimit": signimit.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "machine": platform.machine(),
    }


def _installed(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None
