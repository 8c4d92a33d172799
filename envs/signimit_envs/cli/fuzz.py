"""Make faults on purpose, and see that nothing is lost."""

from __future__ import annotations

from signimit_envs.cli.fuzz_files import fuzz_files, kill_writers, write_without_room
from signimit_envs.cli.fuzz_studio import fuzz_studio

SUBCOMMANDS = {"files": fuzz_files, "kill": kill_writers, "no-room": write_without_room, "studio": fuzz_studio}
