// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "md_fitting/fit/joint/variance_components.hpp"
#include "md_fitting/fit/solid_problem.hpp"

/// Describes how simulations with an interatomic potential deviate from the metal (docs/theory/fit.md, section 9).
namespace whipple::fit {

/// Holds typical deviations of potentials from experiments, one standard deviation: where the size estimated for
/// a fit begins.
struct PotentialErrors {
  double shock_velocity = 0.03;  ///< relative
  double gruneisen = 0.05;       ///< relative
  double anharmonic = 2e-4;      ///< J/(mol K^2)
  double melting = 0.05;         ///< of the melting temperature, relative
  double fusion = 0.1;           ///< of the heat of fusion, relative
  // Lengths over which a deviation changes: those of the whole curve, so that it is nearly one factor.
  double particle_velocity = 3000.0;  ///< m/s
  double volume_ratio = 0.3;          ///< of V/V0
  double spread = 1.1;                ///< of the logarithm of a size: a factor of three either way
};

/// Collects the rows of one deviation with its size and place at each of them.
struct DeviatingRows {
  std::vector<Eigen::Index> rows;
  std::vector<double> size, place;

  void add(Eigen::Index row, double deviation, double where);
  /// Appends the component "potential, NAME", smooth over a length of the places, unless it has no rows.
  void finish(const char* name, double length, double spread,
              std::vector<VarianceComponent>& components) const;
};

/// Returns the deviations of the simulated rows: one for each kind of data.
/// @param constants  about which the problem is linearised
std::vector<VarianceComponent> potential_deviations(const SolidProblem& problem, const Observations& data,
                                                    const SolidConstants& constants,
                                                    const PotentialErrors& errors = {});

}  // namespace whipple::fit
