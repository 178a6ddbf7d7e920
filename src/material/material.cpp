// SPDX-License-Identifier: BSD-3-Clause
#include "src/material/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "src/base/error.hpp"
#include "src/base/text.hpp"
#include "src/material/strength/none.hpp"

namespace whipple {
namespace {

/// State of zero pressure at a temperature by Newton iteration in the density, rho <- rho (1 - p / K_T).
eos::State state_of_zero_pressure(const eos::EquationOfState& model, double temperature) {
  double density = model.reference_density();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const eos::State state = model.state_at_temperature(density, temperature);
    const double isentropic = density * state.sound_speed * state.sound_speed;
    const double modulus = state.isothermal_bulk_modulus > 0.0 ? state.isothermal_bulk_modulus : isentropic;
    if (!(modulus > 0.0)) break;
    if (std::abs(state.pressure) <= 1e-11 * modulus) return state;
    density *= 1.0 - std::clamp(state.pressure / modulus, -0.1, 0.1);
    if (density < 0.3 * model.reference_density() || density > 1.5 * model.reference_density()) break;
  }
  throw InputError(
      fmt::format("no condensed state of zero pressure at {} K: give a density as well", temperature));
}

}  // namespace

Material make_material(std::string name, std::shared_ptr<const eos::EquationOfState> eos,
                       std::shared_ptr<const strength::Strength> strength,
                       std::vector<std::shared_ptr<const failure::Criterion>> failure) {
  Material material;
  material.name = std::move(name);
  material.eos = std::move(eos);
  material.strength = strength ? std::move(strength) : std::make_shared<const strength::NoneModel>();
  material.failure = std::move(failure);
  material.reference = initial_state(material);
  return material;
}

eos::State initial_state(const Material& material, std::optional<double> density,
                         std::optional<double> temperature) {
  const eos::EquationOfState& model = *material.eos;
  try {
    // A gas, which has no state of zero pressure, or a model without temperature.
    if (!temperature && (std::isnan(model.reference_temperature()) || (!model.condensed() && !density))) {
      return model.state(density.value_or(model.reference_density()), model.reference_energy());
    }
    const double at = temperature.value_or(model.reference_temperature());
    return density ? model.state_at_temperature(*density, at) : state_of_zero_pressure(model, at);
  } catch (const StateError& fault) {
    throw InputError(fmt::format("initial state of material '{}': {}", material.name, fault.what()));
  } catch (const InputError& fault) {
    throw InputError(fmt::format("initial state of material '{}': {}", material.name, fault.what()));
  }
}

void initialise(const Material& material, MaterialPoints& points, std::size_t begin, std::size_t end,
                std::optional<double> density, std::optional<double> temperature) {
  const eos::State state =
      density || temperature ? initial_state(material, density, temperature) : material.reference;
  const auto carried = [](double value) { return std::isnan(value) ? 0.0 : value; };
  const std::array rho = {state.density}, p = {state.pressure}, kelvin = {state.temperature}, strain = {0.0};
  std::array<double, 1> modulus = {};
  material.strength->shear_modulus({rho, p, kelvin, strain}, modulus);
  const double solid = 1.0 - state.melted_fraction;
  const double sound =
      std::sqrt(state.sound_speed * state.sound_speed + 4.0 / 3.0 * solid * modulus[0] / state.density);
  for (std::size_t i = begin; i < end; ++i) {
    points.volume[i] = points.mass[i] / state.density;
    points.void_volume[i] = 0.0;
    points.specific_internal_energy[i] = state.specific_internal_energy;
    points.pressure[i] = state.pressure;
    points.artificial_viscosity[i] = 0.0;
    points.deviatoric_stress[i] = {};
    points.temperature[i] = carried(state.temperature);
    points.sound_speed[i] = sound;
    points.plastic_strain[i] = 0.0;
    points.melted_fraction[i] = state.melted_fraction;
    points.vaporised_fraction[i] = state.vaporised_fraction;
    points.distension[i] = state.distension;
    points.failure_threshold_factor[i] = 1.0;
    points.failed[i] = failure::intact;
  }
}

std::string Material::constants() const {
  std::string text = file.empty() ? "" : fmt::format("# read from {}\n", file.string());
  text += fmt::format("name = {}\nsource = {}\n", whipple::quoted(name), whipple::quoted(source));
  if (!note.empty()) text += fmt::format("note = {}\n", whipple::quoted(note));
  text += fmt::format("[eos]\nmodel = {}\n{}\n[strength]\n{}", whipple::quoted(eos->model()),
                      eos->constants(), strength->constants());
  for (const auto& criterion : failure) text += fmt::format("\n[[failure]]\n{}", criterion->constants());
  return text;
}

}  // namespace whipple
