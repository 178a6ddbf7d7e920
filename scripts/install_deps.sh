#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages of Debian 12 that the project is built from. A second call finds nothing to do.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/install_deps.sh [--dev] [--kim] [--paraview] [--roots] [--site] [--step] [--list] [--names]
  --dev        also clang-tidy-19 (scripts/lint.sh), zsh, fish and man (test app_completion)
  --kim        also the models of OpenKIM (250 MB): more interatomic potentials for `whipple md`
  --paraview   also ParaView with its Python interface and a virtual screen (tests of the output files)
  --roots      also mmdebstrap, and compiler and emulator for arm64: other Debians and processors (tests packages_installed,
               other_processor, other_compilers)
  --site       also Sphinx with MyST and Furo, KaTeX, Node, Doxygen, Chromium (scripts/site.sh and its test)
  --step       also gmsh (180 MB): bodies from STEP files
  --list       print the packages and whether each is installed; install nothing
  --names      print the names of the packages; install nothing
TEXT
}

packages=(
  g++ cmake ninja-build ccache mold git python3
  liblammps-dev lammps lammps-data
  libopenmpi-dev openmpi-bin libhdf5-openmpi-dev zlib1g-dev libp4est-dev
  libeigen3-dev libgsl-dev libboost-dev
  libcli11-dev libspdlog-dev libfmt-dev libtomlplusplus-dev libudunits2-dev nlohmann-json3-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  python3-numpy python3-h5py python3-matplotlib python3-dev pybind11-dev
  clang-format-19
  dpkg-dev file
)
list=false names=false
for argument in "$@"; do
  case $argument in
    --dev) packages+=(clang-tidy-19 zsh fish man-db) ;;
    --kim) packages+=(openkim-models) ;;
    --paraview) packages+=(paraview python3-paraview xvfb xauth) ;;
    --roots) packages+=(mmdebstrap qemu-user-static g++-12-aarch64-linux-gnu) ;;
    --site) packages+=(python3-sphinx python3-myst-parser furo libjs-katex nodejs doxygen chromium chromium-driver) ;;
    --step) packages+=(gmsh) ;;
    --list) list=true ;;
    --names) names=true ;;
    -h | --help) usage; exit 0 ;;
    *) echo "install_deps.sh: unknown option '$argument'" >&2; usage >&2; exit 2 ;;
  esac
done

if $names; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_deps.sh: this is not Debian or Ubuntu (no apt). Install the counterparts of:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 2
fi

is_installed() {
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

missing=()
for package in "${packages[@]}"; do
  if is_installed "$package"; then
    $list && echo "installed  $package"
  else
    $list && echo "missing    $package"
    missing+=("$package")
  fi
done
$list && exit 0

if ((${#missing[@]} == 0)); then
  echo "all ${#packages[@]} packages are installed"
  exit 0
fi

privileged=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "install_deps.sh: needs root to install: ${missing[*]}" >&2
    exit 2
  fi
  privileged=(sudo)
fi

echo "installing: ${missing[*]}"
"${privileged[@]}" apt-get update -qq
"${privileged[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq -o Dpkg::Use-Pty=0 --no-install-recommends "${missing[@]}"
echo "installed ${#missing[@]} packages"
