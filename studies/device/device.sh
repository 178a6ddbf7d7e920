#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What is a step on this graphics processor worth, and are its results those of the host? For a machine that has a driver,
# nvcc, CMake and nothing else. Everything is tried, whatever fails before it; each step has a time of its own, all of them
# together $LIMIT seconds (480).
#
# Usage: studies/device/device.sh STATES OUT [gpu|emulated]
#   STATES  folder with the states of `whipple bench --states`
#   OUT     folder for device.json, device.md and the logs of the steps
set -u
if [ $# -lt 2 ]; then sed -n 3,10p "$0"; exit 2; fi
states=$(cd "$1" && pwd) || exit 2
mkdir -p "$2" && out=$(cd "$2" && pwd) || exit 2
on=${3:-gpu}
root=$(cd "$(dirname "$0")/../.." && pwd)
LIMIT=${LIMIT:-480}
BUILD=${BUILD:-$out/build}
check=$BUILD/whipple-device-check
if [ "$on" = gpu ]; then
  SIZES=${SIZES:-"1e5 1e6 1e7 3e7"}
else
  SIZES=${SIZES:-"1e4 5e4"}
  export OMP_WAIT_POLICY=passive OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
fi
. "$root/studies/device/steps.sh"

build() {
  cmake -S "$root/src/device/check" -B "$BUILD" && cmake --build "$BUILD" -j "$(nproc)"
}
export -f build
export root BUILD

# 1. Build
if ! step build 240 bash -c build; then tail -20 "$out/build.log"; exit 1; fi
cp "$BUILD"/gpu*.log "$out/" 2> /dev/null

# 2. The four states against the host's kernels after one and two hundred steps; the same bits twice
step compare 90 "$check" "$states"/*.state --device "$on" --twice --json "$out/compare.json" --markdown "$out/compare.md"

# 3. Access to memory, all kernels of all states: 2e4 particles
sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2> /dev/null)
if [ "$on" = gpu ] && [ -n "$sanitizer" ]; then
  step memcheck 90 "$sanitizer" --tool memcheck --error-exitcode 9 "$check" "$states"/*.state --steps 3 --no-rates
fi

# 4. Times: the lead impact repeated, a dense block, and a cloud as it thins out
for size in $SIZES; do
  per_cell=8,2,0.5,0.0625
  [ "$size" = 3e7 ] && per_cell=8,2  # a thinner cloud of so many does not fit into 141 GB
  step "times_$size" 120 "$check" "$states/lead_impact.state" --device "$on" --steps 1 --sizes "$size" --per-cell $per_cell \
    --json "$out/times_$size.json" --markdown "$out/times_$size.md"
done
step times_table 60 "$check" "$states/disk_on_aluminium.state" --device "$on" --steps 1 --sizes "${SIZES%% *}" --per-cell 8 \
  --json "$out/times_table.json" --markdown "$out/times_table.md"

# 5. Five kernels in the profiler
profiler=$(command -v ncu || ls /usr/local/cuda/bin/ncu 2> /dev/null)
if [ "$on" = gpu ] && [ -n "$profiler" ]; then
  step profile 90 "$profiler" --kernel-name-base demangled \
    -k 'regex:SumCells|SumNodes|SolveMomentum|MoveParticles|StrainParticles' --launch-skip 20 --launch-count 5 \
    --section SpeedOfLight --section Occupancy --section LaunchStats \
    "$check" "$states/lead_impact.state" --steps 1 --sizes 1e6 --per-cell 8
fi

# One file for programs, one for people
{
  echo "{\"machine\": \"$(uname -m), $(nproc) cores\","
  echo "\"driver\": \"$(nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2> /dev/null | head -1)\","
  echo "\"compiler\": \"$(nvcc --version 2> /dev/null | tail -1)\","
  echo "\"steps\": [$steps],"
  echo "\"compare\": $(cat "$out/compare.json" 2> /dev/null || echo null),"
  echo "\"times\": ["
  comma=""
  for file in "$out"/times_*.json; do
    [ -f "$file" ] && echo "$comma" && cat "$file" && comma=","
  done
  echo "]}"
} > "$out/device.json"
{
  of_logs() { cat "$out"/compare.log "$out"/times_*.log | sed -n "$1" | head -1; }
  echo "Card: $(of_logs 's/^device: //p'); double precision; $(of_logs '/^copy/p')."
  echo
  cat "$out/compare.md" 2> /dev/null
  head=1
  for size in $SIZES table; do
    file=$out/times_$size.md
    [ -f "$file" ] || continue
    # The comparison precedes the times; the head of the table once.
    sed '1,/^$/d' "$file" | if [ $head = 1 ]; then echo; cat; else sed 1,2d; fi
    head=0
  done
} > "$out/device.md"
echo "wrote $out/device.json and $out/device.md after $((SECONDS - begin)) s"
