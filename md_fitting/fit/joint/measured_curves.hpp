// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/experiments/experiment.hpp"
#include "eos/models/gray_constants.hpp"

/// Prepares measured curves for a fit beside simulations (docs/theory/fit.md, section 9).
namespace whipple::fit {

/// Returns the name of a kind of curve, "shock velocity", ...
std::string kind_name(eos::experiments::ExperimentKind kind);

/// Describes how well the form of GRAY follows a measured curve of a kind: one standard deviation, and the length
/// over which the deviation changes. Values of Us, T, c, c_p and the expansion are relative to the measured one.
struct CurveForm {
  double relative = 0.0;
  double of_bulk_modulus = 0.0;  ///< for pressures: as a change of volume, times rho0 C^2
  double length = 0.0;           ///< in the unit of the abscissa; for pressures in units of rho0 C^2
  double of_table = 0.0;         ///< common relative error of all points of one table: its scale
};
CurveForm form_of(eos::experiments::ExperimentKind kind);

/// Holds a measured curve with the error of each point.
struct MeasuredCurve {
  eos::experiments::Experiment experiment;
  std::vector<double> error;  ///< one standard deviation of the ordinate, SI
  bool stated = false;        ///< the file states the errors; otherwise they are the scatter along the curve
  bool fitted = true;         ///< takes part in the fit; otherwise it is predicted only

  [[nodiscard]] std::size_t points() const { return experiment.abscissa.size(); }
};

/// Reads the tables of one element.
/// @param metal              its name, which a table may state as its material
/// @param debye_temperature  K: heat capacities and expansions are converted to those of classical nuclei
/// @throws InputError for a table of another material, without points, or too large a fit
std::vector<MeasuredCurve> read_curves(std::span<const std::filesystem::path> tables,
                                       const std::string& metal, std::optional<double> debye_temperature);

/// Returns the standard deviation of the points of a curve about a smooth one: from the deviation of every point
/// from the straight line through its neighbours (Gasser, Sroka & Jennen-Steinmetz, Biometrika 73 (1986) 625).
/// @param relative  whether the scatter is one of y/y rather than of y
/// @throws InputError for fewer than four points
std::vector<double> scatter_along(std::span<const double> x, std::span<const double> y, bool relative);

/// Returns the density of the solid from which the shocks of the tables start: the median of those within 1 % of the
/// largest; none if no table states one.
std::optional<double> initial_density(std::span<const MeasuredCurve> curves);

/// Evaluates GRAY along the measured curves.
class CurveModel {
 public:
  /// @throws InputError if the constants make no material
  explicit CurveModel(const eos::GrayConstants& constants);
  /// Returns the ordinates; NaN outside the range of the model.
  [[nodiscard]] std::vector<double> values(const eos::experiments::Experiment& experiment) const;

 private:
  std::unique_ptr<eos::EquationOfState> model_;
  eos::State initial_;
};

}  // namespace whipple::fit
