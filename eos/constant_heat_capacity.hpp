// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <limits>
#include <string_view>

#include "eos/equation_of_state.hpp"
#include "src/base/error.hpp"
#include "src/base/parameter_table.hpp"
#include "src/base/vector_math.hpp"

/// The common core of the models with a constant heat capacity (docs/theory/equations_of_state.md, section
/// 2).
namespace whipple::eos {

/// Compression limit rho/rho0 of condensed models that have no limit of their own.
inline constexpr double greatest_compression_ratio = 10;

/// p(rho, e) and its partial derivatives, of four points.
struct Response {
  Lanes pressure, by_density, by_energy;
};

/// Four densities of a model whose pressure is linear in the energy, p = A + B e with B = rho Gamma.
struct LinearIsochore {
  Lanes specific_volume;  ///< 1/rho
  Lanes cold_energy;      ///< e_c
  Lanes A, A_slope;       ///< and its derivative by rho
  Lanes B, B_slope;       ///< and its derivative by rho

  [[nodiscard]] Response response(Lanes energy) const {
    return {A + B * energy, A_slope + B_slope * energy, B};
  }
  /// p = p_r + rho Gamma (e - e_r) with Gamma constant and a curve that does its own work, de_r = p_r/rho^2
  /// drho.
  [[nodiscard]] static LinearIsochore on_curve(Lanes density, Lanes specific_volume, double gruneisen,
                                               Lanes pressure, Lanes slope, Lanes energy, Lanes cold_energy) {
    return {specific_volume,
            cold_energy,
            pressure - gruneisen * density * energy,
            slope - gruneisen * (energy + pressure * specific_volume),
            gruneisen * density,
            broadcast(gruneisen)};
  }
  /// Lane by lane one of two.
  [[nodiscard]] static LinearIsochore select(LanesMask first, const LinearIsochore& a,
                                             const LinearIsochore& b) {
    return {first ? a.specific_volume : b.specific_volume,
            first ? a.cold_energy : b.cold_energy,
            first ? a.A : b.A,
            first ? a.A_slope : b.A_slope,
            first ? a.B : b.B,
            first ? a.B_slope : b.B_slope};
  }
};

/// What a model gives to the core: its pressure and the energy e_c(rho) of its coldest state, T = 0.
template <class C>
concept Curve = requires(const C& curve, Lanes lanes, double number) {
  typename C::Constants;
  { C::parameters() } -> std::same_as<ParameterTable<typename C::Constants>>;
  { C::name } -> std::convertible_to<std::string_view>;
  { C::summary } -> std::convertible_to<std::string_view>;
  { curve.constants() } -> std::same_as<const typename C::Constants&>;
  { curve.isochore(lanes).specific_volume } -> std::convertible_to<Lanes>;
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
  { curve.condensed() } -> std::same_as<bool>;  // false: a gas, which has no state of zero pressure
};

/// A complete equation of state from p(rho, e) and the cold energy e_c(rho):
///   T = (e - e_c)/c_v,  c^2 = (dp/drho)_e + (p/rho^2) (dp/de)_rho,  Gamma = (dp/de)_rho/rho,
///   s = c_v ln(T/T_s),  d ln T_s/d ln rho = Gamma,  K_T = rho [(dp/drho)_e + (dp/de)_rho de_c/drho].
///
/// Policies, all named and none silent:
///  - energy below that of `least_temperature`: T, p and c are those of that temperature, the point is
///  counted,
///    e is kept;
///  - c^2 < `least_sound_speed_ratio`^2 of the reference state's (tension beyond the spinodal): c is held
///    there;
///  - density not positive, beyond `maximum_density()`, or anything not finite: NaN, the point is counted.
template <Curve C>
class ConstantHeatCapacity {
 public:
  using Constants = typename C::Constants;
  static constexpr std::string_view name = C::name;
  static constexpr std::string_view summary = C::summary;
  static constexpr double least_temperature = 1.0;         ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of the reference state's
  static ParameterTable<Constants> parameters() { return C::parameters(); }

  /// @throws InputError naming the constants that contradict each other
  explicit ConstantHeatCapacity(const Constants& constants) : curve_(constants) {}

  [[nodiscard]] const C& curve() const { return curve_; }
  [[nodiscard]] const Constants& constants() const { return curve_.constants(); }
  [[nodiscard]] double reference_density() const { return curve_.reference_density(); }
  [[nodiscard]] double reference_temperature() const { return curve_.reference_temperature(); }
  [[nodiscard]] double reference_energy() const { return curve_.reference_energy(); }
  [[nodiscard]] double maximum_density() const { return curve_.maximum_density(); }
  [[nodiscard]] bool condensed() const { return curve_.condensed(); }

  /// Energy of the coldest state at a density.
  /// @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  // Not to be inlined or cloned: a single point must run through the very instructions of a batch.
  [[gnu::noipa]] RangeReport evaluate(const Batch& batch) const;
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

 private:
  /// Why a point is out of range; empty: it is not.
  [[nodiscard]] std::string_view broken_bound(double density, double energy) const {
    if (!(density > 0) || !std::isfinite(density)) return "density must be positive and finite";
    if (!std::isfinite(energy)) return "specific internal energy must be finite";
    if (density > maximum_density()) return "density above the compression limit";
    return "";
  }
  [[noreturn]] void throw_out_of_range(std::string_view bound, double density, double energy) const {
    throw StateError(
        fmt::format("{}: {} (density {:.6g} kg/m^3, compression limit {:.6g} kg/m^3, specific internal "
                    "energy {:.6g} J/kg)",
                    name, bound, density, maximum_density(), energy));
  }

  C curve_;
};

template <Curve C>
RangeReport ConstantHeatCapacity<C>::evaluate(const Batch& batch) const {
  constexpr std::size_t width = 4;
  constexpr double largest = std::numeric_limits<double>::max();
  const double greatest_density = maximum_density();
  const double reference_rho = reference_density(), reference_e = reference_energy();
  const double heat = curve_.heat_capacity(), inverse_heat = 1 / heat;
  const Lanes least_squared =
      broadcast(std::pow(least_sound_speed_ratio * curve_.reference_sound_speed(), 2));
  const Lanes unknown = broadcast(State::unknown);
  const bool melted = !batch.melted_fraction.empty(), vaporised = !batch.vaporised_fraction.empty();
  const std::size_t n = batch.density.size();
  RangeReport report;
  for (std::size_t i = 0; i < n; i += width) {
    const std::size_t count = std::min(width, n - i);
    const Lanes given_density = load(&batch.density[i], count, reference_rho);
    const Lanes given_energy = load(&batch.specific_internal_energy[i], count, reference_e);
    const LanesMask valid = (given_density > 0.0) & (given_density <= greatest_density) &
                            (given_energy >= -largest) & (given_energy <= largest);
    const Lanes density = valid ? given_density : broadcast(reference_rho);
    const Lanes energy = valid ? given_energy : broadcast(reference_e);

    const auto isochore = curve_.isochore(density);
    const Lanes coldest = isochore.cold_energy + heat * least_temperature;
    const Lanes held = maximum(energy, coldest);
    const Response r = isochore.response(held);
    const Lanes V = isochore.specific_volume;
    const Lanes squared = r.by_density + r.pressure * V * V * r.by_energy;
    Lanes pressure = r.pressure;
    Lanes temperature = maximum((held - isochore.cold_energy) * inverse_heat, broadcast(least_temperature));
    Lanes sound_speed = sqrt(maximum(squared, least_squared));

    report.below_cold_curve += static_cast<std::size_t>(std::popcount(bits(energy < coldest)));
    const unsigned broken = bits(valid) ^ all_lanes;
    if (broken != 0) [[unlikely]] {
      pressure = valid ? pressure : unknown;
      temperature = valid ? temperature : unknown;
      sound_speed = valid ? sound_speed : unknown;
      if (report.out_of_range == 0) {
        report.first = i + static_cast<std::size_t>(std::countr_zero(broken));
        report.bound =
            broken_bound(batch.density[report.first], batch.specific_internal_energy[report.first]);
      }
      report.out_of_range += static_cast<std::size_t>(std::popcount(broken));
    }
    store(&batch.pressure[i], pressure, count);
    store(&batch.temperature[i], temperature, count);
    store(&batch.sound_speed[i], sound_speed, count);
    if (melted || vaporised) {
      Lanes fraction = {};
      if constexpr (requires { isochore.vaporised_fraction(held); }) {
        fraction = isochore.vaporised_fraction(held);
      }
      if (broken != 0) [[unlikely]]
        fraction = valid ? fraction : unknown;
      if (melted) store(&batch.melted_fraction[i], fraction, count);
      if (vaporised) store(&batch.vaporised_fraction[i], fraction, count);
    }
  }
  return report;
}

template <Curve C>
State ConstantHeatCapacity<C>::state(double density, double specific_internal_energy) const {
  State s;
  s.density = density;
  s.specific_internal_energy = specific_internal_energy;
  const RangeReport report = evaluate({{&s.density, 1},
                                       {&s.specific_internal_energy, 1},
                                       {&s.pressure, 1},
                                       {&s.temperature, 1},
                                       {&s.sound_speed, 1},
                                       {&s.melted_fraction, 1},
                                       {&s.vaporised_fraction, 1}});
  if (report.out_of_range > 0) throw_out_of_range(report.bound, density, specific_internal_energy);
  const double heat = curve_.heat_capacity();
  const auto isochore = curve_.isochore(broadcast(density));
  const double cold_energy = isochore.cold_energy[0];
  const double held = std::max(specific_internal_energy, cold_energy + heat * least_temperature);
  const Response r = isochore.response(broadcast(held));
  const double by_energy = r.by_energy[0];
  s.heat_capacity = heat;
  s.gruneisen = by_energy / density;
  s.specific_entropy =
      heat * (std::log(s.temperature / reference_temperature()) - curve_.log_isentrope_temperature(density));
  // de_c/drho: the cold curve's own work, unless the temperature is only an estimate.
  double cold_slope = (s.pressure - by_energy * (held - cold_energy)) / (density * density);
  if constexpr (requires { curve_.cold_energy_slope(density); }) {
    cold_slope = curve_.cold_energy_slope(density);
  }
  s.isothermal_bulk_modulus = density * (r.by_density[0] + by_energy * cold_slope);
  s.phase = curve_.phase(density, held);
  return s;
}

template <Curve C>
State ConstantHeatCapacity<C>::state_at_temperature(double density, double temperature) const {
  if (!(temperature >= least_temperature) || !std::isfinite(temperature)) {
    throw StateError(fmt::format("{}: temperature must be finite and at least {} K, not {}", name,
                                 least_temperature, temperature));
  }
  if (const std::string_view bound = broken_bound(density, 0.0); !bound.empty()) {
    throw_out_of_range(bound, density, State::unknown);
  }
  return state(density,
               curve_.isochore(broadcast(density)).cold_energy[0] + curve_.heat_capacity() * temperature);
}

}  // namespace whipple::eos
