# SPDX-License-Identifier: BSD-3-Clause
"""Processes of runs, for tests that start some and must leave none."""
import contextlib
import os
import pathlib
import signal


def runs_in(folder):
    """Processes `whipple run` that have the folder among their arguments."""
    found = []
    for process in pathlib.Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            arguments = (process / "cmdline").read_bytes() if process.name.isdigit() else b""
            if str(folder).encode() in arguments and b"\0run\0" in arguments:
                found.append(int(process.name))
    return found


def end_runs_in(folder):
    """Kills what a failed test has left."""
    for process in runs_in(folder):
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
