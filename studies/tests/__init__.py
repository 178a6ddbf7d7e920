# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the studies: `python3 -m unittest discover -s studies/tests -t .` from the root of the repository."""
