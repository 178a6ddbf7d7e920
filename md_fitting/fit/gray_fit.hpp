// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_settings.hpp"

/// The constants of the GRAY equation of state from molecular dynamics: one weighted nonlinear least-squares
/// problem, one covariance (docs/theory/fit.md).
namespace whipple::fit {

enum class Origin { fitted, given, by_default };

/// One numerical constant of the material.
struct Constant {
  std::string name;  ///< key of GRAY's parameter table
  std::string unit;  ///< SI
  std::string meaning;
  double value = 0.0;  ///< SI
  Origin origin = Origin::by_default;
  double error = 0.0;              ///< 1 sigma from noise and model error; 0 if not fitted
  double statistical_error = 0.0;  ///< 1 sigma from the noise alone
  std::string source;              ///< of a constant that is not fitted: name of the default, and its source
};

/// One datum beside the fitted law, SI.
struct Residual {
  std::string quantity;  ///< "volume", "shock_velocity", "thermal_pressure", "thermal_energy", "melting"
  double volume = 0.0;
  double temperature = 0.0;
  double abscissa = 0.0;  ///< temperature, up, thermal energy, temperature, pressure
  double datum = 0.0;
  double fitted = 0.0;
  double sigma = 0.0;  ///< from both parts of the weights
};

/// gamma of one isochore by itself: slope of P against E with the noise of its points.
struct IsochoreGruneisen {
  double volume = 0.0;
  double gruneisen = 0.0;
  double error = 0.0;
  int states = 0;
};

/// C and S of one window of particle velocities.
struct WindowResult {
  double least = 0.0, most = 0.0;  ///< m/s
  int states = 0;
  double intercept = 0.0, slope = 0.0;  ///< m/s, 1
};

/// chi^2 of one kind of data.
struct ChiSquaredPart {
  std::string quantity;
  double chi_squared = 0.0;
  int data = 0;
};

/// The complete model of the material against all solid points of one protocol.
struct ModelCheck {
  std::string quantity;  ///< "Hugoniot pressure", ...
  std::string unit;      ///< of the figures below
  int points = 0;
  double rms = 0.0, mean = 0.0, maximum = 0.0;  ///< model less molecular dynamics
};

struct GrayFit {
  std::string element;
  std::string potential;
  eos::GrayConstants gray;                 ///< the model of the material
  std::vector<Constant> constants;         ///< its numbers, in the order of the parameter table
  std::vector<std::string> fitted_names;   ///< of the covariance
  Eigen::MatrixXd covariance;              ///< SI, from noise and model error
  Eigen::MatrixXd statistical_covariance;  ///< SI, from the noise alone
  double fitted_reference_volume = 0.0;    ///< m^3/kg; the material has another if a density was given
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  std::vector<ChiSquaredPart> chi_squared_parts;
  /// T_m0 if the solid melted isochorically: T_m where the solid of the volume V0 coexists with liquid.
  std::optional<double> isochoric_melting_temperature;
  std::vector<Residual> residuals;
  std::vector<IsochoreGruneisen> isochores;
  std::vector<WindowResult> windows;  ///< the fit's own window comes first
  std::vector<ModelCheck> checks;
  int superheated_states = 0;  ///< isochore states above T_m(V), left out
  FitSettings settings;

  [[nodiscard]] const Constant& constant(std::string_view name) const;
  [[nodiscard]] double value(std::string_view name) const { return constant(name).value; }
  [[nodiscard]] Eigen::MatrixXd correlation() const;
};

/// Fits V0, C, S, gamma0, a, g_anh and, if there is coexistence, T_m0; completes the rest from the element's
/// table (element_defaults.hpp).
/// @param store_name  for messages
/// @throws InputError if points are missing (all missing protocols in one message); StateError if the fit
/// does not converge.
GrayFit fit_gray(std::span<const md::PointRecord> points, const FitSettings& settings,
                 const std::string& store_name);

/// A value as it stands in the material file, in the practical unit of its SI unit: "0.1118 cm^3/g", and the
/// value that it reads back to.
std::string practical_quantity(double value, const std::string& si_unit);
double as_written(double value, const std::string& si_unit);

}  // namespace whipple::fit
