# SPDX-License-Identifier: BSD-3-Clause
"""Starts the report: `python3 report RUN_DIR`."""
import os
import sys

# Modules come from the folder that holds this package, never from the present one, which `python3 -m` would put here.
sys.path[0] = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

try:
    from report.command import main
except ImportError as missing:
    sys.exit(f"report: error: {missing}; install python3-numpy python3-h5py python3-matplotlib")

if __name__ == "__main__":
    sys.exit(main())
