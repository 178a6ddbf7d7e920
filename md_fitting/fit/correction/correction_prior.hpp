// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "eos/models/free_energy_spline.hpp"
#include "md_fitting/fit/correction/correction_data.hpp"

/// Describes what is expected of the corrections of GRAY's free energies before the data (docs/theory/fit.md, section
/// 10).
namespace whipple::fit {

/// Holds the grids of the two corrections; coefficients are counted from the common ones to those of the fluid.
struct CorrectionGrids {
  eos::FreeEnergyGrid common, fluid;

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(common.size() + fluid.size()); }
};

/// Returns grids that hold the data: volumes from well below the densest datum, in common to twice V0, for the fluid to
/// beyond the most dilute one.
CorrectionGrids correction_grids(const CorrectionData& data, const eos::GrayFreeEnergy& gray);

/// Describes a random part of the corrections: a Gaussian process with a stated standard deviation.
struct CorrectionPart {
  const char* name;
  Eigen::Index first = 0;      ///< coefficient
  Eigen::MatrixXd covariance;  ///< of its coefficients at f = 1
  double spread = 2.0;         ///< standard deviation of ln f before the data
};

/// Returns the parts: common to both phases, of the fluid alone, and of the expanded fluid; of each a cold one, which
/// does not depend on T, and a thermal one.
/// @param energy  unit of the free energy, C^2, J/kg
std::vector<CorrectionPart> correction_parts(const CorrectionGrids& grids, double energy,
                                             double reference_volume);

/// Returns the row of coefficients of a list of functionals.
Eigen::RowVectorXd coefficient_row(const CorrectionGrids& grids, const std::vector<SurfaceTerm>& terms);

}  // namespace whipple::fit
