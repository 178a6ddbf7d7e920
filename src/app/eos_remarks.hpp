// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/curves/samples.hpp"
#include "src/app/eos_options.hpp"

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
/// @param samples  number of samples drawn
Remarks sample_remarks(const eos::curves::SampledHugoniot& sampled, std::size_t samples);

}  // namespace whipple::app
