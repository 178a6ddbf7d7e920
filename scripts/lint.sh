#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Format, documents and static checks. usage: scripts/lint.sh [--format-only] [--fix] [FILE.cpp...]
# Without files all are checked, documents too; clang-tidy takes minutes then, and needs a configured build/release.
set -euo pipefail
cd "$(dirname "$0")/.."

format_only=false
fix=false
files=()
for argument in "$@"; do
  case $argument in
    --format-only) format_only=true ;;
    --fix) fix=true ;;
    -h | --help) sed -n '3,4s/^# //p' "$0"; exit 0 ;;
    -*) echo "lint.sh: unknown option '$argument'" >&2; exit 2 ;;
    *) files+=("$argument") ;;
  esac
done
if ((${#files[@]} == 0)); then
  scripts/check_documents.py
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.cpp' '*.hpp')
fi
if ! command -v clang-format-19 >/dev/null; then
  echo "lint.sh: clang-format-19 is missing: scripts/install_deps.sh" >&2
  exit 2
fi

if $fix; then
  clang-format-19 -i "${files[@]}"
else
  clang-format-19 --dry-run -Werror "${files[@]}"
fi
echo "format: ${#files[@]} files"
$format_only && exit 0

if [[ ! -f build/release/compile_commands.json ]]; then
  echo "lint.sh: build/release is not configured: cmake --preset release" >&2
  exit 2
fi
sources=()
for file in "${files[@]}"; do
  [[ $file == *.cpp ]] && sources+=("$file")
done
# clang brings no omp.h; the one of GCC serves: searched last, so that the intrinsics stay clang's own, and without the
# argument of an attribute that clang does not know. GCC's own headers use what they deprecate.
openmp=("--extra-arg=-idirafter$(g++ -print-file-name=include)" '--extra-arg=-D__malloc__(deallocator)=__malloc__'
  --extra-arg=-Wno-deprecated-declarations)
printf '%s\0' "${sources[@]}" | xargs -0 -P "$(nproc)" -n 1 clang-tidy-19 --quiet "${openmp[@]}" -p build/release
echo "clang-tidy: ${#sources[@]} files"
