// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/element_defaults.hpp"
#include "md_fitting/fit/observations.hpp"

/// The constants of the GRAY equation of state from molecular dynamics: one weighted nonlinear least-squares
/// problem, one covariance (docs/theory/fit.md).
namespace whipple::fit {

/// What the laws of GRAY leave out even if the data had no noise: part of the weights
/// (docs/theory/fit.md, section 3). All are one standard deviation.
struct ModelErrors {
  double zero_pressure_volume = 1e-4;  ///< relative
  double shock_velocity = 3e-3;        ///< relative, per Hugoniot state: Us-Up is not exactly a line
  double gruneisen = 0.02;             ///< relative, common to an isochore: gamma is not exactly linear in V
  double anharmonic = 1.5e-4;          ///< J/(mol K^2), common to an isochore: the coefficient depends on V
  double thermal_pressure = 2e7;       ///< Pa, per state
  double energy = 50.0;                ///< J/mol, per state: the anharmonic energy is not exactly quadratic in T
  double melting_temperature = 0.01;   ///< relative: Lindemann law

  /// No model error at all: the weights are those of the noise.
  static ModelErrors none() { return {0, 0, 0, 0, 0, 0, 0}; }
};

struct FitSettings {
  double reference_temperature = 293.0;    ///< K: V0 is the volume at zero pressure and this temperature
  double least_particle_velocity = 300.0;  ///< m/s, window of the Hugoniot states
  double most_particle_velocity = 2500.0;  ///< m/s
  /// "band": the solidus T_m(V) - delta_T/2 runs through the coexistence points, as in the default melting
  /// transition of the model; "isochoric": T_m(V) itself does, as in Royce's.
  std::string melting = "band";
  ModelErrors model_errors;
  std::string electronic = "measured";  ///< name of a choice of the element's table, or a quantity
  std::optional<double> density;        ///< kg/m^3: replaces the fitted reference volume by a measured one
};

enum class Origin { fitted, given, by_default };

/// One constant of the material file.
struct Constant {
  std::string name;  ///< key of GRAY's parameter table
  double value = 0.0;  ///< SI
  Origin origin = Origin::by_default;
  double error = 0.0;              ///< 1 sigma from noise and model error; 0 if not fitted
  double statistical_error = 0.0;  ///< 1 sigma from the noise alone
  std::string source;              ///< of a constant that is not fitted: name of the default, and source
};

/// One datum beside the fitted law.
struct Residual {
  std::string quantity;  ///< "volume", "shock_velocity", "thermal_pressure", "thermal_energy", "melting"
  double volume = 0.0;       ///< m^3/kg
  double temperature = 0.0;  ///< K
  double abscissa = 0.0;     ///< up (m/s), thermal energy (J/kg), temperature (K) or pressure (Pa)
  double datum = 0.0;        ///< SI
  double fitted = 0.0;       ///< SI
  double sigma = 0.0;        ///< from both parts of the weights, SI
};

/// gamma of one isochore by itself, with the noise of its points.
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
  double intercept = 0.0, slope = 0.0;
};

struct GrayFit {
  std::string element;
  double molar_mass = 0.0;                 ///< kg/mol
  std::vector<Constant> constants;         ///< all of the material file, in the order of the parameter table
  std::vector<std::string> fitted_names;   ///< of the covariance
  Eigen::MatrixXd covariance;              ///< SI, of the fitted constants
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  std::map<std::string, std::pair<double, int>> chi_squared_parts;  ///< per kind of data: chi^2, number of data
  /// T_m where the solid at coexistence has the volume V0, whatever `melting` is; none without coexistence.
  std::optional<double> melting_at_reference_volume;
  std::vector<Residual> residuals;
  std::vector<IsochoreGruneisen> isochores;
  std::vector<WindowResult> windows;  ///< the fit's own window comes first
  int states_above_melting = 0;       ///< superheated isochore states that were left out
  FitSettings settings;

  [[nodiscard]] const Constant& constant(std::string_view name) const;
  [[nodiscard]] double value(std::string_view name) const { return constant(name).value; }
  /// Correlation matrix of the fitted constants.
  [[nodiscard]] Eigen::MatrixXd correlation() const;
};

/// Fits V0, C, S, gamma0, a, g_anh and, if there is coexistence, T_m0; completes the rest from the element's
/// table.
/// @throws InputError if points are missing (all missing protocols in one message); StateError if the fit
/// does not converge.
GrayFit fit_gray(std::span<const md::PointRecord> points, const FitSettings& settings,
                 const std::string& store_name);

}  // namespace whipple::fit
