// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "md_fitting/elements/element_defaults.hpp"
#include "md_fitting/elements/needs.hpp"
#include "md_fitting/fit/bootstrap.hpp"
#include "md_fitting/fit/correction/correction_fit.hpp"
#include "md_fitting/fit/cross_validation.hpp"
#include "md_fitting/fit/fit_settings.hpp"
#include "md_fitting/fit/joint/joint_result.hpp"
#include "md_fitting/fit/observations.hpp"

/// Defines the result of a fit, independent of the model.
namespace whipple::fit {

enum class Origin { fitted, given, by_default };
using elements::Evidence;
using elements::fit_models;
using elements::FitModel;

/// Holds one numerical constant of the material.
struct Constant {
  std::string name;  ///< key of the model's parameter table
  std::string unit;  ///< SI
  std::string meaning;
  double value = 0.0;  ///< SI
  Origin origin = Origin::by_default;
  /// 1 sigma: from noise and model error for a fitted constant, otherwise from its source; 0: unknown.
  double error = 0.0;
  double statistical_error = 0.0;  ///< 1 sigma from the noise alone
  std::string source;              ///< for a constant that is not fitted: name of the default and its source
  Evidence evidence = Evidence::chosen;  ///< for a constant that is not fitted
  std::string error_source{};            ///< source of the error of a constant that is not fitted
};

/// Holds one datum and the value of the fitted law, SI.
struct Residual {
  std::string quantity;  ///< "volume", "shock_velocity", "isotherm_pressure", "thermal_pressure",
                         ///< "thermal_energy", "melting", "latent_heat", "liquid_density", "vapour_density"
  double volume = 0.0;
  double temperature = 0.0;
  /// In the order of the quantities: temperature, up, volume, thermal energy, temperature, pressure, pressure,
  /// temperature (both densities).
  double abscissa = 0.0;
  double datum = 0.0;
  double fitted = 0.0;
  double sigma = 0.0;  ///< from noise and model error
};

/// Holds gamma of a single isochore: slope of P against E, weighted with the noise of its points.
struct IsochoreGruneisen {
  double volume = 0.0;
  double gruneisen = 0.0;
  double error = 0.0;
  int states = 0;
};

/// Holds C and S of one window of particle velocities.
struct WindowResult {
  double least = 0.0, most = 0.0;  ///< m/s
  int states = 0;
  double weight = 0.0;                  ///< weight in the mean over the windows
  double intercept = 0.0, slope = 0.0;  ///< m/s, 1
};

/// Holds chi^2 of one kind of data.
struct ChiSquaredPart {
  std::string quantity;
  double chi_squared = 0.0;
  int data = 0;
  double inflation = 1.0;  ///< factor on the stated model error
};

/// Holds the deviation of the complete material model from all points of one protocol.
struct ModelCheck {
  std::string quantity;  ///< "Hugoniot pressure", ...
  std::string unit;      ///< unit of the values below
  int points = 0;
  double rms = 0.0, mean = 0.0, maximum = 0.0;  ///< model minus molecular dynamics
};

struct Fit {
  FitModel model = FitModel::gray;
  std::string element;
  std::string potential;
  std::vector<Constant> constants;  ///< of the material, in the order of the model's parameter table
  std::vector<std::pair<std::string, std::string>> words;  ///< constants given as words: "melting", "band"
  std::vector<std::string> fitted_names;                   ///< names of the rows of the covariance
  Eigen::MatrixXd covariance;                              ///< SI, from noise and model error
  Eigen::MatrixXd statistical_covariance;                  ///< SI, from the noise alone
  double fitted_reference_volume = 0.0;  ///< m^3/kg; the material uses another if a density was given
  double molar_mass = 0.0;               ///< kg/mol
  double gruneisen = 0.0, gruneisen_slope = 0.0;  ///< gamma0 and a of gamma = gamma0 - a (1 - V/V0)
  double chi_squared = 0.0;
  int degrees_of_freedom = 0;
  std::vector<ChiSquaredPart> chi_squared_parts;
  std::vector<LeaveOneOut> left_out;
  std::vector<std::string> left_out_names;  ///< names of the constants in `left_out`
  std::optional<BootstrapResult> bootstrap;
  std::optional<JointResult>
      joint;  ///< with measurements in the fit; chi^2 and residuals are of the simulations alone
  std::optional<CorrectionResult> correction;  ///< of the free energies of GRAY
  /// T_m0 for isochoric melting: T_m where the solid at volume V0 coexists with liquid.
  std::optional<double> isochoric_melting_temperature;
  std::vector<Residual> residuals;
  std::vector<IsochoreGruneisen> isochores;
  std::vector<WindowResult> windows;  ///< the window of chi^2 and the residuals comes first
  NucleiComparison nuclei;
  std::vector<ModelCheck> checks;
  std::vector<std::string> remarks;
  int superheated_states = 0;  ///< isochore states above T_m(V), excluded
  FitSettings settings;

  [[nodiscard]] const Constant& constant(std::string_view name) const;
  [[nodiscard]] double value(std::string_view name) const { return constant(name).value; }
  [[nodiscard]] Eigen::MatrixXd correlation() const;
};

}  // namespace whipple::fit
