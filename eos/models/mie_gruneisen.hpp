// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "eos/constant_heat_capacity.hpp"
#include "eos/models/gruneisen_solid.hpp"
#include "eos/models/shock_curve.hpp"

namespace whipple::eos {

/// Specifies the Grueneisen parameter in compression.
enum class CompressedGruneisenLaw : std::uint8_t {
  constant_product,  ///< rho Gamma = rho0 Gamma0
  constant,          ///< Gamma = Gamma0
  linear,            ///< rho Gamma = rho0 (Gamma0 + b mu)
};
constexpr std::array<Word<CompressedGruneisenLaw>, 3> words(CompressedGruneisenLaw) {
  return {{{CompressedGruneisenLaw::constant_product, "constant_product"},
           {CompressedGruneisenLaw::constant, "constant"},
           {CompressedGruneisenLaw::linear, "linear"}}};
}

struct MieGruneisenConstants {
  double reference_density = 0;   ///< rho0, kg/m^3
  double hugoniot_intercept = 0;  ///< c0 of the shock Hugoniot, m/s
  double hugoniot_slope = 0;      ///< S1
  double hugoniot_quadratic = 0;  ///< S2
  double hugoniot_cubic = 0;      ///< S3
  double gruneisen = 0;           ///< Gamma0, at rho0
  CompressedGruneisenLaw gruneisen_law = CompressedGruneisenLaw::constant_product;
  double gruneisen_slope = 0;            ///< b of rho Gamma = rho0 (Gamma0 + b mu)
  double heat_capacity = 0;              ///< c_v, J/(kg K)
  double reference_temperature = 300.0;  ///< K
};

/// Models a Mie-Grueneisen equation of state on a shock Hugoniot (docs/theory/equations_of_state.md, section 2.2):
///   p = A(rho) + rho Gamma e, A = p_H (1 - rho Gamma x/(2 rho0)) in compression, x = 1 - rho0/rho;
///   A = c0^2 (rho - rho0), Gamma = Gamma0 in expansion.
/// Hugoniot and the linear law of Gamma: Steinberg, UCRL-MA-106439 (1996). No phases.
class MieGruneisenCurve {
 public:
  using Constants = MieGruneisenConstants;
  static constexpr std::string_view name = "mie_gruneisen";
  static constexpr std::string_view summary = "Mie-Grueneisen on a shock Hugoniot; no phases";
  static ParameterTable<Constants> parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit MieGruneisenCurve(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double reference_sound_speed() const { return constants_.hugoniot_intercept; }
  [[nodiscard]] double heat_capacity() const { return constants_.heat_capacity; }
  [[nodiscard]] bool condensed() const { return true; }
  [[nodiscard]] double maximum_density() const { return solid_.maximum_density(); }
  [[nodiscard]] std::string_view phase(double, double) const { return "solid"; }

  [[nodiscard]] TabulatedIsochore isochore(Lanes rho) const { return solid_.isochore(rho); }
  using Places = FourfoldTable::Places;
  void find(Lanes rho, Places& places) const { solid_.find(rho, places); }
  [[nodiscard]] TabulatedIsochore usual_isochore(Lanes rho, const Places& places) const {
    return solid_.usual_isochore(rho, places);
  }
  [[nodiscard]] double least_usual_density() const { return solid_.least_usual_density(); }
  [[nodiscard]] const auto& solid() const { return solid_; }
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    return solid_.log_isentrope_temperature(rho);
  }

 private:
  /// Evaluates A in compression, (M1) and (M2).
  struct Hugoniot {
    ShockCurve curve;
    GruneisenLaw gamma;
    double modulus;  ///< rho0 c0^2

    ReferencePressure operator()(double mu) const {
      const double r = 1 + mu, x = mu / r;
      const auto p = curve.pressure(x);
      // 1 - rho Gamma x/(2 rho0) and its derivative with respect to mu; dx/dmu = 1/r^2
      const double by_density = gamma.constant + gamma.linear * mu;
      const double thermal = 1 - 0.5 * by_density * x;
      const double thermal_slope = -0.5 * (gamma.linear * x + by_density / (r * r));
      return {modulus * p.value * thermal, modulus * (p.slope / (r * r) * thermal + p.value * thermal_slope)};
    }
  };

  static GruneisenLaw law(const Constants& constants);
  static GruneisenSolid<Hugoniot> solid(const Constants& constants);

  Constants constants_;
  GruneisenSolid<Hugoniot> solid_;
};

using MieGruneisen = ConstantHeatCapacity<MieGruneisenCurve>;
extern template class ConstantHeatCapacity<MieGruneisenCurve>;

}  // namespace whipple::eos
