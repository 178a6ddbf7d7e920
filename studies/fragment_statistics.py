# SPDX-License-Identifier: BSD-3-Clause
"""Statistics of the fragments of several runs together; those of one run are measures of `whipple analyse`."""
import numpy as np

from report.pieces import Masses


def joined(several):
    """The fragments of several runs as those of one."""
    return Masses(np.concatenate([masses.mass for masses in several]), np.concatenate([masses.copies for masses in several]))


def weibull_exponent(masses):
    """Exponent b and its standard error of `Masses` that follow exp(-(m/m_c)^b), by maximum likelihood with the copies c as weights:
    sum c m^b ln m / sum c m^b - 1/b = sum c ln m / sum c; variance 0.608 b^2/n with n = (sum c)^2 / sum c^2, the number of
    fragments of the model where all have equally many copies."""
    if len(masses.mass) < 3:
        return np.nan, np.nan
    m, weight = masses.mass / np.max(masses.mass), masses.copies / masses.copies.sum()
    logarithm = np.log(m)
    mean = (weight * logarithm).sum()

    def excess(b):
        power = weight * m**b
        return (power * logarithm).sum() / power.sum() - 1.0 / b - mean

    lower, upper = 0.05, 50.0
    for _ in range(100):
        b = 0.5 * (lower + upper)
        lower, upper = (b, upper) if excess(b) < 0.0 else (lower, b)
    return b, b * np.sqrt(0.608 * (weight**2).sum())
