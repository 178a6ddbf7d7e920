// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/lammps/potential.hpp"

/// Computes vibrations of a crystal about its sites, and the quantum corrections to the thermodynamics of classical
/// nuclei (docs/theory/molecular_dynamics.md, "Quantum nuclei").
namespace whipple::md {

/// Holds the force constants of a periodic crystal of n x n x n cubic cells with one atom in the primitive cell
/// (fcc or bcc).
struct ForceConstants {
  std::int64_t cells = 0;
  double mass = 0.0;  ///< g/mol
  /// Site of each atom relative to that of the displaced one, in halves of the lattice constant.
  std::vector<std::array<std::int64_t, 3>> sites;
  /// d^2 U/(du_i(displaced) du_k(atom)), eV/A^2, row by row.
  std::vector<std::array<double, 9>> matrices;
};

/// Returns the angular frequencies (1/s) of all 3 N - 3 vibrations of the crystal, N the number of its sites: the
/// square roots of the eigenvalues of its dynamical matrix at all wave vectors compatible with the periodicity. The
/// order is unspecified.
/// @throws StateError if the square of a frequency is negative: the crystal is unstable.
std::vector<double> vibration_frequencies(const ForceConstants& constants);

/// Holds the excess of quantum over classical oscillators, J and J/K per vibration.
struct QuantumExcess {
  double free_energy = 0.0;
  double energy = 0.0;
  double heat_capacity = 0.0;
};

/// Returns the mean over vibrations of these angular frequencies (1/s) at a temperature (K).
QuantumExcess quantum_excess(std::span<const double> frequencies, double temperature);

/// Measures the force constants by moving one atom of the crystal (both signs of each axis).
/// @param specific_volume m^3/kg
/// @param displacement    A
/// @param transcript      the LAMMPS commands are appended to it
ForceConstants measure_force_constants(const Potential& potential, double specific_volume, std::int64_t cells,
                                       double displacement, std::string& transcript);

}  // namespace whipple::md
