# SPDX-License-Identifier: BSD-3-Clause
"""Words for what run.toml says: values are shown as they stand, lengths, times and speeds in the units of the field."""
from typing import Any

from report import units


def describe_value(value: Any) -> str:
    """Writes a value of the input without program text."""
    if isinstance(value, dict):
        return ", ".join(f"{k.replace('_', ' ')} {describe_value(v)}" for k, v in value.items())
    if isinstance(value, list):
        return "(" + ", ".join(map(describe_value, value)) + ")"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return units.quantity(str(value))


def describe_discretization(keys: Any) -> str:
    """Writes the discretization of a body; empty texts and keys of meshes that are not there are left out."""
    if not isinstance(keys, dict):
        return str(keys)
    shown = {k: v for k, v in keys.items() if v not in ("", False) and k != "mesh_unit"}
    of_elements = keys.get("method") in ("finite_elements", "adaptive")
    for key in list(shown):
        if (key.startswith(("element", "hourglass")) and not of_elements) or (key.startswith("bar_") and
                                                                               keys.get("method") != "bars"):
            del shown[key]
    method = str(shown.pop("method", "")).replace("_", " ")
    return "; ".join(filter(None, [method, describe_value(shown)]))


def describe_shape(shape: Any) -> str:
    """Writes the shape of a body."""
    if not isinstance(shape, dict):
        return str(shape)
    return "; ".join(f"{kind} ({describe_value(keys)})" for kind, keys in shape.items())
