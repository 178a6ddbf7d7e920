// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/lammps/validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/lammps/units.hpp"

namespace whipple::md {
namespace {

constexpr double clearly = 1e-3;  // eV per atom
constexpr double step = 0.0025;   // of V/V0

/// Returns the pressure (Pa) of the static crystal at a volume per atom (A^3).
double static_pressure(const EamTables& tables, double volume) {
  constexpr double small = 1e-3;
  const auto energy = [&](double v) { return tables.crystal_energy(std::cbrt(v * tables.atoms_per_cell())); };
  return -(energy(volume * (1.0 + small)) - energy(volume * (1.0 - small))) / (2.0 * small * volume) *
         metal::pressure_from_energy * metal::bar;
}

}  // namespace

Validity validity_of(const EamTables& tables, double least_volume_ratio) {
  EamTables other = tables;
  other.structure = tables.structure == CrystalStructure::fcc ? CrystalStructure::bcc : CrystalStructure::fcc;
  const double v0 = std::pow(tables.static_lattice_constant(), 3) / tables.atoms_per_cell();
  constexpr double least_of_all = 0.2;  // beyond the range of all potentials of metals
  const double end = std::max(least_volume_ratio, least_of_all);
  for (double ratio = 1.0 - step; ratio > end; ratio -= step) {
    const double volume = ratio * v0;
    const double a = std::cbrt(volume * tables.atoms_per_cell());
    const double pressure = static_pressure(tables, volume);
    const double energy = tables.crystal_energy(a) - clearly;
    const auto beyond = [&](CrystalStructure structure) {
      return Validity{pressure, fmt::format("{} has less energy than {} at V/V0 = {:.3f}", word_of(structure),
                                            word_of(tables.structure), ratio)};
    };
    if (other.crystal_energy(std::cbrt(volume * other.atoms_per_cell())) < energy)
      return beyond(other.structure);
    if (tables.hexagonal_energy(volume) < energy) return beyond(CrystalStructure::hcp);
    if (tables.fitted_density > 0.0 && tables.crystal_density(a) > tables.fitted_density) {
      return {
          pressure,
          fmt::format("the embedding function was not fitted to the densities below V/V0 = {:.3f}", ratio)};
    }
  }
  if (least_volume_ratio < least_of_all) return {};
  return {static_pressure(tables, least_volume_ratio * v0),
          fmt::format("the density table ends, states below V/V0 = {:.3f} are refused", least_volume_ratio)};
}

}  // namespace whipple::md
