// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "eos/equation_of_state.hpp"
#include "eos/hermite_table.hpp"
#include "src/base/parameter_table.hpp"

namespace whipple::eos {

struct MieGruneisenConstants {
  double reference_density = 0;                    ///< rho0, kg/m^3
  double hugoniot_intercept = 0;                   ///< c0 of Us = c0 + s up, m/s
  double hugoniot_slope = 0;                       ///< s
  double gruneisen = 0;                            ///< Gamma0, at rho0
  std::string gruneisen_law = "constant_product";  ///< rho Gamma = rho0 Gamma0, or "constant"
  double heat_capacity = 0;                        ///< c_v, J/(kg K)
  double reference_temperature = 300.0;            ///< K
};

/// Mie-Grueneisen equation of state on a linear shock Hugoniot (docs/theory/equations_of_state.md, section
/// 2):
///   p = A(rho) + B(rho) e,  B = rho Gamma in every state, also in expansion;
///   compression: A = p_H (1 - Gamma/2 (rho/rho0 - 1)), p_H = rho0 c0^2 eta/(1 - s eta)^2, eta = 1 -
///   rho0/rho; expansion:   A = c0^2 (rho - rho0).
/// With "constant_product", B = rho0 Gamma0 in compression and Gamma0 rho in expansion (Gamma frozen at
/// Gamma0). Temperature from a constant heat capacity above the isentrope through the reference state. No
/// phases.
class MieGruneisen {
 public:
  using Constants = MieGruneisenConstants;
  static constexpr std::string_view name = "mie_gruneisen";
  static constexpr std::string_view summary = "Mie-Grueneisen on a linear shock Hugoniot; no phases";
  static constexpr double least_temperature = 1.0;         ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of the Hugoniot intercept
  static ParameterTable<Constants> parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit MieGruneisen(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double maximum_density() const { return maximum_density_; }

  /// Energy of the coldest state at a density.
  /// @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

 private:
  /// p = A + B e and its derivatives by density.
  struct Coefficients {
    double A, B, A_slope, B_slope;
  };
  /// Energy and temperature on the isentrope through the reference state.
  struct Isentrope {
    double energy, temperature;
  };
  struct Point;
  [[nodiscard]] Coefficients coefficients(double density) const;
  [[nodiscard]] Isentrope isentrope(double density) const;
  [[nodiscard]] Point point(double density, double energy) const;
  [[nodiscard]] State full_state(const Point& point) const;
  void find_limit();
  void tabulate_isentrope();

  Constants constants_;
  bool constant_product_ = true;
  double maximum_density_ = 0;
  HermiteTable isentrope_energy_;  ///< over eta = 1 - rho0/rho, in compression
};

}  // namespace whipple::eos
