#!/usr/bin/env python3
"""What works on this machine, what is missing, and the line that mends it."""

from __future__ import annotations

import sys

from signimit.command_line import run_program
from signimit_envs.diagnosis import diagnose


def main() -> None:
    """Say what works on this machine: versions, physics, OpenGL, the time of a frame, video; ends with 1 if not all."""
    findings = diagnose()
    for finding in findings:
        print(f"{'ok     ' if finding.works else 'MISSING'}  {finding.what:10s}  {finding.detail}")
        if finding.remedy:
            print(f"                     {finding.remedy}")
    sys.exit(not all(finding.works for finding in findings))


if __name__ == "__main__":
    run_program(main)
