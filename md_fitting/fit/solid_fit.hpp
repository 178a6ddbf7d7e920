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

/// The solid's constants from a store: what the fits of all models share.
struct SolidFit {
  Observations data;  ///< without superheated states
  SolidModel model;
  SolidConstants constants;
  /// T_m0 of the curve T_m(V) above which solids are left out; none: not known, all count
  std::optional<double> superheating;
  ModelScale scale;                                    ///< of the model errors, in the window of the settings
  Eigen::MatrixXd covariance, statistical_covariance;  ///< of `model.free`, SI
  Fit report;  ///< everything but constants and words, with GRAY's names; covariances of `model.free`
};

/// Constants that all models need, and that no datum bears: molar mass, reference temperature, 3R/M.
SolidConstants fixed_solid(const Observations& data);

/// Where a fit begins.
struct SolidStart {
  SolidConstants constants;  ///< values of all that are not fitted; the others are guessed from the data
  std::optional<double> melting_temperature;  ///< T_m0; none: known from coexistence points at most
};

/// Solves for `model.free`.
/// @throws InputError if points are missing (all missing protocols in one message); StateError if the fit
/// does not converge
SolidFit fit_solid(Observations data, const SolidModel& model, const SolidStart& known,
                   const FitSettings& settings, const std::string& store_name);

/// Fits other data with the model and the weights of a fit, in the window of the settings, and returns the constants
/// alone: for replicates.
SolidConstants refit_solid(const Observations& data, const SolidFit& fit);

/// Leaves out superheated solid: above T_m(V) the crystal is metastable, and its energy does not follow the
/// law. Returns how many states that were.
/// @param melting  T_m0; without it no state is left out
int remove_superheated(Observations& data, eos::GrayConstants constants, std::optional<double> melting,
                       const std::string& store_name);

}  // namespace whipple::fit
