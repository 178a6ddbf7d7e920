# SPDX-License-Identifier: BSD-3-Clause
"""Numbers as they are printed: significant digits, and SI values in the units of the field."""
import math

# Factors from SI to the units of figures and tables.
MICROSECONDS = 1e6
NANOSECONDS = 1e9
MILLIMETRES = 1e3
KM_PER_SECOND = 1e-3
GIGAPASCALS = 1e-9
GRAMS = 1e3
MILLIGRAMS = 1e6
PERCENT = 100

MISSING = "–"

# Units in which quantities of the input, which are written in SI, are shown: the largest first.
SHOWN_IN = {"m": (("mm", 1e-3), ("µm", 1e-6)), "s": (("µs", 1e-6), ("ns", 1e-9)), "m/s": (("km/s", 1e3),)}
ROUND_OFF = 1e-11  # of a balance over many steps, relative
LEAST = 0.01  # of a unit, in which a value is given


def number(value: float | None, digits: int = 4) -> str:
    """Formats a number with so many significant digits; a dash if it is missing or NaN."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return MISSING
    return f"{value:.{digits}g}"


def percent(fraction: float) -> str:
    """Formats a fraction in percent with two significant digits: "4.1 %", "120 %"."""
    return f"{float(f'{PERCENT * fraction:.2g}'):.6g} %"


def error(relative: float) -> str:
    """Formats a relative error of a balance; one of round-off is named so."""
    return "round-off" if abs(relative) < ROUND_OFF else f"{relative:.2g}"


def mass(kilograms: float) -> str:
    """Formats a mass in grams, small ones in milligrams."""
    return f"{GRAMS * kilograms:.4g} g" if kilograms >= 1e-4 else f"{MILLIGRAMS * kilograms:.4g} mg"


def time(seconds: float) -> str:
    """Formats a time in microseconds."""
    return f"{MICROSECONDS * seconds:.4g} µs"


def quantity(text: str) -> str:
    """Formats "0.004 m" as "4 mm"; texts that are no quantity stay as they are."""
    figure, _, unit = text.partition(" ")
    try:
        amount = float(figure)
    except ValueError:
        return text
    for name, size in SHOWN_IN.get(unit, ()):
        if amount == 0:
            return "0"
        if abs(amount) >= LEAST * size:
            return f"{amount / size:.6g} {name}"
    return f"{amount:.6g} {unit}".strip() if unit else text
