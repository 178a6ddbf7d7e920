// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>

#include "eos/curve.hpp"
#include "eos/equation_of_state.hpp"
#include "src/core/base/error.hpp"

/// Marks a function that has one body, neither inlined nor cloned for some of its callers.
#ifdef __clang__
#define WHIPPLE_SINGLE_BODY [[gnu::noinline]]
#else
#define WHIPPLE_SINGLE_BODY [[gnu::noipa]]
#endif

/// Provides the common core of the models with a constant heat capacity (docs/theory/equations_of_state.md, section
/// 2).
namespace whipple::eos {

/// Compression limit rho/rho0 of condensed models without another limit.
inline constexpr double greatest_compression_ratio = 10;

/// Evaluates a complete equation of state from p(rho, e) and the cold energy e_c(rho):
///   T = (e - e_c)/c_v,  c^2 = (dp/drho)_e + (p/rho^2) (dp/de)_rho,  Gamma = (dp/de)_rho/rho,
///   s = c_v ln(T/T_s),  d ln T_s/d ln rho = Gamma,  K_T = rho [(dp/drho)_e + (dp/de)_rho de_c/drho].
///
/// Explicit policies at the limits:
///  - energy below that of `least_temperature`: T, p and c are those of that temperature, the point is
///    counted, e is kept;
///  - c^2 < `least_sound_speed_ratio`^2 of the reference state (tension beyond the spinodal): c is limited to
///    that value;
///  - density not positive, beyond `maximum_density()`, or a non-finite value: NaN, the point is counted.
template <Curve C>
class ConstantHeatCapacity {
 public:
  using Constants = typename C::Constants;
  static constexpr std::string_view name = C::name;
  static constexpr std::string_view summary = C::summary;
  static constexpr bool detonates = requires { C::detonates; };
  static constexpr double least_temperature = 1.0;         ///< K
  static constexpr double least_sound_speed_ratio = 0.01;  ///< of that of the reference state
  static constexpr bool has_phases =
      requires(const C& curve, Lanes lanes) { curve.isochore(lanes).vaporised_fraction(lanes); };
  /// Whether p = A + B e at constant density.
  static constexpr bool linear_in_energy = requires(const C& curve, Lanes lanes) {
    curve.isochore(lanes).A;
    curve.isochore(lanes).B;
  };
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

  /// Returns the energy of the coldest state at a density.
  /// @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  /// Describes the energies updated with the work of the pressure; empty: the energies are given.
  struct Work {
    std::span<double> energy;
    std::span<const double> half_change;
  };
  RangeReport evaluate(const Batch& batch) const { return evaluate(batch, Work{}); }
  /// Overrides EquationOfState::integrate; here the slope of the pressure is known.
  RangeReport integrate(const Batch& batch, std::span<double> energy,
                        std::span<const double> half_change) const
    requires linear_in_energy
  {
    return evaluate(batch, {energy, half_change});
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const;

 private:
  static constexpr std::size_t width = 4;  ///< points of a group
  static constexpr std::size_t block = 8;  ///< groups processed together in one step
  /// Whether the curve uses table look-ups: first the positions of the points, then the values there.
  static constexpr bool tabulated = requires { typename C::Places; };
  static auto no_places() {
    if constexpr (tabulated) {
      return typename C::Places{};
    } else {
      return std::monostate{};
    }
  }

  RangeReport evaluate(const Batch& batch, const Work& work) const;
  /// Solves e = e_0 - h p(e) with p = A + B max(e, coldest). Where the slope is too steep, it iterates from the
  /// pressure before the step.
  template <class Isochore>
  static Lanes solve_work(const Isochore& isochore, Lanes without, Lanes half_change, Lanes coldest,
                          Lanes pressure_before) {
    const auto after = [&](Lanes energy) {
      return without - half_change * (isochore.A + isochore.B * maximum(energy, coldest));
    };
    const Lanes slope = half_change * isochore.B;
    const LanesMask resolved = slope > least_work_slope;
    const Lanes linear = (without - half_change * isochore.A) / select(resolved, 1.0 + slope, broadcast(1.0));
    if (bits(resolved & (linear >= coldest)) == all_lanes) [[likely]]
      return linear;
    const Lanes iterated = after(after(without - half_change * pressure_before));
    return select(resolved, select(linear >= coldest, linear, after(coldest)), iterated);
  }

  /// Evaluates `n` points, a multiple of `width`; leaves the bound of the report empty. `melted` and `vaporised`
  /// may be null, and so may `worked`, which receives the energies after the work of the pressure (it may be
  /// `energies`). Must not be inlined or cloned: a single point must execute the same instructions as a batch.
  WHIPPLE_SINGLE_BODY RangeReport evaluate_whole(const double* densities, const double* energies,
                                                 double* worked, const double* half_changes,
                                                 double* __restrict p, double* __restrict T,
                                                 double* __restrict c, double* __restrict melted,
                                                 double* __restrict vaporised, std::size_t n) const;
  /// Returns the reason for a point being out of range; empty if it is not.
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
  // de_c/drho: from the work of the cold curve, unless the temperature is only an estimate.
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
