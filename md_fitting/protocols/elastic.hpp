// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/lammps/potential.hpp"

namespace whipple::md {

/// Holds the elastic constants of a static cubic crystal: the coefficients of stress with respect to strain, at nonzero
/// pressure those of Birch (Barron, Klein, Proc. Phys. Soc. 85 (1965) 523). Errors are those of the strain series.
struct ElasticResult : ElasticPoint {
  std::string transcript;

  /// Returns whether Born's criteria hold: the crystal is stable against any small strain.
  [[nodiscard]] bool stable() const {
    return c11.value > c12.value && c44.value > 0.0 && c11.value + 2.0 * c12.value > 0.0;
  }
};

/// Measures stress differences at strains of both signs, extrapolated to zero strain
/// (docs/theory/molecular_dynamics.md, "Elastic constants"). Atoms of fcc and bcc crystals are centres of symmetry,
/// so that there is no internal relaxation.
ElasticResult measure_elastic(const Potential& potential, double specific_volume, double largest_strain,
                              std::int64_t strains);

/// Returns the value at x = 0 of the line through y(x); its error is the larger of the standard error and the
/// distance from the first entry.
Estimate extrapolate_to_zero(std::span<const double> x, std::span<const double> y);

}  // namespace whipple::md
