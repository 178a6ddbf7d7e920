// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/curves/samples.hpp"
#include "src/app/eos_options.hpp"
#include "src/material/material_samples.hpp"

/// Lines of text below the tables of `whipple eos`: limits, thresholds, points of a curve that it is remarkable for.
/// Nothing where a model does not know it.
namespace whipple::app {

using Remarks = std::vector<std::string>;

Remarks state_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks hugoniot_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks release_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks cold_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks melt_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks dome_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
Remarks match_remarks(const EosOptions& options, const eos::curves::Subjects& subjects);
/// What the samples of a material are drawn from, and which defaults are the same in all of them.
Remarks drawn_remarks(const MaterialSamples& drawn);
/// Of the option that selects the errors.
inline constexpr const char* tier_help =
    "Errors that the constants are drawn from: noise alone, of the fit and its defaults, over the "
    "potentials, or all";

/// @param samples  number of samples drawn
Remarks sample_remarks(const eos::curves::SampledHugoniot& sampled, std::size_t samples);

}  // namespace whipple::app
