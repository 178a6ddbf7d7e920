// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eos/closure.hpp"

/// The search behind `mixture_at_energy` (docs/theory/equations_of_state.md, "Mixtures in
/// pressure-temperature equilibrium").
namespace whipple::eos {

/// Change of (V, e) with the common pressure and temperature (K2).
struct Response {
  double volume_by_pressure = 0, volume_by_temperature = 0;
  double energy_by_pressure = 0, energy_by_temperature = 0;

  void add(double fraction, const Response& other) {
    volume_by_pressure += fraction * other.volume_by_pressure;
    volume_by_temperature += fraction * other.volume_by_temperature;
    energy_by_pressure += fraction * other.energy_by_pressure;
    energy_by_temperature += fraction * other.energy_by_temperature;
  }
  [[nodiscard]] double determinant() const {
    return volume_by_pressure * energy_by_temperature - volume_by_temperature * energy_by_pressure;
  }
};

/// Response of one component (K1), finite also where an isochore melts at one temperature (C_v infinite).
Response response(const State& state);

/// Searches the volumes and energies of the components at which pressure and temperature are common.
class ClosureSearch {
 public:
  /// Volumes and energies that the components are tried at.
  struct Trial {
    std::vector<double> volume, energy;
  };

  ClosureSearch(std::span<const Component> components, double density, double energy)
      : components_(components), volume_(1 / density), energy_(energy) {}

  // Volumes to start from: equally compressed; or all at their reference densities but the softest.
  [[nodiscard]] std::vector<double> equal_compression() const;
  [[nodiscard]] std::optional<std::vector<double>> softest_fills() const;
  /// Energies of equal temperature at given volumes.
  [[nodiscard]] std::optional<Trial> equal_temperature(const std::vector<double>& volume) const;
  /// Bracketed search over the fraction of the volume of the first component.
  [[nodiscard]] std::optional<std::vector<State>> split();

  /// Newton's method, if it ends in a stable equilibrium.
  [[nodiscard]] std::optional<std::vector<State>> stable_equilibrium(const Trial& start);
  /// Why there was none.
  [[nodiscard]] const std::string& reason() const {
    return beyond_spinodal_.empty() ? last_attempt_ : beyond_spinodal_;
  }

 private:
  /// Components of given volumes at a temperature.
  struct Isochores {
    double temperature = 0;
    Trial trial;
    double excess = 0;  ///< energy above the asked one
  };
  /// First component and the others in equilibrium among themselves, at equal temperature.
  struct Division {
    std::vector<State> states;
    double log_ratio = 0;   ///< ln of the ratio of their volumes
    double difference = 0;  ///< pressure of the first above that of the others
  };
  /// Newton's method on the equality of p and T (K3), damped so that the spread falls.
  [[nodiscard]] std::optional<std::vector<State>> newton(Trial trial);
  [[nodiscard]] bool accept(const std::vector<State>& states);
  [[nodiscard]] std::vector<State> evaluate(const Trial& trial) const;
  [[nodiscard]] std::vector<State> others(double volume, double energy) const;
  [[nodiscard]] std::optional<Division> divide(double log_ratio) const;
  /// Values of `log_ratio` to look at.
  [[nodiscard]] std::vector<double> divisions() const;
  /// The last division that exists on the way from one that does to one that does not.
  [[nodiscard]] Division edge(double inside, Division division, double outside) const;
  /// Equilibrium between two divisions with opposite signs of the difference.
  [[nodiscard]] std::optional<std::vector<State>> between(Division left, Division right);
  [[nodiscard]] static Trial trial_of(const std::vector<State>& states);

  std::span<const Component> components_;
  double volume_, energy_;
  std::string last_attempt_ = "no state to start from";
  std::string beyond_spinodal_;  ///< an equilibrium that was found and is not stable
};

}  // namespace whipple::eos
