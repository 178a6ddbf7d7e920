// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace whipple::eos {

/// Means over a simulated crystal at one volume: P and E of the static crystal, and at some temperatures. SI,
/// per mass; errors are standard errors.
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

/// Anything that knows isochores of a crystal: molecular dynamics, or in tests a formula. The same volumes
/// bring the same bits, in whatever order they are asked for.
class IsochoreSource {
 public:
  virtual ~IsochoreSource() = default;
  /// Volume of the static crystal at zero pressure, m^3/kg: that of ratio 1.
  [[nodiscard]] virtual double static_volume() const = 0;
  [[nodiscard]] virtual double molar_mass() const = 0;
  /// @param volume_ratios  V over that of the static crystal
  /// @throws StateError naming the state that is not a crystal's or cannot be had
  virtual std::vector<SimulatedIsochore> isochores(std::span<const double> volume_ratios) = 0;
};

}  // namespace whipple::eos
