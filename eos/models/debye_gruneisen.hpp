// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "eos/equation_of_state.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

/// Specifies the form of the isotherm at the reference temperature.
enum class IsothermForm : std::uint8_t { vinet, birch_murnaghan };
constexpr std::array<Word<IsothermForm>, 2> words(IsothermForm) {
  return {{{IsothermForm::vinet, "vinet"}, {IsothermForm::birch_murnaghan, "birch_murnaghan"}}};
}

/// Specifies the Grueneisen parameter of the lattice as a function of volume.
enum class LatticeGruneisenLaw : std::uint8_t {
  power,   ///< gamma0 (V/V0)^q
  linear,  ///< gamma0 - a (1 - V/V0)
};
constexpr std::array<Word<LatticeGruneisenLaw>, 2> words(LatticeGruneisenLaw) {
  return {{{LatticeGruneisenLaw::power, "power"}, {LatticeGruneisenLaw::linear, "linear"}}};
}

struct DebyeGruneisenConstants {
  double molar_mass = 0;         ///< kg per mole of atoms
  double reference_density = 0;  ///< rho0 = 1/V0 at T0 and zero pressure, kg/m^3
  IsothermForm isotherm = IsothermForm::vinet;
  double bulk_modulus = 0;        ///< K0, isothermal, at T0 and V0, Pa
  double bulk_modulus_slope = 0;  ///< K0' = dK_T/dp at T0 and V0
  double debye_temperature = 0;   ///< theta0, at V0, K
  double gruneisen = 0;           ///< gamma0, of the lattice, at V0
  LatticeGruneisenLaw gruneisen_law = LatticeGruneisenLaw::power;
  double gruneisen_exponent = 1.0;                                       ///< q
  double gruneisen_slope = 0.0;                                          ///< a
  double electronic_heat_coefficient = 0.0;                              ///< g_e at V0, J/(mol K^2)
  double electronic_gruneisen = 2.0 / 3.0;                               ///< gamma_e
  double reference_temperature = 300.0;                                  ///< T0, K
  double melting_temperature = std::numeric_limits<double>::infinity();  ///< T_m0 on the isochore V0, K
};

/// Models a solid with a measured isotherm, Debye's lattice vibrations and free electrons
/// (docs/theory/equations_of_state.md, "Debye-Grueneisen solid"), from one Helmholtz energy
///   F(V, T) = F_0(V) + F_th(V, T) - F_th(V, T0),
/// where -dF_0/dV is the isotherm at T0 (Vinet or third-order Birch-Murnaghan): K0 and K0' are those of static
/// compression at T0, not of the cold curve. There is no liquid: above Lindemann's melting temperature the melted
/// fraction is 1 and the energies remain those of the solid.
///
/// Explicit policies at the limits:
///  - energy below that of `least_temperature` on its isochore: T is limited to it, the point is counted, E is kept;
///  - c^2 < `least_sound_speed_ratio`^2 K0 V0 (expanded beyond the spinodal): c is limited to that value;
///  - density outside [`minimum_density()`, `maximum_density()`]: results are NaN, the point is counted.
class DebyeGruneisen {
 public:
  using Constants = DebyeGruneisenConstants;
  static constexpr std::string_view name = "debye_gruneisen";
  static constexpr std::string_view summary =
      "solid: Vinet or Birch-Murnaghan isotherm, Debye lattice, electrons; Lindemann melting";
  static constexpr double relative_cost = 7.0;
  static constexpr double least_temperature = 1.0;         ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of sqrt(K0 V0)
  static ParameterTable<Constants> parameters();
  /// Returns the constants of one solid phase: all but the molar mass, the reference temperature and melting.
  static ParameterTable<Constants> phase_parameters();

  /// @throws InputError naming the constants that contradict each other
  explicit DebyeGruneisen(const Constants& constants);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double reference_density() const { return constants_.reference_density; }
  [[nodiscard]] double reference_temperature() const { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const { return 0.0; }
  [[nodiscard]] double maximum_density() const { return maximum_density_; }
  [[nodiscard]] double minimum_density() const { return minimum_density_; }

  /// Returns the energy of the coldest state at a density.
  /// @throws StateError outside the density range of the model
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

  /// Returns Lindemann's T_m0 (V/V0)^(2/3) (theta/theta0)^2 (K); infinite without `melting_temperature`.
  [[nodiscard]] double melting_temperature(double density) const;
  [[nodiscard]] double debye_temperature(double density) const;

 private:
  struct Isochore;
  struct Vibration;
  struct Thermal;
  struct Point;
  [[nodiscard]] Isochore lattice(double density) const;
  [[nodiscard]] Isochore isochore(double density) const;
  [[nodiscard]] Thermal thermal(const Isochore& isochore, double temperature,
                                const Vibration& vibration) const;
  [[nodiscard]] Thermal thermal(const Isochore& isochore, double temperature) const;
  [[nodiscard]] Thermal thermal_at_energy(const Isochore& isochore, double thermal_energy) const;
  [[nodiscard]] double entropy(const Isochore& isochore, double temperature,
                               const Vibration& vibration) const;
  [[nodiscard]] Point point(double density, double energy) const;
  [[nodiscard]] Point point_at_temperature(double density, double temperature) const;
  void complete(Point& point, const Isochore& isochore, const Thermal& thermal) const;
  [[nodiscard]] State full_state(const Point& point) const;
  [[nodiscard]] std::string_view broken_bound(double density) const;
  void find_limits();

  Constants constants_;
  bool vinet_ = true, power_law_ = true;
  double gas_constant_ = 0;           ///< R/M, J/(kg K)
  double reference_free_energy_ = 0;  ///< F_0(V0), J/kg: such that the energy is zero at (V0, T0)
  double least_squared_sound_speed_ = 0;
  double minimum_density_ = 0, maximum_density_ = 0;
};

}  // namespace whipple::eos
