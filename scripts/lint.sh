#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Format, documents and static checks.
# usage: scripts/lint.sh [--format-only] [--fix] [--recent COMMITS [--seconds LIMIT]] [FILE.cpp...]
# Without files all are checked, documents too; clang-tidy takes 4 to 10 processor seconds a file then. --recent: clang-tidy
# alone, of what the last commits changed, begun within LIMIT seconds (60); what is left out is named.
set -euo pipefail
cd "$(dirname "$0")/.."

format_only=false
fix=false
recent=0
limit=0
files=()
while (($# > 0)); do
  case $1 in
    --format-only) format_only=true ;;
    --fix) fix=true ;;
    --recent) recent=${2:?--recent needs a number of commits}; limit=60; shift ;;
    --seconds) limit=${2:?--seconds needs a number}; shift ;;
    -h | --help) sed -n '3,6s/^# //p' "$0"; exit 0 ;;
    -*) echo "lint.sh: unknown option '$1'" >&2; exit 2 ;;
    *) files+=("$1") ;;
  esac
  shift
done
require() {  # require TOOL OPTION: a check that cannot run fails
  command -v "$1" >/dev/null && return
  echo "lint.sh: $1 is missing: scripts/install_deps.sh $2" >&2
  exit 2
}
if ((recent > 0)); then
  mapfile -t files < <(git log -n "$recent" --format= --name-only --diff-filter=d -- '*.cpp' '*.hpp' | awk '!seen[$0]++' |
    while read -r file; do [[ -f $file ]] && echo "$file"; done)
elif ((${#files[@]} == 0)); then
  scripts/check_documents.py
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.cpp' '*.hpp')
fi
if ((recent == 0)); then
  require clang-format-19 ""
  if $fix; then
    clang-format-19 -i "${files[@]}"
  else
    clang-format-19 --dry-run -Werror "${files[@]}"
  fi
  echo "format: ${#files[@]} files"
fi
$format_only && exit 0

require clang-tidy-19 --dev
sources=()
for file in "${files[@]}"; do
  [[ $file == *.cpp ]] && sources+=("$file")
done
if ((${#sources[@]} == 0)); then
  echo "clang-tidy: no files"
  exit 0
fi
# Of its own: clang reads neither the precompiled headers of GCC nor several files as one.
cmake --preset release -B build/lint -DWHIPPLE_PRECOMPILED_HEADERS=OFF -DWHIPPLE_UNITY_BUILD=OFF >/dev/null
# clang brings no omp.h; the one of GCC serves: searched last, so that the intrinsics stay clang's own, and without the
# argument of an attribute that clang does not know. GCC's own headers use what they deprecate, and GCC has more warnings.
arguments=(--quiet -p build/lint "--extra-arg=-idirafter$(g++ -print-file-name=include)"
  '--extra-arg=-D__malloc__(deallocator)=__malloc__' --extra-arg=-Wno-deprecated-declarations
  --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-unused-command-line-argument)
if ((recent > 0)); then  # findings in what changed, headers too
  arguments+=("--line-filter=[$(printf '{"name":"%s"},' "${files[@]}" | sed 's/,$//')]")
fi
left_out=$(mktemp)
trap 'rm -f "$left_out"' EXIT
tidy() {  # tidy LIMIT LEFT_OUT FILE ARGUMENTS...
  local limit=$1 left_out=$2 file=$3
  shift 3
  if ((limit > 0 && $(date +%s) >= limit)); then
    echo "$file" >>"$left_out"
  else
    clang-tidy-19 "$@" "$file"
  fi
}
export -f tidy
((limit > 0)) && limit=$(($(date +%s) + limit))
status=0
printf '%s\0' "${sources[@]}" |
  xargs -0 -P "$(nproc)" -I FILE bash -c 'tidy "$@"' tidy "$limit" "$left_out" FILE "${arguments[@]}" || status=1
echo "clang-tidy: $((${#sources[@]} - $(wc -l <"$left_out"))) of ${#sources[@]} files"
[[ -s $left_out ]] && sed 's/^/left out: /' "$left_out"
exit $status
