// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "eos/modifiers/modified.hpp"

namespace whipple::eos {

/// Models material whose distension alpha is a state of its strength model: fragments held apart (bulking,
/// docs/theory/concrete_and_ceramics.md, section 4) and foams (docs/theory/foam.md). p = p_s(alpha rho, e)/alpha with the
/// distension of the batch, which is unchanged; without one, with that of the material as it is made. Wrapped around the
/// equation of state of such a material by `make_material`.
class Distended final : public Modified {
 public:
  explicit Distended(std::shared_ptr<const EquationOfState> base, double initial_distension = 1.0)
      : Modified(std::move(base)), initial_(initial_distension) {}

  [[nodiscard]] double reference_density() const override { return base().reference_density() / initial_; }
  [[nodiscard]] double initial_distension() const override { return initial_; }
  /// Returns that of the material as it is made; a foam that has been crushed is denser.
  [[nodiscard]] double maximum_density() const override { return base().maximum_density() / initial_; }
  [[nodiscard]] double minimum_energy(double density) const override {
    return base().minimum_energy(density * initial_);
  }
  RangeReport evaluate(const Batch& batch) const override {
    if (batch.distension.empty() && initial_ == 1.0) return base().evaluate(batch);
    return in_chunks(batch, [this](Batch part) {
      ModifierScratch density, initial;
      const std::size_t size = part.density.size();
      std::span<const double> distension = part.distension;
      if (distension.empty()) {
        std::fill_n(initial.data(), size, initial_);
        distension = {initial.data(), size};
      }
      for (std::size_t i = 0; i < size; ++i) density[i] = part.density[i] * distension[i];
      Batch matter = part;
      matter.density = {density.data(), size};
      matter.distension = {};
      const RangeReport report = base().evaluate(matter);
      for (std::size_t i = 0; i < size; ++i) part.pressure[i] /= distension[i];
      return report;
    });
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return distended(base().state(density * initial_, specific_internal_energy), density);
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return distended(base().state_at_temperature(density * initial_, temperature), density);
  }
  [[nodiscard]] std::string constants() const override { return base().constants(); }

 private:
  [[nodiscard]] State distended(State state, double density) const {
    state.density = density;
    state.pressure /= initial_;
    state.isothermal_bulk_modulus /= initial_;
    state.distension = initial_;
    return state;
  }

  double initial_;
};

}  // namespace whipple::eos
