#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh clone to the verdict of the tests: packages, build, layers, format, all tests without the label long.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: scripts/test.sh [--preset NAME] [--long] [--no-install] [-- CTEST_ARGUMENTS...]
  --preset NAME   release (default) or dev (address and undefined-behaviour sanitizers)
  --long          also the tests with the label long
  --no-install    take the packages as they are
TEXT
}

preset=release
exclude=(--label-exclude '^long$')
install=true
while (($# > 0)); do
  case $1 in
    --preset) preset=${2:?--preset needs a name}; shift ;;
    --long) exclude=() ;;
    --no-install) install=false ;;
    -h | --help) usage; exit 0 ;;
    --) shift; break ;;
    *) echo "test.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done

begin=$SECONDS
passed=0
failed=0
skipped=0
summary=()

note() {  # note ok|FAILED what
  summary+=("$(printf '%-7s %s' "$1" "$2")")
}
stage() {
  echo
  echo "== $1 ($((SECONDS - begin)) s) =="
}
check() {  # check what command...: one check that counts as a test
  local what=$1
  shift
  if "$@"; then
    passed=$((passed + 1))
    note ok "$what"
  else
    failed=$((failed + 1))
    note FAILED "$what"
  fi
}

if $install; then
  stage packages
  scripts/install_deps.sh --dev  # clang-tidy
fi

stage build
configured=$(cmake --preset "$preset" 2>&1) || { echo "$configured"; exit 1; }
cmake --build --preset "$preset" --parallel "$(nproc)"

stage format
check format scripts/lint.sh --format-only
# 4 to 10 processor seconds a file.
check "clang-tidy of the last commit" scripts/lint.sh --recent 1 --most 4

stage tests
log=build/$preset/test.log
status=0
ctest --test-dir "build/$preset" --output-on-failure --parallel "$(($(nproc) + 1))" "${exclude[@]}" "$@" 2>&1 | tee "$log" || status=$?
# "97% tests passed, 3 tests failed out of 120"
if [[ $(grep -E 'tests passed, .* out of' "$log" | tail -n 1) =~ ([0-9]+)\ tests?\ failed\ out\ of\ ([0-9]+) ]]; then
  failed=$((failed + BASH_REMATCH[1]))
  skipped=$(grep -c '\*\*\*Skipped' "$log" || true)  # ctest counts them as passed
  passed=$((passed + BASH_REMATCH[2] - BASH_REMATCH[1] - skipped))
  note "$( ((BASH_REMATCH[1] == 0)) && echo ok || echo FAILED)" "${BASH_REMATCH[2]} tests, layers among them"
else
  failed=$((failed + 1))
  note FAILED "no summary of ctest (status $status)"
fi
((status == 0)) || ((failed > 0)) || failed=1

stage summary
printf '%s\n' "${summary[@]}"
echo "$passed passed, $failed failed, $skipped skipped"
((failed == 0))
