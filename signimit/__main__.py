"""``python -m signimit COMMAND``: hand over to `signimit_envs.cli`."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence


def main(argv: Sequence[str] | None = None) -> None:
    """Run a command, or say why not even the simulator can be imported.

    Args:
        argv: The command and its arguments; left out, those of the process.
    """
    try:
        from signimit_envs.cli import main as run
    except (ImportError, AttributeError, RuntimeError) as error:
        sys.exit(_why_no_simulator(error))
    run(argv)


def _why_no_simulator(error: Exception) -> str:
    """Explain a failed import: with MUJOCO_GL set, MuJoCo loads OpenGL as it is imported."""
    chosen = os.environ.get("MUJOCO_GL")
    if chosen:
        return f"MISSING  opengl      MUJOCO_GL={chosen}, and that fails ({error})\n{'':21s}unset MUJOCO_GL"
    return f"MISSING  packages    {error}\n{'':21s}pip install signimit"


if __name__ == "__main__":
    main()
