# SPDX-License-Identifier: BSD-3-Clause
"""What tests written in Python share: conditions that must hold, at once or soon."""
import time


def require(condition, message):
    if not condition:
        raise SystemExit(f"FAILED: {message}")


def wait_for(condition, what, seconds=60):
    deadline = time.monotonic() + seconds
    while not condition():
        require(time.monotonic() < deadline, f"waited in vain for {what}")
        time.sleep(0.01)
