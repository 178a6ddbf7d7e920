// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"
#include "eos/models/crystal_surface.hpp"
#include "src/core/base/parameter_table.hpp"

namespace whipple::eos {

/// Holds the constants of the model "md": the crystal, the states that may be simulated, and the accuracy.
struct SimulatedConstants {
  std::string element, potential, store;
  std::vector<double> temperature;
  double least_volume_ratio = 0.75, greatest_volume_ratio = 1.05, spacing = 0.1;
  double tolerance = 5e8;
  double reference_temperature = 293.0;
  std::int64_t divisions = 3;
  std::int64_t cells = 4, equilibration_steps = 1000, steps = 3000, seed = 1;

  static ParameterTable<SimulatedConstants> parameters();
};

/// Models a crystal whose states are simulated when a run needs them, and stored
/// (docs/theory/equations_of_state.md, "Simulated crystals"). For small studies: solids only.
class SimulatedCrystal final : public EquationOfState {
 public:
  static constexpr std::string_view name = "md";

  /// @throws InputError if the constants contradict each other; StateError if there is no state of zero
  /// pressure at the reference temperature
  SimulatedCrystal(const SimulatedConstants& constants, std::unique_ptr<IsochoreSource> source);

  [[nodiscard]] std::string_view model() const override { return name; }
  [[nodiscard]] double reference_density() const override { return reference_density_; }
  [[nodiscard]] double reference_temperature() const override { return constants_.reference_temperature; }
  [[nodiscard]] double reference_energy() const override { return 0.0; }
  [[nodiscard]] double maximum_density() const override { return 1.0 / surface_.least_volume(); }
  [[nodiscard]] double minimum_energy(double density) const override;
  [[nodiscard]] double least_temperature() const override { return 0.0; }
  RangeReport evaluate(const Batch& batch) const override;
  [[nodiscard]] State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override;
  [[nodiscard]] std::string constants() const override;
  /// Returns the estimated error of the pressure at a density, Pa.
  [[nodiscard]] double pressure_error(double density) const { return cell(density).error; }

 private:
  struct Derivatives {
    double pressure, heat_capacity, gruneisen, isothermal_modulus, sound_speed_squared;
  };
  [[nodiscard]] Derivatives derivatives(const CrystalSurface::Point& point, double volume,
                                        double temperature) const;
  [[nodiscard]] double temperature_of(double thermal_energy) const;
  [[nodiscard]] const CrystalSurface::Cell& cell(double density) const;

  SimulatedConstants constants_;
  CrystalSurface surface_;
  double greatest_temperature_;
  double reference_density_ = 0.0, energy_zero_ = 0.0;
};

/// Creates the source of a crystal's isochores from the constants of its model.
/// @throws InputError if the potential or the database cannot be used
using IsochoreSourceMaker = std::function<std::unique_ptr<IsochoreSource>(const SimulatedConstants&)>;

/// Registers the simulator of crystals for the whole process. A program that can simulate calls it once, before it
/// reads materials.
void set_isochore_source(IsochoreSourceMaker maker);

/// Builds the model on the registered source.
/// @throws InputError if no source is registered, or as the source and the model do
std::unique_ptr<SimulatedCrystal> simulated_crystal(const SimulatedConstants& constants);

}  // namespace whipple::eos
