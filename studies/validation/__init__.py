# SPDX-License-Identifier: BSD-3-Clause
"""Comparison of the cases with experiments, exact solutions and other codes (scripts/results.py)."""
