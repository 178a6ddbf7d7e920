// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md, "Mixtures in pressure-temperature equilibrium".
#include "eos/mixture_of_two.hpp"

#include <algorithm>
#include <cmath>

#include "eos/closure_search.hpp"
#include "eos/modifiers/modified.hpp"

namespace whipple::eos {
namespace {

constexpr int most_iterations = 100;
constexpr double energy_step = 1e5;      // J/kg, difference for slopes: exact for models linear in the energy
constexpr double energy_raise = 1e6;     // J/kg, for a component evaluated below its cold curve
constexpr double tolerance = 1e-9;       // of pressure and energy
constexpr double least_pressure = 1e-1;  // Pa, resolution against pressures that cancel in a solid
constexpr double largest_shrinkage = 0.75, largest_growth = 1.5;  // of a volume in one iteration
constexpr double edge = 1e-9;                                     // distance from the compression limits

/// Holds one of the two materials at all points: its trial states and their results.
class Side {
 public:
  explicit Side(const EquationOfState& model)
      : model_(model), least_temperature_(model.least_temperature()) {}

  ModifierScratch volume, energy, pressure, temperature;

  /// Evaluates `count` points, and their slopes with respect to the energy.
  void evaluate(std::size_t count) {
    ModifierScratch density, raised, raised_pressure, raised_temperature, unused;
    for (std::size_t i = 0; i < count; ++i) {
      density[i] = 1.0 / volume[i];
      raised[i] = energy[i] + energy_step;
    }
    const auto part = [count](auto& values) { return std::span(values).first(count); };
    model_.evaluate(
        {part(density), part(energy), part(pressure), part(temperature), part(sound_speed_), {}, {}});
    model_.evaluate(
        {part(density), part(raised), part(raised_pressure), part(raised_temperature), part(unused), {}, {}});
    for (std::size_t i = 0; i < count; ++i) {
      pressure_slope_[i] = (raised_pressure[i] - pressure[i]) / energy_step;
      temperature_slope_[i] = (raised_temperature[i] - temperature[i]) / energy_step;
    }
  }
  /// Returns whether a point was evaluated below the cold curve, where nothing depends on the energy; its energy is
  /// then raised above it.
  bool raise_if_cold(std::size_t i) {
    if (temperature[i] > least_temperature_ * (1.0 + edge)) return false;
    energy[i] += energy_raise + std::max(pressure[i], 0.0) * volume[i];
    return true;
  }
  [[nodiscard]] double least_temperature() const { return least_temperature_; }
  [[nodiscard]] double heat_capacity(std::size_t i) const { return 1.0 / temperature_slope_[i]; }
  /// Brings a point to a temperature at its volume; returns the change of its energy.
  double bring_to(std::size_t i, double wanted) {
    const double change = (wanted - temperature[i]) * heat_capacity(i);
    energy[i] += change;
    pressure[i] += pressure_slope_[i] * change;
    temperature[i] = wanted;
    return change;
  }
  /// Returns the response of (K1) and (K2).
  [[nodiscard]] Response response(std::size_t i) const {
    const double P_e = pressure_slope_[i], T_e = temperature_slope_[i],
                 impedance = sound_speed_[i] / volume[i];
    const double P_V = pressure[i] * P_e - impedance * impedance,
                 T_V = pressure[i] * T_e - temperature[i] * P_e;
    const double determinant = P_V * T_e - P_e * T_V;
    return {T_e / determinant, -P_e / determinant, -T_V / determinant, P_V / determinant};
  }

 private:
  const EquationOfState& model_;
  double least_temperature_;
  ModifierScratch sound_speed_, pressure_slope_, temperature_slope_;
};

/// Holds bounds of the volume of the first material between which the difference of the pressures changes sign.
struct Bracket {
  double lower, upper;
  [[nodiscard]] bool is_closed() const { return upper - lower <= 4e-16 * upper; }
};

/// Solves the points of a chunk together.
class Solution {
 public:
  Solution(const MixtureOfTwo& mixture, const Batch& batch, std::span<const double> fraction)
      : batch_(batch),
        fraction_(fraction),
        first_(mixture.first),
        second_(mixture.second),
        shift_(mixture.energy_of_first) {
    const double V1 = (1.0 + edge) / mixture.first.maximum_density(),
                 V2 = (1.0 + edge) / mixture.second.maximum_density();
    const double rest = 1.0 / mixture.first.reference_density();
    for (std::size_t i = 0; i < fraction.size(); ++i) {
      const double x = fraction[i], V = 1.0 / batch.density[i];
      bracket_[i] = {V1, (V - x * V2) / (1.0 - x)};
      open_[i] = bracket_[i].lower < bracket_[i].upper && std::isfinite(batch.specific_internal_energy[i]);
      const double start =
          open_[i] ? std::clamp(std::min(V, rest), bracket_[i].lower, bracket_[i].upper) : rest;
      first_.volume[i] = start;
      second_.volume[i] = open_[i] ? (V - (1.0 - x) * start) / x : 1.0 / mixture.second.reference_density();
      first_.energy[i] =
          open_[i] ? batch.specific_internal_energy[i] - shift_ : mixture.first.reference_energy();
      second_.energy[i] = open_[i] ? batch.specific_internal_energy[i] : mixture.second.reference_energy();
      batch.pressure[i] = batch.temperature[i] = batch.sound_speed[i] = State::unknown;
    }
  }

  RangeReport solve() {
    const std::size_t count = fraction_.size();
    RangeReport report;
    for (int k = 0;
         k < most_iterations && std::any_of(
                                    open_.begin(), open_.begin() + count, [](bool b) { return b; });
         ++k) {
      first_.evaluate(count);
      second_.evaluate(count);
      for (std::size_t i = 0; i < count; ++i) {
        if (open_[i]) open_[i] = !advance(i, report);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (std::isfinite(batch_.pressure[i])) continue;
      if (report.out_of_range++ == 0) report.first = i;
      report.bound = "no common pressure and temperature of two materials";
    }
    return report;
  }

 private:
  /// Performs one iteration; returns whether the point is solved.
  bool advance(std::size_t i, RangeReport& report) {
    const bool cold_first = first_.raise_if_cold(i), cold_second = second_.raise_if_cold(i);
    if (cold_first || cold_second) return false;
    const double x = fraction_[i], V = 1.0 / batch_.density[i];
    const double wanted = common_temperature(i);
    const double coldest = 2.0 * std::max(first_.least_temperature(), second_.least_temperature());
    const double T = std::max(wanted, coldest);
    const double changes[2] = {first_.bring_to(i, T), second_.bring_to(i, T)};
    const double p1 = first_.pressure[i], p2 = second_.pressure[i];
    const Response r1 = first_.response(i), r2 = second_.response(i);
    Response sum;
    sum.add(1.0 - x, r1);
    sum.add(x, r2);
    Bracket& bracket = bracket_[i];
    (p1 > p2 ? bracket.lower : bracket.upper) = first_.volume[i];
    const bool settled = std::abs(changes[0]) <= tolerance * (std::abs(first_.energy[i]) + energy_step) &&
                         std::abs(changes[1]) <= tolerance * (std::abs(second_.energy[i]) + energy_step);
    if (settled && (std::abs(p1 - p2) <= tolerance * std::abs(p2) + least_pressure || bracket.is_closed())) {
      report.below_cold_curve += wanted < coldest ? 1 : 0;
      finish(i, x * p2 + (1.0 - x) * p1, T, sum);
      return true;
    }
    // (K3): change of the common pressure and temperature that restores volume and energy.
    const double of_volume = (1.0 - x) * r1.volume_by_pressure * p1 + x * r2.volume_by_pressure * p2;
    const double of_energy = (1.0 - x) * r1.energy_by_pressure * p1 + x * r2.energy_by_pressure * p2;
    const double p =
        (of_volume * sum.energy_by_temperature - of_energy * sum.volume_by_temperature) / sum.determinant();
    const double rise =
        (sum.volume_by_pressure * of_energy - sum.energy_by_pressure * of_volume) / sum.determinant();
    const double newton =
        first_.volume[i] + r1.volume_by_pressure * (p - p1) + r1.volume_by_temperature * rise;
    double next = std::clamp(newton, largest_shrinkage * first_.volume[i], largest_growth * first_.volume[i]);
    if (!(next > bracket.lower && next < bracket.upper)) next = std::sqrt(bracket.lower * bracket.upper);
    first_.volume[i] = next;
    if (next == newton) {
      first_.energy[i] += r1.energy_by_pressure * (p - p1) + r1.energy_by_temperature * rise;
      second_.energy[i] += r2.energy_by_pressure * (p - p2) + r2.energy_by_temperature * rise;
    }
    second_.volume[i] = (V - (1.0 - x) * first_.volume[i]) / x;
    return false;
  }
  /// Returns the common temperature of both at their volumes if together they have the energy of the point.
  [[nodiscard]] double common_temperature(std::size_t i) const {
    const double x = fraction_[i], c1 = first_.heat_capacity(i), c2 = second_.heat_capacity(i);
    const double cold = (1.0 - x) * (first_.energy[i] + shift_ - c1 * first_.temperature[i]) +
                        x * (second_.energy[i] - c2 * second_.temperature[i]);
    return (batch_.specific_internal_energy[i] - cold) / ((1.0 - x) * c1 + x * c2);
  }
  /// Stores the results of (K4).
  void finish(std::size_t i, double pressure, double temperature, const Response& sum) const {
    const double V = 1.0 / batch_.density[i], determinant = sum.determinant();
    const double P_e = -sum.volume_by_temperature / determinant,
                 P_V = sum.energy_by_temperature / determinant;
    batch_.pressure[i] = pressure;
    batch_.temperature[i] = temperature;
    batch_.sound_speed[i] = V * std::sqrt(std::max(pressure * P_e - P_V, 0.0));
  }

  const Batch& batch_;
  std::span<const double> fraction_;
  Side first_, second_;
  double shift_;
  std::array<Bracket, modifier_chunk> bracket_;
  std::array<bool, modifier_chunk> open_;
};

}  // namespace

RangeReport MixtureOfTwo::evaluate(const Batch& batch, std::span<const double> second_fraction) const {
  RangeReport report;
  for (std::size_t start = 0; start < batch.density.size(); start += modifier_chunk) {
    const std::size_t count = std::min(modifier_chunk, batch.density.size() - start);
    const Batch part = part_of(batch, start, count);
    RangeReport of_part = Solution(*this, part, second_fraction.subspan(start, count)).solve();
    if (of_part.first != RangeReport::none) of_part.first += start;
    report.merge(of_part);
  }
  return report;
}

}  // namespace whipple::eos
