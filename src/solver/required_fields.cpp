// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "src/core/base/error.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

/// A checkpoint of the same case holds the optional fields that it needs; of another case, perhaps not.
void Simulation::require_fields() const {
  Particles needed;
  needed.mass.resize(particles_.size());
  for (const auto& material : setup_.materials) use_fields(*material, needed);
  if (std::ranges::any_of(setup_.bodies, [](const auto& body) { return body.failure_scatter.given(); })) {
    needed.failure_threshold_factor.resize(particles_.size());
  }
  if (carries_affine_velocity()) needed.affine_velocity.resize(particles_.size());
  if (carries_extent()) needed.extent.resize(particles_.size());
  if (setup_.dissipation.keeps_losses()) {
    needed.unresolved_energy.resize(particles_.size());
    needed.closing_rate.resize(particles_.size());
    needed.heating_viscosity.resize(particles_.size());
  }
  std::string missing;
  for_each_field<Particles>([&](const auto& field) {
    if (field.optional && (needed.*(field.values)).size() > (particles_.*(field.values)).size()) {
      missing = field.name;
    }
  });
  if (!missing.empty()) {
    throw InputError(fmt::format("the checkpoint has no field \"{}\", which the case needs", missing));
  }
}

}  // namespace whipple::solver
