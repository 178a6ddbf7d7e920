#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Renews the picture of README.md from the main job.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/run.sh "$@"
cp run/copper_disk_on_aluminium/report/cloud_phase.png docs/images/debris_cloud.png
