// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <limits>
#include <string_view>
#include <variant>

#include "eos/equation_of_state.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/parameter_table.hpp"
#include "src/core/base/vector_math.hpp"

/// The common core of the models with a constant heat capacity (docs/theory/equations_of_state.md, section
/// 2).
namespace whipple::eos {

/// Compression limit rho/rho0 of condensed models that have no limit of their own.
inline constexpr double greatest_compression_ratio = 10;

/// p(rho, e), its partial derivatives and c^2, of four points.
struct Response {
  Lanes pressure, by_density, by_energy, squared_sound_speed;
};

/// Four densities of a model whose pressure is linear in the energy, p = A + B e with B = rho Gamma.
struct LinearIsochore {
  Lanes work;         ///< B/rho^2: what a pressure adds to c^2
  Lanes cold_energy;  ///< e_c
  Lanes A, A_slope;   ///< and its derivative by rho
  Lanes B, B_slope;   ///< and its derivative by rho

  [[nodiscard]] Response response(Lanes energy) const {
    const Lanes pressure = A + B * energy, by_density = A_slope + B_slope * energy;
    return {pressure, by_density, B, by_density + pressure * work};
  }
  /// p = p_r + rho Gamma (e - e_r) with Gamma constant and a curve that does its own work, de_r = p_r/rho^2
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
  /// Lane by lane one of two.
  [[nodiscard]] static LinearIsochore select(LanesMask first, const LinearIsochore& a,
                                             const LinearIsochore& b) {
    return {first ? a.work : b.work, first ? a.cold_energy : b.cold_energy,
            first ? a.A : b.A,       first ? a.A_slope : b.A_slope,
            first ? a.B : b.B,       first ? a.B_slope : b.B_slope};
  }
};

/// Requires of a model its pressure (Pa) and the energy e_c(rho) (J/kg) of its coldest state, T = 0.
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
  static constexpr bool has_phases =
      requires(const C& curve, Lanes lanes) { curve.isochore(lanes).vaporised_fraction(lanes); };
  /// p = A + B e at constant density.
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

  /// Energy of the coldest state at a density.
  /// @throws StateError above the compression limit
  [[nodiscard]] double minimum_energy(double density) const {
    return state_at_temperature(density, least_temperature).specific_internal_energy;
  }

  /// Energies that the pressure works on; empty: they are given.
  struct Work {
    std::span<double> energy;
    std::span<const double> half_change;
  };
  RangeReport evaluate(const Batch& batch) const { return evaluate(batch, Work{}); }
  /// See EquationOfState: here the slope of the pressure is known.
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
  static constexpr std::size_t block = 8;  ///< groups that pass through one step together
  /// The curve looks its points up in a table: first where they lie, then what is there.
  static constexpr bool tabulated = requires { typename C::Places; };
  static auto no_places() {
    if constexpr (tabulated) {
      return typename C::Places{};
    } else {
      return std::monostate{};
    }
  }

  RangeReport evaluate(const Batch& batch, const Work& work) const;
  /// e = e_0 - h p(e) with p = A + B max(e, coldest). Where the slope is too steep, by iteration from the
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

  /// `n` points, a multiple of `width`; leaves the bound of the report empty. `melted` and `vaporised` may be
  /// null, and so may `worked`, where the energies go that the pressure has worked on (it may be `energies`).
  /// Not to be inlined or cloned: a single point must run through the very instructions of a batch.
  [[gnu::noipa]] RangeReport evaluate_whole(const double* densities, const double* energies, double* worked,
                                            const double* half_changes, double* __restrict p,
                                            double* __restrict T, double* __restrict c,
                                            double* __restrict melted, double* __restrict vaporised,
                                            std::size_t n) const;
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
RangeReport ConstantHeatCapacity<C>::evaluate(const Batch& batch, const Work& work) const {
  const std::size_t n = batch.density.size(), whole = n / width * width, rest = n - whole;
  const bool melted = !batch.melted_fraction.empty(), vaporised = !batch.vaporised_fraction.empty();
  RangeReport report =
      evaluate_whole(batch.density.data(), batch.specific_internal_energy.data(), work.energy.data(),
                     work.half_change.data(), batch.pressure.data(), batch.temperature.data(),
                     batch.sound_speed.data(), melted ? batch.melted_fraction.data() : nullptr,
                     vaporised ? batch.vaporised_fraction.data() : nullptr, whole);
  if (rest > 0) {
    // The last points, with the reference state beside them.
    using Group = std::array<double, width>;
    Group density, energy, half_change{}, p{}, T, c, melt, vapour;
    density.fill(reference_density());
    energy.fill(reference_energy());
    const auto from = static_cast<std::ptrdiff_t>(whole);
    const bool works = !work.energy.empty();
    if (works) {
      std::copy_n(work.half_change.begin() + from, rest, half_change.begin());
      std::copy_n(batch.pressure.begin() + from, rest, p.begin());
    }
    std::copy_n(batch.density.begin() + from, rest, density.begin());
    std::copy_n(batch.specific_internal_energy.begin() + from, rest, energy.begin());
    RangeReport last =
        evaluate_whole(density.data(), energy.data(), works ? energy.data() : nullptr, half_change.data(),
                       p.data(), T.data(), c.data(), melt.data(), vapour.data(), width);
    if (works) std::copy_n(energy.begin(), rest, work.energy.begin() + from);
    if (last.first != RangeReport::none) last.first += whole;
    report.merge(last);
    std::copy_n(p.begin(), rest, batch.pressure.begin() + from);
    std::copy_n(T.begin(), rest, batch.temperature.begin() + from);
    std::copy_n(c.begin(), rest, batch.sound_speed.begin() + from);
    if (melted) std::copy_n(melt.begin(), rest, batch.melted_fraction.begin() + from);
    if (vaporised) std::copy_n(vapour.begin(), rest, batch.vaporised_fraction.begin() + from);
  }
  if (report.first != RangeReport::none) {
    report.bound = broken_bound(batch.density[report.first], batch.specific_internal_energy[report.first]);
  }
  return report;
}

template <Curve C>
RangeReport ConstantHeatCapacity<C>::evaluate_whole(const double* densities, const double* energies,
                                                    double* worked, const double* half_changes,
                                                    double* __restrict p, double* __restrict T,
                                                    double* __restrict c, double* __restrict melted,
                                                    double* __restrict vaporised, std::size_t n) const {
  constexpr double largest = std::numeric_limits<double>::max();
  const double greatest_density = maximum_density();
  double least_density = std::numeric_limits<double>::denorm_min();
  if constexpr (tabulated) least_density = curve_.least_usual_density();
  const double reference_rho = reference_density(), reference_e = reference_energy();
  const double heat = curve_.heat_capacity(), inverse_heat = 1 / heat;
  const Lanes least_squared =
      broadcast(std::pow(least_sound_speed_ratio * curve_.reference_sound_speed(), 2));
  std::size_t below = 0, out_of_range = 0, first = RangeReport::none;
  std::array<decltype(no_places()), block> places;
  for (std::size_t start = 0; start < n; start += block * width) {
    const std::size_t groups = std::min(block, (n - start) / width);
    if constexpr (tabulated) {
      for (std::size_t g = 0; g < groups; ++g) curve_.find(load(densities + start + g * width), places[g]);
    }
    for (std::size_t g = 0; g < groups; ++g) {
      const std::size_t i = start + g * width;
      Lanes density = load(densities + i), energy = load(energies + i);
      unsigned in_range = all_lanes;
      decltype(curve_.isochore(density)) isochore;
      // One test for the usual group, which NaN fails too; another one for its energies.
      if (bits((density >= least_density) & (density <= greatest_density)) == all_lanes) [[likely]] {
        if constexpr (tabulated) {
          isochore = curve_.usual_isochore(density, places[g]);
        } else {
          isochore = curve_.isochore(density);
        }
      } else {
        const LanesMask valid = (density > 0.0) & (density <= greatest_density);
        in_range = bits(valid);
        density = valid ? density : broadcast(reference_rho);
        energy = valid ? energy : broadcast(reference_e);
        isochore = curve_.isochore(density);
      }
      if constexpr (linear_in_energy) {
        if (worked != nullptr) {
          energy = solve_work(isochore, energy, load(half_changes + i),
                              isochore.cold_energy + heat * least_temperature, load(p + i));
          store(worked + i, energy);
        }
      }
      Lanes temperature = (energy - isochore.cold_energy) * inverse_heat;
      if (bits((temperature >= least_temperature) & (energy <= largest)) != all_lanes) [[unlikely]] {
        const LanesMask valid = absolute(energy) <= largest;
        in_range &= bits(valid);
        energy = valid ? energy : broadcast(reference_e);
        const Lanes coldest = isochore.cold_energy + heat * least_temperature;
        below += static_cast<std::size_t>(std::popcount(bits(energy < coldest)));
        energy = maximum(energy, coldest);
        temperature = maximum((energy - isochore.cold_energy) * inverse_heat, broadcast(least_temperature));
      }
      const Response r = isochore.response(energy);
      store(p + i, r.pressure);
      store(T + i, temperature);
      store(c + i, r.squared_sound_speed);
      Lanes fraction = {};
      if constexpr (requires { isochore.vaporised_fraction(energy); }) {
        fraction = isochore.vaporised_fraction(energy);
      }
      if (melted != nullptr) store(melted + i, fraction);
      if (vaporised != nullptr) store(vaporised + i, fraction);
      if (in_range != all_lanes) [[unlikely]] {
        for (std::size_t k = 0; k < width; ++k) {
          if ((in_range >> k & 1) != 0) continue;
          if (out_of_range++ == 0) first = i + k;
          for (double* const result : {p, T, c, melted, vaporised})
            if (result != nullptr) result[i + k] = State::unknown;
        }
      }
    }
    // The floor comes first: a NaN in the second operand stays.
    for (std::size_t g = 0; g < groups; ++g) {
      double* const at = c + start + g * width;
      store(at, sqrt(maximum(least_squared, load(at))));
    }
  }
  RangeReport report;
  report.out_of_range = out_of_range;
  report.first = first;
  report.below_cold_curve = below;
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
