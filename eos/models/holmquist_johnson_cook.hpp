// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string_view>

#include "eos/equation_of_state.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

struct HolmquistJohnsonCookConstants {
  double reference_density = 0;          ///< rho0, with the pores, kg/m^3
  double crush_pressure = 0;             ///< p_crush, Pa
  double crush_compression = 0;          ///< mu_crush
  double lock_pressure = 0;              ///< p_lock, Pa
  double lock_compression = 0;           ///< mu_lock = rho_grain/rho0 - 1
  double K1 = 0, K2 = 0, K3 = 0;         ///< of the material without pores, Pa
  double heat_capacity = 0;              ///< c_v, J/(kg K)
  double reference_temperature = 300.0;  ///< K
};

/// Models the pressure of concrete after Holmquist, Johnson and Cook (14th Int. Symp. Ballistics, 1993), mu =
/// rho/rho0 - 1 (docs/theory/concrete_and_ceramics.md, section 1): linear up to the crush pressure; then the pores
/// are crushed permanently along a straight line up to the lock pressure; then the curve of the pore-free material,
/// K1 m + K2 m^2 + K3 m^3, m = (mu - mu_lock)/(1 + mu_lock). Partly crushed material unloads along a straight line
/// whose slope is interpolated between that of the intact and that of the locked material. The history variable is
/// the distension, the density of the grains over that of the unloaded material: initially 1 + mu_lock, 1 when all
/// pores are closed. The pressure does not depend on the energy; T = T0 + (e - e_r)/c_v, where e_r is the
/// recoverable energy of unloading: crushing heats. States without history are on the virgin path.
class HolmquistJohnsonCook {
 public:
  using Constants = HolmquistJohnsonCookConstants;
  static constexpr std::string_view name = "holmquist_johnson_cook";
  static constexpr std::string_view summary =
      "concrete: elastic, pores crushed permanently, locked (Holmquist-Johnson-Cook); no energy dependence";
  static constexpr double least_temperature = 1.0;  ///< K
  static ParameterTable<Constants> parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit HolmquistJohnsonCook(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return grain_density_ / distension_; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double maximum_density() const { return maximum_density_; }
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }
  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;
  [[nodiscard]] double initial_distension() const { return distension_; }
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading(const State& from) const;

  /// Returns mu at which the crushing line meets the curve of the pore-free material.
  [[nodiscard]] double locked_compression() const { return locked_compression_; }

 private:
  /// Describes the unloading line of material crushed to the fraction F of the crushing line.
  struct Path {
    double greatest_compression;  ///< mu where it leaves the crushing line
    double greatest_pressure;     ///< Pa, there
    double modulus;               ///< dp/dmu, Pa
    double rest;                  ///< mu at p = 0
  };
  struct Response {
    double pressure;            ///< Pa
    double modulus;             ///< dp/dmu of unloading, Pa
    double recoverable_energy;  ///< J/kg
  };
  [[nodiscard]] Path path(double crushed) const;
  [[nodiscard]] double crushed_share(double distension) const;
  /// Evaluates the response, and crushes the pores if the compression requires it.
  [[nodiscard]] Response respond(double density, double& distension) const;
  [[nodiscard]] std::string_view broken_bound(double density, double energy) const;

  Constants constants_;
  double grain_density_;
  double locked_compression_ = 0;
  double intact_modulus_, locked_modulus_ = 0;  ///< dp/dmu of the first and the last unloading line, Pa
  double maximum_density_ = 0;
  double distension_;      ///< initial value
  bool crushable_ = true;  ///< false: `distension_` is constant
};

}  // namespace whipple::eos
