// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "eos/constant_heat_capacity.hpp"
#include "eos/cubic_table.hpp"

namespace whipple::eos {

struct TillotsonConstants {
  double reference_density = 0;              ///< rho0, kg/m^3
  double thermal_a = 0;                      ///< a
  double thermal_b = 0;                      ///< b
  double bulk_modulus = 0;                   ///< A, Pa
  double quadratic_modulus = 0;              ///< B, Pa
  double expansion_alpha = 0;                ///< alpha
  double expansion_beta = 0;                 ///< beta
  double energy_scale = 0;                   ///< E0, J/kg
  double incipient_vaporisation_energy = 0;  ///< E_iv, J/kg
  double complete_vaporisation_energy = 0;   ///< E_cv, J/kg
  double heat_capacity = 0;                  ///< c_v, J/(kg K)
  double reference_temperature = 300.0;      ///< K
};

/// Models Tillotson's equation of state (GA-3216, 1962; Melosh, Impact Cratering, 1989, appendix II;
/// docs/theory/equations_of_state.md, section 2.6): condensed, vapour and between them a linear mixture of their
/// pressures. It gives p(rho, e) only: the temperature is an estimate, based on c_v above the isentrope of the
/// reference state, and there is no entropy.
class TillotsonCurve {
 public:
  using Constants = TillotsonConstants;
  static constexpr std::string_view name = "tillotson";
  static constexpr std::string_view summary =
      "Tillotson: condensed, vapour and mixture; temperature estimated, no entropy";
  static ParameterTable<Constants> parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit TillotsonCurve(const Constants& constants);

  /// Holds four densities.
  struct Isochore {
    const Constants* k;
    Lanes density, specific_volume, cold_energy, mu;
    LanesMask expanded;

    [[nodiscard]] Response response(Lanes energy) const;
    /// Returns (e - E_iv)/(E_cv - E_iv) between 0 and 1 in expansion: the weight of the vapour pressure.
    [[nodiscard]] Lanes vaporised_fraction(Lanes energy) const;
  };

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double reference_sound_speed() const;
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return true; }
  [[nodiscard]] double maximum_density() const {
    return greatest_compression_ratio * constants_.reference_density;
  }
  [[nodiscard]] std::string_view phase(double rho, double energy) const;

  [[nodiscard]] Isochore isochore(Lanes rho) const;
  [[nodiscard]] double log_isentrope_temperature(double) const { return State::unknown; }
  /// Returns de_c/drho.
  [[nodiscard]] double cold_energy_slope(double rho) const;

 private:
  void tabulate_isentrope();

  Constants constants_;
  CubicTable cold_energy_;            ///< e_c (rho0/rho)^2 over x = 1 - rho0/rho, in compression
  CubicTable isentrope_temperature_;  ///< T_s, over the same
};

inline Response TillotsonCurve::Isochore::response(Lanes energy) const {
  const Constants& c = *k;
  const Lanes r = mu + 1.0;
  // w = 1/(1 + e/(E0 eta^2)), at its cold limit 1 below the reference energy.
  const Lanes scale = c.energy_scale * r * r;
  const Lanes w = scale / (scale + maximum(energy, Lanes{}));
  const Lanes b = c.thermal_b * w, b_by_density = b * (3.0 - 2.0 * w);  // d(rho w)/drho = w (3 - 2 w)
  const double modulus_slope = 1 / c.reference_density;
  // (T1)
  Response s{
      (c.thermal_a + b) * density * energy + mu * (c.bulk_modulus + mu * c.quadratic_modulus),
      (c.thermal_a + b_by_density) * energy + modulus_slope * (c.bulk_modulus + 2 * c.quadratic_modulus * mu),
      density * (c.thermal_a + b * w),
      {}};
  s.squared_sound_speed = s.by_density + s.pressure * specific_volume * specific_volume * s.by_energy;
  const LanesMask hot = expanded & (energy > c.incipient_vaporisation_energy);
  if (bits(hot) == 0) return s;
  // (T2), the vapour: q = rho0/rho - 1.
  const Lanes q = c.reference_density * specific_volume - 1.0;
  const Lanes damp = exp(-c.expansion_alpha * q * q), elastic_damp = exp(-c.expansion_beta * q);
  const Lanes elastic = c.bulk_modulus * mu * elastic_damp;
  const Lanes inner = b * density * energy + elastic;
  const Lanes q_slope = -c.reference_density * specific_volume * specific_volume;
  const Lanes pressure = c.thermal_a * density * energy + inner * damp;
  const Lanes by_density =
      c.thermal_a * energy +
      damp * (b_by_density * energy + modulus_slope * c.bulk_modulus * elastic_damp -
              q_slope * (2 * c.expansion_alpha * q * inner + c.expansion_beta * elastic));
  const Lanes by_energy = density * (c.thermal_a + b * w * damp);
  // (T3), the mixture, up to complete vaporisation.
  const double latent = c.complete_vaporisation_energy - c.incipient_vaporisation_energy;
  const Lanes share = minimum((energy - c.incipient_vaporisation_energy) * (1 / latent), broadcast(1.0));
  const Lanes share_slope = energy < c.complete_vaporisation_energy ? broadcast(1 / latent) : Lanes{};
  const Lanes mixed_pressure = s.pressure + share * (pressure - s.pressure);
  const Lanes mixed_by_density = s.by_density + share * (by_density - s.by_density);
  const Lanes mixed_by_energy =
      s.by_energy + share * (by_energy - s.by_energy) + share_slope * (pressure - s.pressure);
  s.pressure = hot ? mixed_pressure : s.pressure;
  s.by_density = hot ? mixed_by_density : s.by_density;
  s.by_energy = hot ? mixed_by_energy : s.by_energy;
  s.squared_sound_speed = s.by_density + s.pressure * specific_volume * specific_volume * s.by_energy;
  return s;
}

inline Lanes TillotsonCurve::Isochore::vaporised_fraction(Lanes energy) const {
  const double latent = k->complete_vaporisation_energy - k->incipient_vaporisation_energy;
  const Lanes share = (energy - k->incipient_vaporisation_energy) * (1 / latent);
  return expanded ? minimum(maximum(share, Lanes{}), broadcast(1.0)) : Lanes{};
}

inline TillotsonCurve::Isochore TillotsonCurve::isochore(Lanes rho) const {
  const double rho0 = constants_.reference_density;
  const Lanes V = 1.0 / rho, r = rho * (1 / rho0);
  const LanesMask expanded = rho < rho0;
  const Lanes cold = broadcast(-constants_.heat_capacity * constants_.reference_temperature);
  if (bits(expanded) == all_lanes) return {&constants_, rho, V, cold, r - 1.0, expanded};
  const Lanes dense = cold_energy_(1.0 - rho0 * V) * r * r;
  return {&constants_, rho, V, expanded ? cold : dense, r - 1.0, expanded};
}

using Tillotson = ConstantHeatCapacity<TillotsonCurve>;
extern template class ConstantHeatCapacity<TillotsonCurve>;

}  // namespace whipple::eos
