// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "src/device/material/update_point.hpp"
#include "src/device/points.hpp"

/// Constitutive update of the particles from the velocity gradients that the transfer left.
namespace whipple::device {

/// Updates the particles whose material has an equation of state and a strength of these kinds.
template <EosKind eos, StrengthKind strength>
struct StrainParticles {
  Points points;
  const MaterialConstants* materials;  ///< of each body
  const double* tables;
  MaterialStep step;

  WHIPPLE_POINT void operator()(std::size_t p) const {
    const MaterialConstants& material = materials[points.body[p]];
    if (material.eos != eos || material.strength != strength) return;
    const auto at = [&](std::uint32_t component) -> double& { return points.at(component, p); };
    const material::formulas::Matrix<double> l = {at(gradient),     at(gradient + 1), at(gradient + 2),
                                                  at(gradient + 3), at(gradient + 4), at(gradient + 5),
                                                  at(gradient + 6), at(gradient + 7), at(gradient + 8)};
    const double divergence_of_field = at(affine) + at(affine + 4) + at(affine + 8);
    MaterialState state = load(p);
    const MaterialResult result =
        update_point<eos, strength>(material, tables, step, l, divergence_of_field, state);
    store(p, state);
    at(plastic_work) = result.plastic_work;
    at(dissipation) = result.dissipation;
    at(plastic_heat) = result.plastic_heat;
    at(compression) = result.compression_rate;
    at(events) = static_cast<double>(result.events);
  }

 private:
  [[nodiscard]] WHIPPLE_POINT MaterialState load(std::size_t p) const {
    MaterialState state;
    for_each_number([&](double& number, std::uint32_t component) { number = points.at(component, p); },
                    state);
    state.deviator = points.symmetric(deviator, p);
    return state;
  }
  WHIPPLE_POINT void store(std::size_t p, MaterialState& state) const {
    for_each_number([&](const double& number, std::uint32_t component) { points.at(component, p) = number; },
                    state);
    const auto& s = state.deviator;
    points.at(deviator, p) = s.xx, points.at(deviator + 1, p) = s.yy, points.at(deviator + 2, p) = s.zz;
    points.at(deviator + 3, p) = s.xy, points.at(deviator + 4, p) = s.yz, points.at(deviator + 5, p) = s.zx;
  }
  /// Calls f(number of the state, its component) for what the material changes or reads, but for the deviator.
  template <class Function>
  static WHIPPLE_POINT void for_each_number(Function&& f, MaterialState& s) {
    f(s.mass, Component::mass);
    f(s.volume, Component::volume);
    f(s.void_volume, Component::void_volume);
    f(s.energy, Component::energy);
    f(s.pressure, Component::pressure);
    f(s.artificial_viscosity, Component::artificial_viscosity);
    f(s.heating_viscosity, Component::heating_viscosity);
    f(s.temperature, Component::temperature);
    f(s.sound_speed, Component::sound_speed);
    f(s.plastic_strain, Component::plastic_strain);
    f(s.melted, Component::melted);
    f(s.vaporised, Component::vaporised);
    f(s.failed, Component::failed);
    f(s.maximum_pressure, Component::maximum_pressure);
    f(s.maximum_temperature, Component::maximum_temperature);
    f(s.melting_time, Component::melting_time);
    f(s.threshold_factor, Component::threshold_factor);
    f(s.damage, Component::damage);
    f(s.fragment_size, Component::fragment_size);
    f(s.cold_work, Component::cold_work);
  }
};

/// Strains the particles, kind by kind of those that the materials have.
template <class Space>
void strain_all(Space& space, const Points& points, std::span<const MaterialConstants> of_bodies,
                const MaterialConstants* materials, const double* tables, const MaterialStep& step) {
  const auto run = [&]<EosKind eos, StrengthKind strength>() {
    for (const MaterialConstants& body : of_bodies) {
      if (body.eos != eos || body.strength != strength) continue;
      return space.for_each(points.size, StrainParticles<eos, strength>{points, materials, tables, step});
    }
  };
  const auto of_eos = [&]<EosKind eos>() {
    run.template operator()<eos, StrengthKind::none>();
    run.template operator()<eos, StrengthKind::von_mises>();
    run.template operator()<eos, StrengthKind::johnson_cook>();
    run.template operator()<eos, StrengthKind::steinberg_guinan>();
  };
  of_eos.template operator()<EosKind::gruneisen>();
  of_eos.template operator()<EosKind::table>();
}

}  // namespace whipple::device
