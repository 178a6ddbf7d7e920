// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "md_fitting/data_set/crystal_structure.hpp"

namespace whipple::md {

/// Holds the three functions of an embedded-atom potential of one element (Daw and Baskes, Phys. Rev. B 29 (1984)
/// 6443): E = sum_i F(rho_i) + 1/2 sum_ij phi(r_ij), rho_i = sum_j f(r_ij). LAMMPS units: eV, A, g/mol; the density
/// is in the unit of the file. Lattice sums of a static crystal are exact up to the interpolation of the tables.
struct EamTables {
  std::string element;
  double mass = 0.0;                     ///< g/mol
  double header_lattice_constant = 0.0;  ///< A, as given in the file; some files give 0
  std::string header_structure;          ///< as given in the file; may differ from the structure
  CrystalStructure structure = CrystalStructure::fcc;  ///< fcc or bcc
  double density_step = 0.0;
  std::vector<double> embedding;          ///< F at i * density_step, eV
  double radius_step = 0.0;               ///< A
  std::vector<double> density;            ///< f at i * radius_step
  std::vector<double> radius_times_pair;  ///< r phi(r) at i * radius_step, eV A
  double cutoff = 0.0;                    ///< A
  double fitted_density = 0.0;            ///< largest density to which F was fitted; 0: unknown

  /// Returns the largest tabulated density. LAMMPS silently extrapolates F linearly beyond it.
  [[nodiscard]] double density_end() const;
  /// Returns rho at an atom of the static crystal with lattice constant a (A).
  [[nodiscard]] double crystal_density(double a) const;
  /// Returns the energy per atom (eV) of the static crystal with lattice constant a (A).
  [[nodiscard]] double crystal_energy(double a) const;
  /// Returns the energy per atom (eV) of static hcp with the ideal axial ratio at a volume per atom (A^3).
  [[nodiscard]] double hexagonal_energy(double volume) const;
  /// Returns the lattice constant (A) of minimum energy near that of the header (between 2 and 8 A if it gives none).
  /// @throws InputError if there is no minimum in that interval.
  [[nodiscard]] double static_lattice_constant() const;
  /// Returns V/V0 of the static crystal, V0 at its minimum energy, at which its electron density reaches `density`;
  /// 0 if it is not reached for V/V0 >= 0.1.
  [[nodiscard]] double volume_ratio_at(double density) const;
  [[nodiscard]] int atoms_per_cell() const { return md::atoms_per_cell(structure); }
};

}  // namespace whipple::md
