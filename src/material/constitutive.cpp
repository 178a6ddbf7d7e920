// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/constitutive.hpp"

#include <fmt/format.h>

#include "src/core/base/error.hpp"
#include "src/material/chunk.hpp"

namespace whipple::material {

void Constitutive::void_share(const Chunk& chunk, Lanes& share) const {
  for (std::size_t k = 0; k < chunk.size; ++k) {
    const double porosity = chunk.void_volume[k] / (chunk.old_volume[k] + chunk.void_volume[k]);
    share[k] = chunk.intact[k] == 0.0 ? 1.0 : porosity;
  }
}

double Constitutive::maximum_density(const Material& material, const Chunk&, std::size_t) const {
  return material.eos->maximum_density();
}

double Constitutive::least_maximum_density(const Material& material) const {
  return material.eos->maximum_density();
}

std::size_t Constitutive::declare(const HistoryField& field) {
  const std::size_t lane = lanes_;
  lanes_ += components_of(field.rank);
  if (lanes_ >= most_history) {  // the last lane belongs to no field
    throw InternalError(
        fmt::format("the history fields of a material have more than {} components", most_history - 1));
  }
  history_.push_back({field, lane});
  return lane;
}

}  // namespace whipple::material
