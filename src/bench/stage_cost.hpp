// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "src/case/case.hpp"

namespace whipple::bench {

/// Holds the minimum cost of a stage of the step, per particle.
struct StageCost {
  double bytes = 0.0;
  double flops = 0.0;
};

/// Returns the minimum cost of a stage. Bytes: every field that the stage reads or writes moves once between memory and
/// core, and so do the nodes of the active blocks where the stage sweeps them. Flops: additions and multiplications of
/// the equations on the nodes in the support of a particle, without the constitutive models, which depend on the state.
/// Stages that are not counted cost 0.
/// @param stage  its name in solver::Profile
/// @param nodes_per_particle  ratio of the nodes of the active blocks to the particles
StageCost stage_cost(std::string_view stage, const cases::Case& setup, double nodes_per_particle);

}  // namespace whipple::bench
