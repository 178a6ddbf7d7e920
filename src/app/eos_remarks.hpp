// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/curves/samples.hpp"
#include "src/app/eos_options.hpp"
#include "src/material/material_samples.hpp"

/// Computes lines of text below the tables of `whipple eos`: limits, thresholds and special points of a curve; empty
/// where a model does not provide them.
namespace whipple::app {

using Remarks = std::vector<std::string>;

Remarks state_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks hugoniot_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks release_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks cold_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks melt_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks dome_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks match_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
/// Describes the distribution from which the samples of a material are drawn, and the defaults that are the same in all
/// samples.
Remarks drawn_remarks(const MaterialSamples& drawn);
/// Holds the help text of the option that selects the errors.
inline constexpr const char* tier_help =
    "Errors that the constants are drawn from: noise alone, of the fit and its defaults, over the "
    "potentials, or all";

/// Describes the result of sampling a Hugoniot.
/// @param samples  number of samples drawn
Remarks sample_remarks(const eos::curves::SampledHugoniot& sampled, std::size_t samples);

}  // namespace whipple::app
