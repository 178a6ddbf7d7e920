// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "eos/constant_heat_capacity.hpp"
#include "eos/models/gruneisen_solid.hpp"
#include "eos/models/shock_curve.hpp"

namespace whipple::eos {

struct MieGruneisenConstants {
  double reference_density = 0;                    ///< rho0, kg/m^3
  double hugoniot_intercept = 0;                   ///< c0 of the shock Hugoniot, m/s
  double hugoniot_slope = 0;                       ///< S1
  double hugoniot_quadratic = 0;                   ///< S2
  double hugoniot_cubic = 0;                       ///< S3
  double gruneisen = 0;                            ///< Gamma0, at rho0
  std::string gruneisen_law = "constant_product";  ///< rho Gamma = rho0 Gamma0, "constant" or "linear"
  double gruneisen_slope = 0;                      ///< b of rho Gamma = rho0 (Gamma0 + b mu)
  double heat_capacity = 0;                        ///< c_v, J/(kg K)
  double reference_temperature = 300.0;            ///< K
};

/// Mie-Grueneisen equation of state on a shock Hugoniot (docs/theory/equations_of_state.md, section 2.2):
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

  [[nodiscard]] LinearIsochore isochore(Lanes rho) const { return solid_.isochore(rho); }
  [[nodiscard]] double log_isentrope_temperature(double rho) const {
    return solid_.log_isentrope_temperature(rho);
  }

 private:
  /// A of compression, (M1) and (M2), with few operations. With r = rho/rho0 = 1 + mu, x = mu/r,
  ///   N = r^3 (1 - S1 x - S2 x^2 - S3 x^3),  M = mu [r - mu rho Gamma/(2 rho0)]
  /// are cubics in mu, A = rho0 c0^2 (r^2/N)^2 M and d ln A/dmu = M'/M + 4/r - 2 N'/N; 1/r and 1/N come from
  /// one division.
  struct Hugoniot {
    double modulus, inverse_density;  ///< rho0 c0^2, 1/rho0
    double N1, N2, N3;                ///< N = 1 + N1 mu + N2 mu^2 + N3 mu^3
    double M2, M3;                    ///< M = mu + M2 mu^2 + M3 mu^3
    double twice_N2 = 2 * N2, thrice_N3 = 3 * N3, twice_M2 = 2 * M2, thrice_M3 = 3 * M3;

    Hugoniot(const ShockCurve& curve, const GruneisenLaw& gamma, double rho0, double c0)
        : modulus(rho0 * c0 * c0),
          inverse_density(1 / rho0),
          N1(3 - curve.slope),
          N2(3 - 2 * curve.slope - curve.quadratic),
          N3(1 - curve.slope - curve.quadratic - curve.cubic),
          M2(1 - 0.5 * gamma.constant),
          M3(-0.5 * gamma.linear) {}

    ReferencePressure operator()(const Compression& c) const {
      const Lanes r = c.r, mu = c.mu;
      const Lanes N = 1.0 + mu * (N1 + mu * (N2 + mu * N3)), N_slope = N1 + mu * (twice_N2 + mu * thrice_N3);
      const Lanes M = mu * (1.0 + mu * (M2 + mu * M3)), M_slope = 1.0 + mu * (twice_M2 + mu * thrice_M3);
      const Lanes common = 1.0 / (r * N), inverse_r = N * common, inverse_N = r * common;
      const Lanes q = r * r * inverse_N, scale = modulus * q * q;
      return {scale * M,
              inverse_density * scale * (M_slope + M * (4.0 * inverse_r - 2.0 * (N_slope * inverse_N))),
              q * r, inverse_r};
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
