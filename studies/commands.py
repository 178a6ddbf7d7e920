# SPDX-License-Identifier: BSD-3-Clause
"""Commands that studies run."""
import pathlib
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[1]


def call(command, allowed=(0,)):
    """Runs a command from the root of the project and returns what it printed; ends the study if its code is not allowed."""
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=ROOT, check=False)
    if result.returncode not in allowed:
        sys.exit(f"{' '.join(map(str, command))}\nfailed with code {result.returncode}:\n{result.stdout}{result.stderr}")
    return result


def cell_size(folder):
    """Cell size of a run (m)."""
    return float(tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))["domain"]["cell_size"].split()[0])
