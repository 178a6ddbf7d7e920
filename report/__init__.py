# SPDX-License-Identifier: BSD-3-Clause
"""Figures and tables of a run as one HTML page, from what `whipple analyse` measured (docs/manual/output.md).

Starts with `whipple report RUN_DIR`, or `python3 report RUN_DIR` on a run that was analysed. Numbers come from
analysis.h5, history.csv, gauges.csv and planar_impact.json in SI; run.toml is shown as it stands and never interpreted.
"""
