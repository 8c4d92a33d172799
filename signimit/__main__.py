"""``python -m signimit COMMAND``: hand over to `signimit_envs.cli`."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from types import FrameType

from signimit.exceptions import install_command


def main(argv: Sequence[str] | None = None) -> None:
    """Run a command, or say why not even the simulator can be imported.

    Args:
        argv: The command and its arguments; left out, those of the process.
    """
    before = signal.signal(signal.SIGINT, _leave)
    try:
        from signimit_envs.cli import main as run
    except (ImportError, AttributeError, OSError, RuntimeError) as error:
        sys.exit(f"MISSING  packages    {error}\n{'':21s}{install_command('signimit')}")
    finally:
        signal.signal(signal.SIGINT, before)
    run(argv)


def _leave(number: int, frame: FrameType | None) -> None:
    """End the process at Ctrl-C while packages are imported: nothing is open, and a broken import says too much."""
    os.write(sys.stderr.fileno(), b"\nstopped\n")
    os._exit(128 + number)


if __name__ == "__main__":
    main()
