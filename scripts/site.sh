#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the site from the documents: pages, search, formulas, references of Python and C++; to be read without a network.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: scripts/site.sh [FOLDER] [--python PATH] [--no-cpp]
  FOLDER          where the site is written (default build/site): open FOLDER/html/index.html
  --python PATH   folder of the built Python package, whose docstrings are shown (default build/release/python, if it is built)
  --no-cpp        without the reference of the C++ headers
Exit code 77 if a tool is missing: scripts/install_deps.sh --site
TEXT
}

folder=build/site
python=
cpp=true
while (($# > 0)); do
  case $1 in
    --python) python=${2:?--python needs a folder}; shift ;;
    --no-cpp) cpp=false ;;
    -h | --help) usage; exit 0 ;;
    -*) echo "site.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
    *) folder=$1 ;;
  esac
  shift
done

missing=()
/usr/bin/python3 -c 'import sphinx, myst_parser, furo' 2>/dev/null || missing+=(python3-sphinx python3-myst-parser furo)
[[ -f /usr/share/javascript/katex/katex.min.js ]] || missing+=(libjs-katex)
$cpp && ! command -v doxygen >/dev/null && missing+=(doxygen)
if ((${#missing[@]} > 0)); then
  echo "SKIPPED: the site needs ${missing[*]}: scripts/install_deps.sh --site"
  exit 77
fi

if [[ -z $python ]] && compgen -G 'build/release/python/whipple/eos*.so' >/dev/null; then
  python=build/release/python
fi
cpp_flag=()
$cpp && cpp_flag=(--cpp)
/usr/bin/python3 docs/site/pages.py "$folder/source" ${python:+--python "$python"} "${cpp_flag[@]}"
/usr/bin/python3 -m sphinx -q -W --keep-going -j 2 -b html -d "$folder/doctrees" "$folder/source" "$folder/html"
if $cpp; then
  {
    echo "PROJECT_NAME = \"whipple: C++ library\""
    echo "OUTPUT_DIRECTORY = $folder/html"
    echo "HTML_OUTPUT = cpp"
    echo "INPUT = $(grep -v '^#' cmake/public_headers.txt | tr '\n' ' ')"
    echo "HTML_EXTRA_STYLESHEET = docs/site/cpp.css"
    echo "GENERATE_LATEX = NO
JAVADOC_AUTOBRIEF = YES
EXTRACT_ALL = YES
QUIET = YES
WARNINGS = NO
WARN_IF_INCOMPLETE_DOC = NO
WARN_IF_DOC_ERROR = NO
HAVE_DOT = NO
GENERATE_TREEVIEW = NO
SEARCHENGINE = YES
SOURCE_BROWSER = NO
VERBATIM_HEADERS = NO"
  } | doxygen -
fi
echo "site: $folder/html/index.html"
