# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the report."""


class NotARun(Exception):
    """The folder is not that of a run, or something in it cannot be read."""
