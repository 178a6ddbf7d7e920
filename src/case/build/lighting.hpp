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

/// Where detonation runs and how fast.
struct DetonationField {
  Vector3 lower = Vector3::Zero();               ///< m, of a box around all explosive
  std::array<std::size_t, 3> cells = {1, 1, 1};  ///< along each axis; one along z in two dimensions
  double cell = 0.0;                             ///< m
  /// Returns the detonation velocity (m/s) of the explosive at a point; 0: no explosive is there.
  std::function<double(const Vector3&)> velocity;
};

/// First arrival of detonation, |grad t| = 1/D, in explosive only (docs/theory/burn.md, section 2): any-angle search on
/// a grid. A cell that a detonator sees through explosive of one velocity is lit by it in a straight line; every other
/// one by the nearest cell, seen likewise, that the front has to go round. The result does not depend on the number of
/// threads.
class Arrival {
 public:
  Arrival(DetonationField field, std::span<const Detonation> detonations);

  /// Returns the time (s) of arrival at a point of or beside explosive of a velocity (m/s); `never` (-1) where none
  /// arrives. Straight lines are exact.
  [[nodiscard]] double at(const Vector3& point, double velocity) const;

 private:
  using Index = std::array<std::ptrdiff_t, 3>;
  [[nodiscard]] Index index_of(const Vector3& point) const;
  [[nodiscard]] std::size_t number_of(const Index& index) const;
  [[nodiscard]] bool holds(const Index& index) const;
  [[nodiscard]] Index index_of(std::size_t cell) const;
  [[nodiscard]] Vector3 centre(std::size_t cell) const;
  /// Calls f(number) for the neighbours of a cell, 26 or 8 of them.
  template <class Function>
  void for_each_neighbour(const Index& index, Function&& f) const;
  /// Returns whether a ray runs through explosive of this velocity.
  /// @param from_outside  it may begin where no explosive is
  [[nodiscard]] bool sees(const Vector3& from, const Vector3& to, double velocity, bool from_outside) const;
  /// Returns the arrival at a point by the source of a cell.
  [[nodiscard]] double by_source(std::uint32_t source, const Vector3& point, double velocity) const;
  void light_in_sight();
  void light_shadows();

  DetonationField field_;
  std::vector<Detonation> detonations_;
  std::vector<double> velocity_;          // m/s, of each cell; 0: no explosive
  std::vector<std::uint8_t> at_surface_;  // of each cell: a neighbour differs
  std::vector<double> time_;              // s, of its centre; infinite: not lit
  std::vector<std::uint32_t> source_;     // a detonator, or a cell: its number after those of the detonators
};

/// Sets the lighting times of the particles of bodies that burn.
void set_lighting_times(const Case& setup, Particles& particles);

}  // namespace whipple::cases
