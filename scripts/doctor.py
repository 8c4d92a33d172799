#!/usr/bin/env python3
"""Say what works on this machine, what is missing, and the line that mends it. Ends with code 1 if something is."""

from __future__ import annotations

import argparse
import os
import sys


def main() -> None:
    """Print one line for each thing that was looked at."""
    argparse.ArgumentParser(description=__doc__).parse_args()  # no tyro: it may be what is missing
    try:
        from signimit_envs.cli.doctor import diagnose
    except (ImportError, AttributeError, RuntimeError) as error:
        sys.exit(explain(error))
    findings = diagnose()
    for finding in findings:
        print(f"{'ok     ' if finding.works else 'MISSING'}  {finding.what:10s}  {finding.detail}")
        if finding.remedy:
            print(f"{'':21s}{finding.remedy}")
    sys.exit(not all(finding.works for finding in findings))


def explain(error: Exception) -> str:
    """Say why not even the simulator can be imported: with MUJOCO_GL set, MuJoCo loads OpenGL as it is imported."""
    chosen = os.environ.get("MUJOCO_GL")
    if chosen:
        return f"MISSING  opengl      MUJOCO_GL={chosen}, and that fails ({error})\n{'':21s}unset MUJOCO_GL"
    return f"MISSING  packages    {error}\n{'':21s}pip install signimit"


if __name__ == "__main__":
    main()
