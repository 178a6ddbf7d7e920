// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eos/closure.hpp"

/// Implements the search of `mixture_at_energy` (docs/theory/equations_of_state.md, "Mixtures in
/// pressure-temperature equilibrium").
namespace whipple::eos {

/// Holds the derivatives of (V, e) with respect to the common pressure and temperature (K2).
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

/// Returns the response of one component (K1), which is also finite where an isochore melts at one temperature (C_v
/// infinite).
Response response(const State& state);

/// Searches the volumes and energies of the components at which pressure and temperature are common.
class ClosureSearch {
 public:
  /// Holds trial volumes and energies of the components.
  struct Trial {
    std::vector<double> volume, energy;
  };

  ClosureSearch(std::span<const Component> components, double density, double energy)
      : components_(components), volume_(1 / density), energy_(energy) {}

  // Initial volumes: equal compression, or all at their reference densities except the softest.
  [[nodiscard]] std::vector<double> equal_compression() const;
  [[nodiscard]] std::optional<std::vector<double>> softest_fills() const;
  /// Returns the energies of equal temperature at given volumes.
  [[nodiscard]] std::optional<Trial> equal_temperature(const std::vector<double>& volume) const;
  /// Performs a bracketed search over the volume fraction of the first component.
  [[nodiscard]] std::optional<std::vector<State>> split();

  /// Applies Newton's method; succeeds if it ends in a stable equilibrium.
  [[nodiscard]] std::optional<std::vector<State>> stable_equilibrium(const Trial& start);
  /// Returns the reason for the failure.
  [[nodiscard]] const std::string& reason() const {
    return beyond_spinodal_.empty() ? last_attempt_ : beyond_spinodal_;
  }

 private:
  /// Holds components of given volumes at a temperature.
  struct Isochores {
    double temperature = 0;
    Trial trial;
    double excess = 0;  ///< energy above the requested one
  };
  /// Holds the first component and the others in mutual equilibrium, at equal temperature.
  struct Division {
    std::vector<State> states;
    double log_ratio = 0;   ///< ln of the ratio of the two volumes
    double difference = 0;  ///< pressure of the first minus that of the others
  };
  /// Applies Newton's method to the equality of p and T (K3), damped so that the spread decreases.
  [[nodiscard]] std::optional<std::vector<State>> newton(Trial trial);
  [[nodiscard]] bool accept(const std::vector<State>& states);
  [[nodiscard]] std::vector<State> evaluate(const Trial& trial) const;
  [[nodiscard]] std::vector<State> others(double volume, double energy) const;
  [[nodiscard]] std::optional<Division> divide(double log_ratio) const;
  /// Returns the values of `log_ratio` to sample.
  [[nodiscard]] std::vector<double> divisions() const;
  /// Returns the last existing division between one that exists and one that does not.
  [[nodiscard]] Division edge(double inside, Division division, double outside) const;
  /// Finds the equilibrium between two divisions with opposite signs of the difference.
  [[nodiscard]] std::optional<std::vector<State>> between(Division left, Division right);
  [[nodiscard]] static Trial trial_of(const std::vector<State>& states);

  std::span<const Component> components_;
  double volume_, energy_;
  std::string last_attempt_ = "no state to start from";
  std::string beyond_spinodal_;  ///< an equilibrium that was found but is not stable
};

}  // namespace whipple::eos
