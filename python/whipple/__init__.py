# SPDX-License-Identifier: BSD-3-Clause
"""Equations of state of whipple for Python: `from whipple import eos` (docs/manual/python.md)."""
import os
import pathlib

# An installed module finds the material library of its own installation, as the installed program does.
_library = pathlib.Path(__file__).resolve().parents[4] / "share" / "whipple" / "materials"
if _library.is_dir():
    os.environ.setdefault("WHIPPLE_MATERIALS", str(_library))
