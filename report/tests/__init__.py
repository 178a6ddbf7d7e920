# SPDX-License-Identifier: BSD-3-Clause
"""Tests of the report: `python3 -m unittest discover -s report/tests -t .` from the root of the repository."""
