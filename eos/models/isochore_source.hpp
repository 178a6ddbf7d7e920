// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace whipple::eos {

/// Holds means over a simulated crystal at one volume: P and E of the static crystal, and at several temperatures.
/// SI, per unit mass; errors are standard errors.
struct SimulatedIsochore {
  struct State {
    double temperature = 0.0;
    double pressure = 0.0, pressure_error = 0.0;
    double energy = 0.0, energy_error = 0.0;
  };
  double volume = 0.0;
  double cold_pressure = 0.0, cold_energy = 0.0;
  std::vector<State> states;
};

/// Provides isochores of a crystal: molecular dynamics, or a formula in tests. Equal volumes give bitwise equal
/// results, regardless of the order of the requests.
class IsochoreSource {
 public:
  virtual ~IsochoreSource() = default;
  /// Returns the volume of the static crystal at zero pressure, m^3/kg, which is that of ratio 1.
  [[nodiscard]] virtual double static_volume() const = 0;
  [[nodiscard]] virtual double molar_mass() const = 0;
  /// Returns isochores at given volumes.
  /// @param volume_ratios  V over that of the static crystal
  /// @throws StateError naming a state that is not crystalline or cannot be computed
  virtual std::vector<SimulatedIsochore> isochores(std::span<const double> volume_ratios) = 0;
};

}  // namespace whipple::eos
