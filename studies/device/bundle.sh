#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Packs the program, the suites that a device passes and their libraries, for a machine that has a graphics processor and
# none of the packages (`whole.sh` runs them there). The C library is not packed: that machine's must not be older.
#
# Usage: studies/device/bundle.sh ARCHIVE.tar.xz [BUILD]
#   BUILD   build folder (default: build/release), with the tests
set -euo pipefail
if [ $# -lt 1 ]; then sed -n 3,8p "$0"; exit 2; fi
root=$(cd "$(dirname "$0")/../.." && pwd)
build=${2:-$root/build/release}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
to=$work/bundle
mkdir -p "$to/bin" "$to/lib/openmpi3" "$to/share"

# Programs; suites with their filters, as the build registers them
cp "$build/bin/whipple" "$build/src/device/check/whipple-device-check" "$build/tests/bin/test_device" "$to/bin/"
ctest --test-dir "$build" -R '^device\.' --show-only=json-v1 | /usr/bin/python3 -c '
import json, pathlib, sys
for test in json.load(sys.stdin)["tests"]:
    program, choice = test["command"]
    print(test["name"], pathlib.Path(program).name, choice, sep="\t")' > "$to/suites"
while IFS=$'\t' read -r _ program _; do cp "$build/tests/bin/$program" "$to/bin/"; done < "$to/suites"
strip "$to"/bin/*
cp "$(command -v orted)" "$to/bin/"
"$build/bin/whipple" bench --states "$to/states"

echo "$root" > "$to/source"  # where the tests look for the project

# Libraries: those of the programs, and the modules of Open MPI that a single process may load
cp -r /usr/share/xml/udunits "$to/share/"
modules=$(ompi_info --path libdir --parsable | sed 's/.*://')/openmpi3
for module in "$modules"/*.so; do
  case $module in
    *ofi* | *ucx* | *psm* | *spml* | *scoll* | *sshmem* | *memheap* | *monitoring* | *usnic* | *openib*) ;;
    *) cp "$module" "$to/lib/openmpi3/" ;;
  esac
done
for file in "$to"/bin/* "$to"/lib/openmpi3/*; do ldd "$file"; done | awk '/=> \//{print $3}' | sort -u |
  grep -v -E '/(libc|libm|libpthread|libdl|librt)\.so' | xargs -I{} cp -L {} "$to/lib/"
tar cf - -C "$work" bundle | xz -c --x86 --lzma2=preset=3,dict=192MiB > "$1"
ls -l "$1"
