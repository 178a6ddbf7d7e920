#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From atoms to debris clouds, the whole way: molecular dynamics of copper, fit of its equation of state, comparison
# with experiments, a copper disk through an aluminium plate, report. A second call redoes what is out of date only.
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: scripts/run.sh [--long] [--force] [--ranks N] [--output DIR] [--set KEY=VALUE]...
  --long           the long plans of molecular dynamics, with melting (an hour or two on two cores)
  --force          redo every step
  --ranks N        MPI ranks of the molecular dynamics (default: the physical cores)
  --output DIR     where everything is written (default: run)
  --set KEY=VALUE  changes a key of the impact case, for example domain.cell_size='0.6 mm'
TEXT
}

length=_short
force=false
output=run
ranks=()
overrides=()
while (($# > 0)); do
  case $1 in
    --long) length= ;;
    --force) force=true ;;
    --ranks) ranks=(--ranks "${2:?--ranks needs a number}"); shift ;;
    --output) output=${2:?--output needs a folder}; shift ;;
    --set) overrides+=(--set "${2:?--set needs KEY=VALUE}"); shift ;;
    -h | --help) usage; exit 0 ;;
    *) echo "run.sh: unknown option '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done

case_file=cases/copper_disk_on_aluminium/case.toml
store=$output/copper_mishin$length.md.h5       # the potential whose material flies
second=$output/copper_u3$length.md.h5           # a second one, beside it in the table
simulated=$output/copper_simulated.toml         # corrected to follow the simulations alone
material=$output/copper_fitted.toml             # to simulations and measurements: the one that flies
measured=(eos/data/cu_hugoniot_marsh1980.csv eos/data/cu_isotherm_298K_dewaele2004.csv eos/data/cu_melting.csv
  eos/data/cu_thermal_expansion_nist_hahn1.csv)
unseen=eos/data/cu_isentrope_fratanduono2020.csv  # predicted only
comparison=$output/compare.png
impact=$output/copper_disk_on_aluminium
stamps=$output/.finished
whipple=build/release/bin/whipple

begin=$SECONDS
stage() {
  echo
  echo "== $1 ($((SECONDS - begin)) s) =="
}
# up_to_date STEP INPUT...: the step finished, with these inputs and this command line, and none is newer than its end
up_to_date() {
  local stamp=$stamps/$1 input
  shift
  $force && return 1
  [[ -f $stamp && $(<"$stamp") == "$*" ]] || return 1
  for input in "$@"; do
    [[ -e $input && $input -nt $stamp ]] && return 1
  done
  return 0
}
finished() {
  local stamp=$stamps/$1
  shift
  printf '%s' "$*" >"$stamp"
}

stage "packages and build"
scripts/install_deps.sh
configured=$(cmake --preset release 2>&1) || { echo "$configured"; exit 1; }
echo "building: about five minutes on two idle cores"
cmake --build --preset release --parallel "$(nproc)" --target whipple whipple-md whipple-fit -- --quiet
mkdir -p "$output" "$stamps"

stage "1/5 molecular dynamics: copper, two potentials"
# The store knows which points it holds: an interrupted or changed plan computes what is missing.
for result in "$store" "$second"; do
  plan=cases/md/$(basename "$result" .md.h5).toml
  if $force; then rm -f "$result"; fi
  # What was measured at each point goes into a file, its place and duration to the terminal.
  "$whipple" md "$plan" -o "$result" "${ranks[@]}" 2>&1 | tee "${result%.md.h5}.log" |
    sed -uE 's/^([a-z][^:=]*)( at [^:]*)?: .* (\[[0-9.]+ [a-z]+\])$/\1\2 \3/'
  echo "written: $result (measured values: ${result%.md.h5}.log)"
done

stage "2/5 fit of the equation of state"
# Simulations alone, then with measurements: the potential is soft, and keeps what only atoms know. The density at rest is
# the measured one (0.1118 cm^3/g).
inputs=("$store" "$second" build/release/bin/whipple-fit eos/materials/copper.toml "${measured[@]}" "$unseen")
if up_to_date fit "${inputs[@]}"; then
  echo "up to date: $material"
else
  "$whipple" fit "$store" "$second" >"$output/fit_both.txt"
  "$whipple" fit "$store" -o "$simulated" --density "8.9445 g/cm^3" --correct --plot "$output/fit.png" --force \
    >"$output/fit_simulated.txt"
  "$whipple" fit "$store" -o "$material" --density "8.9445 g/cm^3" --with "${measured[@]}" --check "$unseen" --force \
    >"$output/fit.txt"
  finished fit "${inputs[@]}"
fi
sed '/^published rows/q' "$output/fit_both.txt"
sed -n '/^correction of the free energy/,/^sizes/p' "$output/fit_simulated.txt"
sed -n '/^fit to simulations and measurements/,/^sizes of the deviations/{/^sizes/!p}' "$output/fit.txt"
echo "written: $material ($simulated without the measurements; all about the fits: $output/fit.txt,"
echo "  $output/fit_simulated.txt, $output/fit_both.txt)"

stage "3/5 comparison with experiments"
inputs=("$material" "$simulated" build/release/bin/whipple eos/materials/copper.toml "${measured[@]}" "$unseen")
if up_to_date compare "${inputs[@]}"; then
  echo "up to date: $comparison"
  cat "$output/compare.txt"
else
  "$whipple" compare "$material" "$simulated" eos/materials/copper.toml \
    --with eos/data/cu_hugoniot_marsh1980.csv eos/data/cu_isotherm_298K_dewaele2004.csv "$unseen" \
    --plot "$comparison" --force | tee "$output/compare.txt"
  finished compare "${inputs[@]}"
fi

stage "4/5 impact: $case_file"
inputs=("$material" "$case_file" eos/materials/aluminium.toml build/release/bin/whipple "${overrides[@]}")
if up_to_date impact "${inputs[@]}"; then
  echo "up to date: $impact"
elif ! $force && [[ -f $stamps/impact_begun && $(<"$stamps/impact_begun") == "${inputs[*]}" &&
  ! $material -nt $stamps/impact_begun && ! $case_file -nt $stamps/impact_begun &&
  ! $whipple -nt $stamps/impact_begun ]] &&
  compgen -G "$impact/checkpoint/*.h5" >/dev/null; then
  echo "going on with an interrupted run"
  "$whipple" run --restart "$impact"
  finished impact "${inputs[@]}"
else
  rm -f "$stamps/impact"
  finished impact_begun "${inputs[@]}"
  "$whipple" run "$case_file" -o "$impact" --force --set body.0.material="$(realpath "$material")" "${overrides[@]}"
  finished impact "${inputs[@]}"
fi
echo "written: $impact"

stage "5/5 report"
inputs=("$stamps/impact" "$comparison" report/*.py)
if up_to_date report "${inputs[@]}"; then
  echo "up to date"
else
  "$whipple" report "$impact" --figure "Equation of state and experiments=$comparison" --figure "Fit=$output/fit.png"
  finished report "${inputs[@]}"
fi

echo
echo "done in $((SECONDS - begin)) s; open $impact/report/report.html"
