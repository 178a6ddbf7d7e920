#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian packages whipple, libwhipple-dev and python3-whipple, and a tarball that runs from any folder.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ${1:-} == -h || ${1:-} == --help || $# -gt 1 ]]; then
  echo "usage: scripts/package.sh [FOLDER]   packages go into FOLDER (default build/packages)"
  exit $(($# > 1 ? 2 : 0))
fi
# Without them cpack stops, or makes packages without the libraries that they depend on.
for tool in dpkg-shlibdeps file; do
  command -v "$tool" >/dev/null || { echo "package.sh: $tool is missing: scripts/install_deps.sh" >&2; exit 2; }
done
folder=$(realpath -m "${1:-build/packages}")
cmake --preset release >/dev/null
cmake --build build/release --parallel "$(nproc)" --target whipple whipple-md whipple-fit whipple_python_eos
(cd build/release && cpack -B "$folder")
rm -rf "$folder/_CPack_Packages"
ls -l "$folder"
