// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"
#include "md_fitting/fit/fit_result.hpp"
#include "md_fitting/fit/least_squares.hpp"
#include "md_fitting/fit/observations.hpp"
#include "md_fitting/fit/solid_constants.hpp"
#include "md_fitting/fit/solid_problem.hpp"

namespace whipple::fit {

/// Holds the constants of the solid fitted to a database, the common part of the fits of all models.
struct SolidFit {
  Observations data;  ///< without superheated states
  SolidModel model;
  SolidConstants constants;
  /// T_m0 of the curve T_m(V) above which solid states are excluded; none: unknown, all states are used.
  std::optional<double> superheating;
  ModelScale scale;  ///< scale of the model errors, in the window of the settings
  Eigen::MatrixXd covariance, statistical_covariance;  ///< of `model.free`, SI
  Fit report;  ///< everything except constants and words, with GRAY's names; covariances of `model.free`
};

/// Returns the constants that all models need and no datum determines: molar mass, reference temperature, 3R/M.
SolidConstants fixed_solid(const Observations& data);

/// Holds the starting point of a fit.
struct SolidStart {
  SolidConstants constants;                   ///< values that are not fitted; others are estimated
  std::optional<double> melting_temperature;  ///< T_m0; none: known at most from coexistence points
};

/// Solves for `model.free`.
/// @throws InputError if points are missing (all missing protocols in one message); StateError if the fit
/// does not converge
SolidFit fit_solid(Observations data, const SolidModel& model, const SolidStart& known,
                   const FitSettings& settings, const std::string& store_name);

/// Fits other data with the model and the weights of a given fit, in the window of the settings, and returns only
/// the constants; used for bootstrap replicates.
SolidConstants refit_solid(const Observations& data, const SolidFit& fit);

/// Removes superheated solid states and returns their number: above T_m(V) the crystal is metastable, and its
/// energy does not follow the law.
/// @param melting  T_m0; none: no state is removed
int remove_superheated(Observations& data, eos::GrayConstants constants, std::optional<double> melting,
                       const std::string& store_name);

}  // namespace whipple::fit
