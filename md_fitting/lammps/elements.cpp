// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/elements.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace whipple::md {
namespace {

constexpr std::array<const char*, 103> symbols = {
    "H",  "He", "Li", "Be", "B",  "C",  "N",  "O",  "F",  "Ne", "Na", "Mg", "Al", "Si", "P",
    "S",  "Cl", "Ar", "K",  "Ca", "Sc", "Ti", "V",  "Cr", "Mn", "Fe", "Co", "Ni", "Cu", "Zn",
    "Ga", "Ge", "As", "Se", "Br", "Kr", "Rb", "Sr", "Y",  "Zr", "Nb", "Mo", "Tc", "Ru", "Rh",
    "Pd", "Ag", "Cd", "In", "Sn", "Sb", "Te", "I",  "Xe", "Cs", "Ba", "La", "Ce", "Pr", "Nd",
    "Pm", "Sm", "Eu", "Gd", "Tb", "Dy", "Ho", "Er", "Tm", "Yb", "Lu", "Hf", "Ta", "W",  "Re",
    "Os", "Ir", "Pt", "Au", "Hg", "Tl", "Pb", "Bi", "Po", "At", "Rn", "Fr", "Ra", "Ac", "Th",
    "Pa", "U",  "Np", "Pu", "Am", "Cm", "Bk", "Cf", "Es", "Fm", "Md", "No", "Lr"};

// 0: no standard atomic weight.
constexpr std::array weights = {
    1.008,  4.0026, 6.94,   9.0122, 10.81,  12.011, 14.007, 15.999, 18.998, 20.180, 22.990, 24.305,
    26.982, 28.085, 30.974, 32.06,  35.45,  39.95,  39.098, 40.078, 44.956, 47.867, 50.942, 51.996,
    54.938, 55.845, 58.933, 58.693, 63.546, 65.38,  69.723, 72.630, 74.922, 78.971, 79.904, 83.798,
    85.468, 87.62,  88.906, 91.224, 92.906, 95.95,  0.0,    101.07, 102.91, 106.42, 107.87, 112.41,
    114.82, 118.71, 121.76, 127.60, 126.90, 131.29, 132.91, 137.33, 138.91, 140.12, 140.91, 144.24,
    0.0,    150.36, 151.96, 157.25, 158.93, 162.50, 164.93, 167.26, 168.93, 173.05, 174.97, 178.49,
    180.95, 183.84, 186.21, 190.23, 192.22, 195.08, 196.97, 200.59, 204.38, 207.2,  208.98, 0.0,
    0.0,    0.0,    0.0,    0.0,    0.0,    232.04, 231.04, 238.03};

}  // namespace

std::string element_symbol(int atomic_number) {
  return atomic_number >= 1 && atomic_number <= static_cast<int>(symbols.size())
             ? symbols[static_cast<std::size_t>(atomic_number) - 1]
             : std::string("unknown");
}

std::optional<int> atomic_number(const std::string& symbol) {
  const auto* const found = std::find(symbols.begin(), symbols.end(), symbol);
  if (found == symbols.end()) return std::nullopt;
  return static_cast<int>(found - symbols.begin()) + 1;
}

std::optional<double> standard_atomic_weight(const std::string& symbol) {
  const std::optional<int> number = atomic_number(symbol);
  if (!number || *number > static_cast<int>(weights.size())) return std::nullopt;
  const double weight = weights[static_cast<std::size_t>(*number) - 1];
  return weight > 0.0 ? std::optional(weight) : std::nullopt;
}

}  // namespace whipple::md
