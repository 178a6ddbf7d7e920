// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "eos/modifiers/modified.hpp"

namespace whipple::eos {

struct FloorConstants {
  double pressure = 0;  ///< Pa
};

/// Limits the pressure of a fluid that cannot carry tension: p = max(p_b, pressure), the energy is kept. Below the
/// floor the fluid is a mixture of material and void: no stiffness (K_T = 0, Gamma = 0), and the sound speed is
/// `sound_speed_ratio` times that of the reference state. The points there are counted
/// (`RangeReport::at_pressure_floor`); the work p dV of the floor is not thermodynamic work of the modified model.
class Floor final : public Modified {
 public:
  using Constants = FloorConstants;
  static constexpr std::string_view name = "floor";
  static constexpr std::string_view summary =
      "minimum pressure of a fluid without tension (cavitation), counted";
  static constexpr double sound_speed_ratio = 0.01;
  static ParameterTable<Constants> parameters() {
    return {real("pressure", &Constants::pressure, "Pa", range::any(), "minimum pressure; negative: tension")
                .optional()};
  }

  Floor(std::shared_ptr<const EquationOfState> base, const Constants& constants)
      : Modified(std::move(base)), constants_(constants) {
    const State reference =
        this->base().state(this->base().reference_density(), this->base().reference_energy());
    if (reference.pressure <
        constants.pressure - 1e-6 * reference.density * reference.sound_speed * reference.sound_speed) {
      throw InputError("floor: the reference state of the model is below the minimum pressure");
    }
    cavity_sound_speed_ = sound_speed_ratio * reference.sound_speed;
  }

  RangeReport evaluate(const Batch& batch) const override {
    RangeReport report = base().evaluate(batch);
    for (std::size_t i = 0; i < batch.pressure.size(); ++i) {
      if (!(batch.pressure[i] < constants_.pressure)) continue;
      batch.pressure[i] = constants_.pressure;
      batch.sound_speed[i] = cavity_sound_speed_;
      ++report.at_pressure_floor;
    }
    return report;
  }
  [[nodiscard]] State state(double density, double specific_internal_energy) const override {
    return floored(base().state(density, specific_internal_energy));
  }
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override {
    return floored(base().state_at_temperature(density, temperature));
  }
  [[nodiscard]] std::unique_ptr<EquationOfState> unloading(const State& from) const override {
    return unloading_with<Floor>(from, constants_);
  }
  [[nodiscard]] std::string constants() const override { return constants_with_table<Floor>(constants_); }

 private:
  [[nodiscard]] State floored(State s) const {
    if (!(s.pressure < constants_.pressure)) return s;
    s.pressure = constants_.pressure;
    s.sound_speed = cavity_sound_speed_;
    s.gruneisen = 0;
    s.isothermal_bulk_modulus = 0;
    s.thermal_expansion = s.isobaric_heat_capacity = State::unknown;
    s.phase = "cavitated";
    derive(s);
    return s;
  }

  Constants constants_;
  double cavity_sound_speed_ = 0;
};

}  // namespace whipple::eos
