#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Format, documents and static checks.
# usage: scripts/lint.sh [--format-only] [--fix] [--recent COMMITS [--most FILES]] [FILE.cpp...]
# Without files all are checked, documents too; clang-tidy takes 4 to 10 processor seconds a file then. --recent: clang-tidy
# alone, of the lines that the last commits changed; with --most in those FILES sources in which they changed most, the rest
# is named.
set -euo pipefail
cd "$(dirname "$0")/.."

format_only=false
fix=false
recent=0
most=0
files=()
while (($# > 0)); do
  case $1 in
    --format-only) format_only=true ;;
    --fix) fix=true ;;
    --recent) recent=${2:?--recent needs a number of commits}; shift ;;
    --most) most=${2:?--most needs a number of files}; shift ;;
    -h | --help) sed -n '3,7s/^# //p' "$0"; exit 0 ;;
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
  # A copy without history has nothing to compare with.
  base=$(git rev-parse --verify --quiet "HEAD~$recent") || { echo "clang-tidy: no commit before the last $recent"; exit 0; }
  # Added lines, file: most first.
  mapfile -t files < <(git diff --no-renames --numstat --diff-filter=d "$base" HEAD -- '*.cpp' '*.hpp' | sort -k1,1nr -k3 | cut -f3)
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
  --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-unknown-attributes
  --extra-arg=-Wno-unused-command-line-argument)
if ((recent > 0)); then  # findings in what changed, headers too
  changed=$(git diff --no-renames --unified=0 --diff-filter=d "$base" HEAD -- "${files[@]}" | awk '
    /^\+\+\+ b\// { file = substr($0, 7) }
    /^@@/ {
      split(substr($3, 2), at, ",")
      count = at[2] == "" ? 1 : at[2]
      if (count > 0) lines[file] = lines[file] (lines[file] == "" ? "" : ",") "[" at[1] "," at[1] + count - 1 "]"
    }
    END { for (file in lines) printf "{\"name\":\"%s\",\"lines\":[%s]},", file, lines[file] }')
  [[ -n $changed ]] || { echo "clang-tidy: no lines were added"; exit 0; }
  arguments+=("--line-filter=[${changed%,}]")
fi
left_out=()
if ((most > 0)); then
  left_out=("${sources[@]:most}")
  sources=("${sources[@]:0:most}")
fi
status=0
printf '%s\0' "${sources[@]}" | xargs -0 -P "$(nproc)" -I FILE clang-tidy-19 "${arguments[@]}" FILE || status=1
echo "clang-tidy: ${#sources[@]} of $((${#sources[@]} + ${#left_out[@]})) files"
((${#left_out[@]} == 0)) || printf 'left out: %s\n' "${left_out[@]}"
exit $status
