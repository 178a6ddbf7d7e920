// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "src/core/parallel/threads.hpp"
#include "src/solver/state.hpp"

namespace whipple::solver {

/// Evaluates the burn state of the explosive particles of a rank (docs/theory/burn.md, section 5).
class Explosives {
 public:
  explicit Explosives(const State& state)
      : state_(state), early_(state.setup.burn.settings(state.setup.domain.cell_size).early) {
    const History* fraction =
        state.setup.has_burn() ? state.particles.history.find("burn_fraction") : nullptr;
    if (fraction == nullptr) return;
    fraction_ = &std::get<std::vector<double>>(fraction->values);
    lighting_ = &state.particles.history.scalar("lighting_time");
    for (const auto& material : state.setup.materials) {
      velocity_.push_back(material->burns() ? material->burning_explosive().detonation_velocity : 0.0);
      store_.push_back(material->burns() ? material->burning_explosive().stored_energy : 0.0);
      reacts_.push_back(material->burns() && material->burning_explosive().reaction != nullptr);
    }
  }

  [[nodiscard]] bool any() const { return fraction_ != nullptr; }
  /// Returns whether a particle is explosive that has not burnt out.
  [[nodiscard]] bool burns(std::size_t p) const {
    return any() && velocity_[state_.particles.body[p]] > 0.0 && (*fraction_)[p] < 1.0;
  }
  /// Returns whether a particle consists of the products of a burnt-out explosive.
  [[nodiscard]] bool is_burnt(std::size_t p) const {
    return any() && velocity_[state_.particles.body[p]] > 0.0 && (*fraction_)[p] >= 1.0;
  }
  /// Returns whether detonation has arrived at a particle, or will before a time (s).
  [[nodiscard]] bool is_lit(std::size_t p, double before) const {
    return burns(p) && (*lighting_)[p] >= 0.0 && (*lighting_)[p] <= before;
  }
  /// Returns whether a particle burns or is about to, at a detonation front with prescribed lighting times.
  [[nodiscard]] bool is_at_front(std::size_t p) const {
    if (!burns(p) || reacts_[state_.particles.body[p]]) return false;
    const double ahead = early_ / velocity_[state_.particles.body[p]];
    return (*fraction_)[p] > 0.0 || is_lit(p, state_.run.time + ahead);
  }
  /// Returns the maximum detonation velocity (m/s) of particles in [begin, end) that have not burnt out: a front
  /// crosses them faster than sound.
  [[nodiscard]] double fastest(std::size_t begin, std::size_t end) const {
    double fastest = 0.0;
    for (std::size_t p = begin; p < end; ++p) {
      fastest = std::max(fastest, burns(p) ? velocity_[state_.particles.body[p]] : 0.0);
    }
    return fastest;
  }
  /// Returns the energy (J) that is stored in unburnt explosive.
  [[nodiscard]] double chemical_energy() const {
    if (!any()) return 0.0;
    const Particles& q = state_.particles;
    return parallel::sum<double>(
        q.size(), [&](std::size_t p) { return q.mass[p] * store_[q.body[p]] * (1.0 - (*fraction_)[p]); });
  }

 private:
  const State& state_;
  double early_;                                   // distance ahead of a front, m
  const std::vector<double>* fraction_ = nullptr;  // null: the case has no explosive
  const std::vector<double>* lighting_ = nullptr;
  std::vector<double> velocity_, store_;  // of each body, m/s and J/kg; 0: no explosive
  std::vector<bool> reacts_;              // of each body: whether it burns by a rate law
};

}  // namespace whipple::solver
