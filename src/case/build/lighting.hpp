// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "src/case/detonation.hpp"
#include "src/core/base/tensor.hpp"
#include "src/particles/particles.hpp"

namespace whipple::cases {

/// Describes the region of detonation and its velocity.
struct DetonationField {
  Vector3 lower = Vector3::Zero();               ///< m, of a box around all explosive
  std::array<std::size_t, 3> cells = {1, 1, 1};  ///< along each axis; one along z in two dimensions
  double cell = 0.0;                             ///< m
  /// Returns the detonation velocity (m/s) of the explosive at a point; 0: no explosive there.
  std::function<double(const Vector3&)> velocity;
};

/// Computes the first arrival of the detonation, |grad t| = 1/D, through explosive only (docs/theory/burn.md, section
/// 2) by an any-angle search on a grid. A cell with an unobstructed line to a detonator through explosive of one
/// velocity is lit along that line; every other cell is lit by the nearest cell, connected likewise, around which the
/// front must turn. The result is independent of the number of threads.
class Arrival {
 public:
  Arrival(DetonationField field, std::span<const Detonation> detonations);

  /// Returns the arrival time (s) at a point in or next to explosive of a velocity (m/s); `never` (-1) if the
  /// detonation does not arrive. Exact for straight lines.
  [[nodiscard]] double at(const Vector3& point, double velocity) const;

 private:
  using Index = std::array<std::ptrdiff_t, 3>;
  [[nodiscard]] Index index_of(const Vector3& point) const;
  [[nodiscard]] std::size_t number_of(const Index& index) const;
  [[nodiscard]] bool holds(const Index& index) const;
  [[nodiscard]] Index index_of(std::size_t cell) const;
  [[nodiscard]] Vector3 centre(std::size_t cell) const;
  /// Calls f(number) for the 26 neighbours of a cell (8 in two dimensions).
  template <class Function>
  void for_each_neighbour(const Index& index, Function&& f) const;
  /// Returns whether a ray passes through explosive of this velocity only.
  /// @param from_outside  the ray may start outside of the explosive
  [[nodiscard]] bool sees(const Vector3& from, const Vector3& to, double velocity, bool from_outside) const;
  /// Returns the arrival time at a point from the source of a cell.
  [[nodiscard]] double by_source(std::uint32_t source, const Vector3& point, double velocity) const;
  void light_in_sight();
  void light_shadows();

  DetonationField field_;
  std::vector<Detonation> detonations_;
  std::vector<double> velocity_;          // m/s, of each cell; 0: no explosive
  std::vector<std::uint8_t> at_surface_;  // 1: a neighbour has a different velocity
  std::vector<double> time_;              // s, at the cell centre; infinite: not lit
  std::vector<std::uint32_t> source_;     // a detonator, or a cell: index plus number of detonators
};

/// Sets the lighting times of the particles of bodies that burn.
void set_lighting_times(const Case& setup, Particles& particles);

}  // namespace whipple::cases
