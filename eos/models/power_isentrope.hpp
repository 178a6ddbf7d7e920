// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "eos/constant_heat_capacity.hpp"

namespace whipple::eos {

/// Describes a reference isentrope p_s = K/n [(rho/rho0)^n - 1] with a constant Grueneisen parameter
/// (docs/theory/equations_of_state.md, section 2.3); e_s = 0 at rho0.
struct PowerIsentrope {
  double density, temperature;  ///< rho0, T0
  double bulk_modulus, exponent, gruneisen, heat_capacity;

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const {
    const Lanes V = 1.0 / rho, r = rho * (1 / density), power = pow(r, broadcast(exponent));
    const double scale = bulk_modulus / exponent;
    // e_s = K/(n rho0) [(r^(n-1) - 1)/(n - 1) + 1/r - 1]
    const Lanes inverse = density * V;
    const Lanes energy = scale / density * ((power * inverse - 1.0) * (1 / (exponent - 1)) + inverse - 1.0);
    const Lanes isentrope_temperature = temperature * pow(r, broadcast(gruneisen));
    return LinearIsochore::on_curve(rho, V, gruneisen, scale * (power - 1.0), bulk_modulus * power * V,
                                    energy, energy - heat_capacity * isentrope_temperature);
  }
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    return gruneisen * std::log(rho / density);
  }
  [[nodiscard]] double sound_speed() const { return std::sqrt(bulk_modulus / density); }
  [[nodiscard]] double maximum_density() const { return greatest_compression_ratio * density; }
};

/// Provides the common part of the models on such an isentrope.
template <class ConstantsOfModel>
class PowerIsentropeCurve {
 public:
  using Constants = ConstantsOfModel;

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return isentrope_.density; }
  [[nodiscard]] double reference_temperature() const { return isentrope_.temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double reference_sound_speed() const { return isentrope_.sound_speed(); }
  [[nodiscard]] double heat_capacity() const { return isentrope_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return true; }
  [[nodiscard]] double maximum_density() const { return isentrope_.maximum_density(); }

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const { return isentrope_.isochore(rho); }
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    return isentrope_.log_isentrope_temperature(rho);
  }

 protected:
  PowerIsentropeCurve(const Constants& constants, double bulk_modulus, double exponent)
      : constants_(constants),
        isentrope_{constants.reference_density, constants.reference_temperature, bulk_modulus, exponent,
                   constants.gruneisen,         constants.heat_capacity} {}

 private:
  Constants constants_;
  PowerIsentrope isentrope_;
};

}  // namespace whipple::eos
