// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "eos/modifiers/modified.hpp"

namespace whipple::eos {

/// Models material with fragments held apart by its strength model (bulking): p = p_s(alpha rho, e)/alpha with the
/// distension alpha of the batch, which is unchanged; without one, the material itself. Wrapped around the equation
/// of state of such a material by `make_material` (docs/theory/concrete_and_ceramics.md, section 4).
class Distended final : public Modified {
 public:
  using Modified::Modified;

  RangeReport evaluate(const Batch& batch) const override {
    if (batch.distension.empty()) return base().evaluate(batch);
    return in_chunks(batch, [this](Batch part) {
      ModifierScratch density;
      const std::size_t size = part.density.size();
      for (std::size_t i = 0; i < size; ++i) density[i] = part.density[i] * part.distension[i];
      Batch matter = part;
      matter.density = {density.data(), size};
      matter.distension = {};
      const RangeReport report = base().evaluate(matter);
      for (std::size_t i = 0; i < size; ++i) part.pressure[i] /= part.distension[i];
      return report;
    });
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return base().state(density, specific_internal_energy);
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return base().state_at_temperature(density, temperature);
  }
  [[nodiscard]] std::string constants() const override { return base().constants(); }
};

}  // namespace whipple::eos
