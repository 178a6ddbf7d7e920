// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/strength/foam.hpp"

#include <algorithm>

#include "src/material/eos_strength/parts.hpp"

namespace whipple::material::parts {

void evaluate_foam(const EosStrength& model, const Step& step, Chunk& chunk) {
  Lanes& distension = chunk.history[model.distension];
  const TrialEvaluation trial(chunk);
  evaluate_equation_of_state<false>(step, chunk, chunk.view(distension));
  Lanes bulk, equivalent, work;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    bulk[k] = chunk.density[k] * chunk.bulk_sound_speed[k] * chunk.bulk_sound_speed[k];
  }
  model.foam->crush({.bulk_modulus = chunk.view(bulk),
                     .modulus = chunk.view(chunk.motion.modulus),
                     .trial = chunk.view(chunk.motion.trial),
                     .pressure = chunk.view(chunk.pressure),
                     .equivalent = chunk.view(equivalent),
                     .distension = chunk.view(distension),
                     .plastic_strain = chunk.view(chunk.plastic_strain),
                     .plastic_increment = chunk.view(chunk.increment),
                     .dissipation = chunk.view(work)});
  double sum = 0.0;
  for (std::size_t k = 0; k < chunk.size; ++k) {
    sum += work[k] * chunk.volume[k];
    if (!(equivalent[k] < chunk.motion.trial[k])) continue;
    for (Lanes& lane : chunk.motion.deviator) lane[k] *= equivalent[k] / chunk.motion.trial[k];
  }
  if (!(sum > 0.0)) return;
  trial.repeat(model, step, chunk);
  chunk.report.plastic_work += sum;
  chunk.dissipate(sum);
}

}  // namespace whipple::material::parts
