# SPDX-License-Identifier: BSD-3-Clause
"""Measurements of the program and of its results: one folder each, with the script and what it found."""
