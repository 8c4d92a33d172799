"""``python -m signimit COMMAND``: hand over to `signimit_envs.cli`."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from signimit.exceptions import install_command


def main(argv: Sequence[str] | None = None) -> None:
    """Run a command, or say why not even the simulator can be imported.

    Args:
        argv: The command and its arguments; left out, those of the process.
    """
    try:
        from signimit_envs.cli import main as run
    except (ImportError, AttributeError, OSError, RuntimeError) as error:
        sys.exit(f"MISSING  packages    {error}\n{'':21s}{install_command('signimit')}")
    run(argv)


if __name__ == "__main__":
    main()
