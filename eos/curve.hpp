// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <string_view>

#include "src/core/base/parameter_table.hpp"
#include "src/core/base/vector_math.hpp"

/// Defines the interface of a model with a constant heat capacity: pressure and cold energy along isochores
/// (docs/theory/equations_of_state.md, section 2).
namespace whipple::eos {

/// Holds p(rho, e), its partial derivatives and c^2, of four points.
struct Response {
  Lanes pressure, by_density, by_energy, squared_sound_speed;
};

/// Holds four densities of a model whose pressure is linear in the energy, p = A + B e with B = rho Gamma.
struct LinearIsochore {
  Lanes work;         ///< B/rho^2: factor of the pressure in c^2
  Lanes cold_energy;  ///< e_c
  Lanes A, A_slope;   ///< and its derivative with respect to rho
  Lanes B, B_slope;   ///< and its derivative with respect to rho

  [[nodiscard]] Response response(Lanes energy) const {
    const Lanes pressure = A + B * energy, by_density = A_slope + B_slope * energy;
    return {pressure, by_density, B, by_density + pressure * work};
  }
  /// Returns p = p_r + rho Gamma (e - e_r) with Gamma constant and an isentropic reference curve, de_r = p_r/rho^2
  /// drho.
  [[nodiscard]] static LinearIsochore on_curve(Lanes density, Lanes specific_volume, double gruneisen,
                                               Lanes pressure, Lanes slope, Lanes energy, Lanes cold_energy) {
    return {gruneisen * specific_volume,
            cold_energy,
            pressure - gruneisen * density * energy,
            slope - gruneisen * (energy + pressure * specific_volume),
            gruneisen * density,
            broadcast(gruneisen)};
  }
  /// Selects one of two isochores lane by lane.
  [[nodiscard]] static LinearIsochore select(LanesMask first, const LinearIsochore& a,
                                             const LinearIsochore& b) {
    return {first ? a.work : b.work, first ? a.cold_energy : b.cold_energy,
            first ? a.A : b.A,       first ? a.A_slope : b.A_slope,
            first ? a.B : b.B,       first ? a.B_slope : b.B_slope};
  }
};

/// Requires a model to provide its pressure (Pa) and the energy e_c(rho) (J/kg) of its coldest state, T = 0.
template <class C>
concept Curve = requires(const C& curve, Lanes lanes, double number) {
  typename C::Constants;
  { C::parameters() } -> std::same_as<ParameterTable<typename C::Constants>>;
  { C::name } -> std::convertible_to<std::string_view>;
  { C::summary } -> std::convertible_to<std::string_view>;
  { curve.constants() } -> std::same_as<const typename C::Constants&>;
  { curve.isochore(lanes).cold_energy } -> std::convertible_to<Lanes>;
  { curve.isochore(lanes).response(lanes) } -> std::same_as<Response>;
  // ln(T_s/T0) on the isentrope through the reference state; NaN: the model has no entropy.
  { curve.log_isentrope_temperature(number) } -> std::same_as<double>;
  { curve.phase(number, number) } -> std::convertible_to<std::string_view>;
  { curve.reference_density() } -> std::same_as<double>;
  { curve.reference_temperature() } -> std::same_as<double>;
  { curve.reference_energy() } -> std::same_as<double>;
  { curve.reference_sound_speed() } -> std::same_as<double>;
  { curve.heat_capacity() } -> std::same_as<double>;
  { curve.maximum_density() } -> std::same_as<double>;
  { curve.condensed() } -> std::same_as<bool>;  // false: a gas, which has no zero-pressure state
};

}  // namespace whipple::eos
