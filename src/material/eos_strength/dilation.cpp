// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "src/material/eos_strength/parts.hpp"
#include "src/material/strength/brittle.hpp"

namespace whipple::material::parts {
namespace {

constexpr double least_stiffness = 0.1;  ///< dp/d(ln alpha) at least, as a fraction of rho c^2

}  // namespace

void evaluate_dilating(const EosStrength& model, const Step& step, Chunk& chunk) {
  const strength::Brittle& law = *step.material.strength->brittle();
  Lanes& distension = chunk.history[model.distension];
  const TrialEvaluation trial(chunk);
  evaluate_equation_of_state<false>(step, chunk, chunk.view(distension));
  Lanes stiffness, pressure, growth;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double bulk = chunk.density[k] * chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k];
    pressure[k] = chunk.pressure[k] - bulk * chunk.void_volume[k] / chunk.volume[k];
    stiffness[k] = std::max(bulk - chunk.pressure[k], least_stiffness * bulk);  // p = p_s(alpha rho)/alpha
  }
  std::array<SymmetricTensor, chunk_size> deviator;
  if (law.turns_deviator()) {
    for (std::size_t k = 0; k < chunk.size; ++k) deviator[k] = tensor(chunk.motion.deviator, k);
  }
  law.dilate(
      {.stiffness = chunk.view(stiffness),
       .pressure = chunk.view(pressure),
       .void_volume = chunk.view(chunk.void_volume),
       .modulus = chunk.view(chunk.motion.modulus),
       .solid_fraction = chunk.view(chunk.solid_fraction),
       .trial = chunk.view(chunk.motion.trial),
       .distension = chunk.view(distension),
       .deviator = std::span<const SymmetricTensor>(deviator.data(), law.turns_deviator() ? chunk.size : 0),
       .dilation = chunk.view(chunk.dilation),
       .growth = chunk.view(growth)});
  bool any = false;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    if (growth[k] == 0.0) continue;
    distension[k] *= std::exp(growth[k]);
    any = true;
  }
  if (!any) return;
  trial.repeat(model, step, chunk);
  // The flow works against the pressure; the part that its deviator dissipates is not less (docs/theory/soil.md, eq. 9).
  double work = 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) work += chunk.pressure[k] * growth[k] * chunk.volume[k];
  chunk.report.plastic_work -= work;
  chunk.dissipate(-work);
}

}  // namespace whipple::material::parts
