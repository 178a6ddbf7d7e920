// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/core/base/tensor.hpp"

namespace whipple::solver {

/// Describes the points of a body on which a load acts: particles, or the nodes of elements.
struct LoadedPoints {
  std::span<const std::uint64_t> id;
  std::span<const Vector3> position;  ///< m
  std::span<const Vector3> velocity;  ///< m/s
  std::size_t body = 0;
};

/// Selects the material that a load accelerates.
enum class Moves : std::uint8_t {
  all_material,
  moving_material  ///< what is at rest stays at rest
};

/// Describes an acceleration by external forces.
struct Load {
  std::string name;
  /// Adds the accelerations (m/s^2) of the points at a time (s) to those given; called once per step and set of points.
  std::function<void(const LoadedPoints& points, double time, std::span<Vector3> acceleration)> add;
  /// Returns the first time (s), not before the given one, at which the load acts; infinite if it never acts again.
  std::function<double(double time)> next_event = [](double time) { return time; };
  Moves moves = Moves::all_material;
  /// Returns the acceleration (m/s^2) at a time (s) if it is the same for all points; empty otherwise.
  std::function<Vector3(double time)> of_all = {};
};

/// Returns a load with the same acceleration (m/s^2), a function of time (s), for all points.
/// @param begin  time from which it acts, s
Load uniform_load(std::string name, std::function<Vector3(double time)> acceleration,
                  double begin = -std::numeric_limits<double>::infinity());

/// Collects all loads; they add up, for particles and nodes of elements alike.
class Loads {
 public:
  void add(Load load) { loads_.push_back(std::move(load)); }

  /// Returns whether any load acts at a time (s).
  [[nodiscard]] bool act(double time) const { return next_event(time) <= time; }
  /// Returns whether all loads are the same for all points.
  [[nodiscard]] bool are_uniform() const;
  /// Returns the acceleration (m/s^2) of all points at a time (s) by loads that are the same for all.
  [[nodiscard]] Vector3 uniform_at(double time) const;
  /// Adds the accelerations (m/s^2) of the points at a time (s) to those given.
  void add_to(const LoadedPoints& points, double time, std::span<Vector3> acceleration) const;

  /// Returns the first time (s), not before the given one, at which any load acts; infinite if none acts again.
  [[nodiscard]] double next_event(double time) const;
  /// Returns the first time (s), not before the given one, at which any load acts on material at rest.
  [[nodiscard]] double next_start(double time) const;

 private:
  std::vector<Load> loads_;
};

}  // namespace whipple::solver
