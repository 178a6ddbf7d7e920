#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Does the whole program work on this graphics processor, and what does a large run take? Comparison after two hundred
# steps, suites, a cloud of 13.7 million particles by time, standard problems beside the cores of the machine, the time of
# each kernel. For a machine with a driver and an archive of bundle.sh.
#
# Usage: studies/device/whole.sh ARCHIVE.tar.xz OUT [gpu|emulated]
#   OUT   folder for the logs, profile.json and history.csv of the cloud
set -u
if [ $# -lt 2 ]; then sed -n 3,9p "$0"; exit 2; fi
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$2" && out=$(cd "$2" && pwd) || exit 2
on=${3:-gpu}
LIMIT=${LIMIT:-480}
. "$root/studies/device/steps.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
xz -dc "$1" | tar xf - -C "$work" || exit 2
bundle=$work/bundle
source=$(cat "$bundle/source")  # the tests read the project where it was built
[ -e "$source" ] || { mkdir -p "$(dirname "$source")" && ln -sfn "$root" "$source"; }
export UDUNITS2_XML_PATH=$bundle/share/udunits/udunits2.xml LD_LIBRARY_PATH=$bundle/lib OPAL_PREFIX=$bundle
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_ess_singleton_isolated=1
export OMPI_MCA_mca_base_component_path=$bundle/lib/openmpi3 OMPI_MCA_btl=self OMPI_MCA_pml=ob1 OMP_WAIT_POLICY=passive
whipple=$bundle/bin/whipple
check=$bundle/bin/whipple-device-check

# 1. Four states after one and two hundred steps; the same bits twice
step compare 60 "$check" "$bundle"/states/*.state --device "$on" --twice --no-rates --json "$out/compare.json" \
  --markdown "$out/compare.md"
cat "$out/compare.md" 2> /dev/null

# 2. A cloud of 13.7 million particles by time (docs/manual/performance.md)
cloud=(cases/lead_sphere_on_plate/case.toml --set 'domain.lower=["-80.56 mm", "-118.72 mm", "-118.72 mm"]'
  --set domain.boundary.y_lower=outflow --set domain.boundary.z_lower=outflow --set "domain.cell_size=\"${CELL:-0.46 mm}\""
  --set "time.end=\"${END:-30.6 us}\"" --set 'output.snapshot_every="10.2 us"' --set 'output.checkpoint_every="0 s"'
  --set transfer.rest_tolerance=0.0)
cd "$root" || exit 2
step cloud 200 "$whipple" run "${cloud[@]}" --device "$on" --output "$work/cloud"
tail -4 "$out/cloud.log"
cp "$work"/cloud/{history.csv,profile.json,status.json} "$out/" 2> /dev/null

# 3. Steps and suites beside the host
export WHIPPLE_TEST_DEVICE=$on OMP_NUM_THREADS=4
step test_device 60 "$bundle/bin/test_device"
grep -E '^[a-z_]+: [0-9]+ particles|^\[  (FAILED|PASSED)' "$out/test_device.log"
while IFS=$'\t' read -r name program choice; do
  step "$name" 60 "$bundle/bin/$program" "$choice"
  grep -E '^\[  (FAILED|PASSED)' "$out/$name.log" | sort -u
done < "$bundle/suites"
unset WHIPPLE_TEST_DEVICE OMP_NUM_THREADS

# 4. Standard problems, on the device and on the cores of this machine; a case from beginning to end on both
problems=(taylor_bar lead_impact lead_impact_gray_table)
[ "$on" = gpu ] && problems+=(lead_impact_million)
step bench_device 60 "$whipple" bench "${problems[@]}" --device "$on" --json "$out/bench_device.json" --force
step bench_cpu 60 "$whipple" bench "${problems[@]}" --threads "$(nproc)" --json "$out/bench_cpu.json" --force
for device in $on cpu; do
  step "disk_$device" 60 "$whipple" run cases/copper_disk_on_aluminium/case.toml --device $device --output "$work/disk_$device"
  tail -2 "$out/disk_$device.log"
done

# 5. Each kernel by itself
profiler=$(command -v ncu || ls /usr/local/cuda/bin/ncu 2> /dev/null)
if [ "$on" = gpu ] && [ -n "$profiler" ]; then
  for size in 1e5 1e6; do
    step "kernels_$size" 40 "$profiler" --clock-control none --kernel-name-base demangled \
      --metrics gpu__time_duration.sum --csv --launch-skip 400 --launch-count 240 \
      "$check" "$bundle/states/lead_impact.state" --steps 1 --sizes $size --per-cell 8 --no-rates
  done
fi
echo "[$steps]" > "$out/steps.json"
echo "wrote $out after $((SECONDS - begin)) s"
