// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/solver/carriers/particle_carrier.hpp"

namespace whipple::solver {

/// Requires all optional fields that the case needs; a checkpoint of another case may lack some.
void ParticleCarrier::require_fields(bool extent) const {
  Particles needed;
  needed.mass.resize(state_.particles.size());
  for (const auto& material : state_.setup.materials) use_fields(*material, needed);
  if (std::ranges::any_of(state_.setup.bodies, [](const auto& body) { return body.varies_failure(); })) {
    needed.failure_threshold_factor.resize(state_.particles.size());
  }
  if (std::ranges::any_of(state_.setup.bodies,
                          [](const auto& body) { return body.strength_scatter.given(); })) {
    needed.strength_factor.resize(state_.particles.size());
  }
  if (state_.affine_inertia() > 0.0) needed.affine_velocity.resize(state_.particles.size());
  if (extent) needed.extent.resize(state_.particles.size());
  if (state_.keeps_losses()) {
    needed.unresolved_energy.resize(state_.particles.size());
    needed.heat_allowance.resize(state_.particles.size());
    needed.closing_rate.resize(state_.particles.size());
    needed.heating_viscosity.resize(state_.particles.size());
  }
  std::string missing;
  for_each_field(needed, [&](const auto& field) {
    if (field.optional && field.of(needed).size() > field.of(std::as_const(state_.particles)).size()) {
      missing = field.name;
    }
  });
  if (!missing.empty()) {
    throw InputError(fmt::format("the checkpoint has no field \"{}\", which the case needs", missing));
  }
}

}  // namespace whipple::solver
