// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

#include "src/core/base/prefetch.hpp"
#include "src/core/base/tensor.hpp"
#include "src/particles/history.hpp"
#include "src/particles/phases.hpp"

namespace whipple {

/// Describes one array of a set of points: name and unit are those in output files and checkpoints.
template <class Points, class Value>
struct Field {
  const char* name;
  const char* unit;
  std::vector<Value> Points::* values;
  bool optional = false;  ///< empty unless a material or method of the run needs it
  double neutral = 0.0;   ///< of optional numbers: value of points that do not need them

  /// Returns the values of a set of points.
  template <class Set>
  [[nodiscard]] auto& of(Set& points) const {
    return points.*values;
  }
  /// Resizes the field; values of new points are undefined, or neutral.
  void resize(Points& points, std::size_t n) const {
    if constexpr (std::is_same_v<Value, double>) {
      (points.*values).resize(n, neutral);
    } else {
      (points.*values).resize(n);
    }
  }
};
template <class Points, class Value>
Field(const char*, const char*, std::vector<Value> Points::*) -> Field<Points, Value>;
template <class Points, class Value>
Field(const char*, const char*, std::vector<Value> Points::*, bool) -> Field<Points, Value>;
template <class Points, class Value>
Field(const char*, const char*, std::vector<Value> Points::*, bool, double) -> Field<Points, Value>;

/// Holds the state of material at points, one array per field (SI): the common part of MPM particles and Gauss points
/// of finite elements, so that `update_material` is one code path.
struct MaterialPoints {
  std::vector<double> mass;                      ///< kg, constant
  std::vector<double> volume;                    ///< m^3 of material: density = mass / volume enters the EOS
  std::vector<double> void_volume;               ///< m^3 of voids and open cracks (0: none)
  std::vector<double> specific_internal_energy;  ///< J/kg
  std::vector<double> pressure;              ///< Pa, positive in compression, without artificial viscosity
  std::vector<double> artificial_viscosity;  ///< Pa, negative in expansion
  std::vector<SymmetricTensor> deviatoric_stress;  ///< Pa, positive in tension
  std::vector<double> temperature;                 ///< K
  std::vector<double> sound_speed;  ///< m/s, longitudinal (with shear stiffness), for time step and viscosity
  std::vector<double> plastic_strain;      ///< equivalent plastic strain
  std::vector<double> melted_fraction;     ///< mass fraction of liquid and vapour
  std::vector<double> vaporised_fraction;  ///< mass fraction of vapour
  std::vector<std::uint8_t> failed;  ///< 0 intact, otherwise the cause: src/material/failure/criterion.hpp
  std::vector<double> maximum_pressure;     ///< Pa, so far
  std::vector<double> maximum_temperature;  ///< K, so far
  std::vector<double> melting_time;  ///< s, when half of the mass first melted; `never` (-1) if it has not
  std::vector<double> failure_threshold_factor;  ///< scatter of the failure threshold (1: none); optional
  std::vector<double> strength_factor;           ///< scatter of the flow stress (1: none); optional
  /// Holds the part of the artificial viscosity whose work is heat, Pa; the work of the rest becomes unresolved energy
  /// (docs/theory/dissipation.md, 3); optional
  std::vector<double> heating_viscosity;
  Histories history;  ///< declared by the material models

  static constexpr auto fields() {
    using P = MaterialPoints;
    return std::make_tuple(
        Field{"mass", "kg", &P::mass}, Field{"volume", "m^3", &P::volume},
        Field{"void_volume", "m^3", &P::void_volume},
        Field{"specific_internal_energy", "J/kg", &P::specific_internal_energy},
        Field{"pressure", "Pa", &P::pressure}, Field{"artificial_viscosity", "Pa", &P::artificial_viscosity},
        Field{"deviatoric_stress", "Pa", &P::deviatoric_stress}, Field{"temperature", "K", &P::temperature},
        Field{"sound_speed", "m/s", &P::sound_speed}, Field{"plastic_strain", "1", &P::plastic_strain},
        Field{"melted_fraction", "1", &P::melted_fraction},
        Field{"vaporised_fraction", "1", &P::vaporised_fraction}, Field{"failed", "1", &P::failed},
        Field{"maximum_pressure", "Pa", &P::maximum_pressure},
        Field{"maximum_temperature", "K", &P::maximum_temperature},
        Field{"melting_time", "s", &P::melting_time},
        Field{"failure_threshold_factor", "1", &P::failure_threshold_factor, true, 1.0},
        Field{"strength_factor", "1", &P::strength_factor, true, 1.0},
        Field{"heating_viscosity", "Pa", &P::heating_viscosity, true});
  }
};

/// Calls f(field) for every field common to all sets of a kind, excluding those declared by models.
template <class Points, class Function>
void for_each_field(Function&& f) {
  std::apply([&](const auto&... field) { (f(field), ...); }, Points::fields());
}

/// Calls f(field) for every field of a set of points, including those declared by its models; `field.of(set)` returns
/// the values of this set or of another one.
template <class Points, class Function>
void for_each_field(Points& points, Function&& f) {
  for_each_field<std::remove_const_t<Points>>(f);
  if constexpr (requires { points.history; }) {
    for (const History& history : std::as_const(points).history) {
      std::visit(
          [&]<class Value>(const std::vector<Value>&) {
            f(HistoryOf<Value>{history.field, history.field.name.c_str(), history.field.unit.c_str()});
          },
          history.values);
    }
  }
}

/// Prefetches the state of some points from `first` on into the second-level cache.
WHIPPLE_INLINE inline void prefetch_state(const MaterialPoints& points, std::size_t first) {
  for_each_field<MaterialPoints>([&](const auto& field) WHIPPLE_INLINE {
    const auto& values = points.*(field.values);
    if (!field.optional || !values.empty()) prefetch(first, values);
  });
  for (const History& history : points.history) {
    if (const auto* numbers = std::get_if<std::vector<double>>(&history.values)) prefetch(first, *numbers);
    if (const auto* tensors = std::get_if<std::vector<SymmetricTensor>>(&history.values))
      prefetch(first, *tensors);
    if (const auto* tensors = std::get_if<std::vector<Matrix3>>(&history.values)) prefetch(first, *tensors);
  }
}

/// Resizes all fields in use; optional fields that are not in use remain empty.
template <class Points>
void resize(Points& points, std::size_t n) {
  for_each_field(points, [&](const auto& field) {
    const auto& values = field.of(points);
    if (!field.optional || !values.empty()) field.resize(points, n);
  });
}

}  // namespace whipple
