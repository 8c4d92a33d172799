"""Make faults on purpose, and see that nothing is lost."""

from __future__ import annotations

from signimit_envs.cli.fuzz_studio import fuzz_studio

SUBCOMMANDS = {"studio": fuzz_studio}
