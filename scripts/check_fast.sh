#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A first verdict within a minute of a built tree: builds a dozen test executables and runs them, with the checks of layers
# and of documents. usage: scripts/check_fast.sh [--preset NAME]. The whole verdict: scripts/test.sh.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=release
case ${1:-} in
  "") ;;
  --preset) preset=${2:?--preset needs a name} ;;
  -h | --help) sed -n '3,4s/^# //p' "$0"; exit 0 ;;
  *) echo "check_fast.sh: unknown option '$1'" >&2; exit 2 ;;
esac
tests=(base_test input_test hdf5_test eos_test eos_library_test test_material test_transfer test_fem test_afemp test_case test_io
       test_analysis)
[[ -f build/$preset/build.ninja ]] || cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --parallel "$(nproc)" --target "${tests[@]}"
failed=()
scripts/check_layers.py || failed+=(layers)
scripts/check_documents.py || failed+=(documents)
for test in "${tests[@]}"; do
  SECONDS=0
  log=build/$preset/check_fast.log
  if "build/$preset/tests/bin/$test" --gtest_brief=1 >"$log" 2>&1; then
    echo "$test: ${SECONDS} s"
  else
    cat "$log"
    failed+=("$test")
  fi
done
if ((${#failed[@]} > 0)); then
  echo "failed: ${failed[*]}"
  exit 1
fi
echo "check_fast: ${#tests[@]} executables, layers and documents pass"
