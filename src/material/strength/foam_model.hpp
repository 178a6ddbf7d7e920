// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "src/core/base/parameter_table.hpp"
#include "src/material/strength/foam.hpp"
#include "src/material/strength/strength.hpp"

namespace whipple::strength {

/// Common part of the strength models of foams (docs/theory/foam.md). The constants `Law` derive from ElasticConstants and
/// have a relative_density and a solid_yield_stress (Pa).
template <class Law>
class FoamModel : public Strength, public Foam {
 public:
  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] std::string_view model() const final { return Law::name; }
  [[nodiscard]] double initial_distension() const final { return 1.0 / law_.relative_density; }
  void shear_modulus(const State&, std::span<double> modulus) const final {
    std::ranges::fill(modulus, modulus_);
  }
  /// Returns no increment: the pressure is not yet known, and `crush` returns the trial deviator.
  void plastic_increment(const State&, std::span<const double>, std::span<const double>,
                         std::span<const double>, double, std::span<double> increment) const final {
    std::ranges::fill(increment, 0.0);
  }
  [[nodiscard]] std::string constants() const final {
    Law copy = law_;
    return fmt::format("model = \"{}\"\n{}", Law::name, to_toml(whipple::bind(Law::parameters(), copy)));
  }

 protected:
  explicit FoamModel(const Law& law) : law_(law), modulus_(law.stiffness()) {}
  /// Calls flow(i) for the points with pores; others flow as the solid.
  template <class Flow>
  void crush_points(const FoamState& state, Flow&& flow) const {
    for (std::size_t i = 0; i < state.trial.size(); ++i) {
      if (has_pores(state, i)) {
        flow(i);
      } else {
        flow_as_solid(state, i, law_.solid_yield_stress);
      }
    }
  }

  Law law_;

 private:
  double modulus_;
};

}  // namespace whipple::strength
