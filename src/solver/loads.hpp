// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "src/case/gravity.hpp"
#include "src/core/base/tensor.hpp"

namespace whipple::solver {

/// Points that a load acts on: particles, or the nodes of elements.
struct LoadedPoints {
  std::span<const std::uint64_t> id;
  std::span<const Vector3> position;  ///< m
  std::span<const Vector3> velocity;  ///< m/s
};

/// An acceleration by external forces.
struct Load {
  std::string name;
  /// Adds the accelerations (m/s^2) of points at a time (s) to what is there; asked once per step and set of points.
  std::function<void(const LoadedPoints& points, double time, std::span<Vector3> acceleration)> add;
  /// Returns the first time (s), from the given one on, at which the load acts; infinite if it never does again.
  std::function<double(double time)> next_event = [](double time) { return time; };
};

/// Returns a load of one acceleration (m/s^2) of a time (s) for all points.
/// @param begin  s, from which on it acts
Load uniform_load(std::string name, std::function<Vector3(double time)> acceleration,
                  double begin = -std::numeric_limits<double>::infinity());

/// Returns gravity as the case asks for it.
Load gravity(const cases::Gravity& gravity);

/// List of all loads; they add up, on particles and on the nodes of elements alike.
class Loads {
 public:
  void add(Load load) { loads_.push_back(std::move(load)); }

  /// Sums the accelerations (m/s^2) of points at a time (s).
  /// @param acceleration  one of each point; empty if no load acts at this time
  void evaluate(const LoadedPoints& points, double time, std::vector<Vector3>& acceleration) const;

  /// Returns the first time (s), from the given one on, at which some load acts; infinite if none does again.
  [[nodiscard]] double next_event(double time) const;

 private:
  std::vector<Load> loads_;
};

}  // namespace whipple::solver
