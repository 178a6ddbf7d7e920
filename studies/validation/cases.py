# SPDX-License-Identifier: BSD-3-Clause
"""The cases of the repository and what they must show."""
import pathlib

from report.expectations import UNITS, BadExpectation, Case, Expectation, apply, quantity, value_of
from report.measured import Measures

__all__ = ["ROOT", "UNITS", "BadExpectation", "Case", "Expectation", "Measures", "all_cases", "apply", "quantity",
           "value_of"]

ROOT = pathlib.Path(__file__).resolve().parents[2]


def all_cases():
    return [Case(path) for path in sorted((ROOT / "cases").glob("*/expected.toml"))]
