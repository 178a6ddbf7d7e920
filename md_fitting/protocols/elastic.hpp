// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/lammps/potential.hpp"

namespace whipple::md {

/// Elastic constants of a static cubic crystal: the coefficients of stress against strain, at a pressure
/// other than zero those of Birch (Barron, Klein, Proc. Phys. Soc. 85 (1965) 523). Errors are those of the
/// strain series.
struct ElasticResult {
  Estimate c11, c12, c44;        ///< Pa
  Estimate bulk_modulus;         ///< Pa
  Estimate shear_modulus_voigt;  ///< Pa, of a polycrystal at uniform strain
  Estimate shear_modulus_reuss;  ///< Pa, of a polycrystal at uniform stress
  Estimate shear_modulus_hill;   ///< Pa, their mean
  double pressure = 0.0;         ///< Pa
  std::string transcript;

  /// Born's criteria: the crystal withstands any small strain.
  [[nodiscard]] bool stable() const {
    return c11.value > c12.value && c44.value > 0.0 && c11.value + 2.0 * c12.value > 0.0;
  }
};

/// Stress differences at strains of both signs, extrapolated to zero strain
/// (docs/theory/molecular_dynamics.md, "Elastic constants"). Atoms of fcc and bcc crystals are centres of
/// symmetry, so nothing relaxes.
ElasticResult measure_elastic(const Potential& potential, double specific_volume, double largest_strain,
                              std::int64_t strains);

/// Value at x = 0 of the line through y(x), and how well it is known: the larger of its standard error and
/// its distance from the first entry.
Estimate extrapolate_to_zero(std::span<const double> x, std::span<const double> y);

}  // namespace whipple::md
