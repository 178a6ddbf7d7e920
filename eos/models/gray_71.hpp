// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/equation_of_state.hpp"
#include "eos/models/gray_free_energy.hpp"

namespace whipple::eos {

/// Implements GRAY in the closed forms of its public implementation (docs/theory/gray.md, section 8): cold energy
/// and melting temperature as truncated series, constant electronic heat coefficient, isochoric melting, vapour
/// joined to the hot liquid. For comparison with codes that use these forms, which are thermodynamically
/// inconsistent (they have no entropy) and discontinuous at V_J; use Gray for calculations.
class Gray71 {
 public:
  using Constants = GrayConstants;
  static constexpr std::string_view name = "gray_71";
  static constexpr std::string_view summary =
      "GRAY in its older closed forms, not consistent thermodynamically: for comparison only";
  static constexpr double relative_cost = 3.5;
  static constexpr double least_temperature = 1.0;         ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of the Hugoniot intercept
  /// Returns the parameters of gray, except the choices that do not exist in these forms.
  static ParameterTable<Constants> parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit Gray71(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return 1.0 / constants_.reference_specific_volume; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return constants_.reference_energy; }
  [[nodiscard]] double maximum_density() const { return 1.0 / least_volume_; }
  /// @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

 private:
  enum class Phase { solid, melting, liquid, hot_liquid, vapour };
  struct Point;
  /// Returns E and P of one phase on an isochore, quadratic in T; the slopes q are not set.
  [[nodiscard]] GrayBranch branch(Phase phase, double V) const;
  [[nodiscard]] double melting_temperature(double V) const;
  [[nodiscard]] double lindemann_exponent(double V) const;
  /// Returns the pressure of the mixture of equal volumes at (V, E).
  [[nodiscard]] double melting_pressure(double V, double E) const;
  [[nodiscard]] Point point(double V, double E) const;
  void complete(Point& point) const;
  [[nodiscard]] State full_state(const Point& point) const;

  Constants constants_;
  double gas_ = 0, lattice_ = 0, heat_coefficient_ = 0, melting_entropy_ = 0, liquid_slope_ = 0;
  double cold_offset_ = 0, cold_energy_at_reference_ = 0;
  double join_volume_ = 0, least_volume_ = 0;
};

}  // namespace whipple::eos
