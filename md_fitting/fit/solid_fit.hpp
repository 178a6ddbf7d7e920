// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  ModelScale scale;                                    ///< of the model errors, in the window of the settings
  Eigen::MatrixXd covariance, statistical_covariance;  ///< of `model.free`, SI
  Fit report;  ///< everything but constants and words, with GRAY's names; covariances of `model.free`
};

/// Constants that all models need, and that no datum bears: molar mass, reference temperature, 3R/M.
SolidConstants fixed_solid(const Observations& data);

/// Solves for `model.free`.
/// @param start  values of all constants that are not fitted; the others are guessed from the data
/// @throws InputError if points are missing (all missing protocols in one message); StateError if the fit
/// does not converge
SolidFit fit_solid(Observations data, const SolidModel& model, const SolidConstants& start,
                   const FitSettings& settings, const std::string& store_name);

/// Fits other data with the model and the weights of a fit, in the window of the settings, and returns the constants
/// alone: for replicates.
SolidConstants refit_solid(const Observations& data, const SolidFit& fit);

/// Leaves out superheated solid: above T_m(V) the crystal is metastable, and its energy does not follow the
/// law.
int remove_superheated(Observations& data, const eos::GrayConstants& constants,
                       const std::string& store_name);

}  // namespace whipple::fit
