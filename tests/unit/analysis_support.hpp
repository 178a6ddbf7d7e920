// SPDX-License-Identifier: BSD-3-Clause
// Made-up particle sets for the tests of measures.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "src/analysis/frame.hpp"
#include "src/analysis/run.hpp"
#include "src/analysis/table.hpp"

namespace whipple::analysis {
inline constexpr double density = 2700.0;
inline constexpr double pi = std::numbers::pi;

/// Particles of one spacing; fields are filled as they are added.
struct Maker {
  Snapshot snapshot;
  double spacing;

  explicit Maker(double distance) : spacing(distance) {
    for (const char* name : {"density", "phase", "temperature", "melted_fraction", "failed"})
      snapshot.scalars[name] = {};
  }
  void add(const Vector3& position, const Vector3& velocity, std::uint16_t body = 0, double phase = 0.0,
           double temperature = 300.0) {
    snapshot.id.push_back(snapshot.id.size());
    snapshot.position.push_back(position);
    snapshot.velocity.push_back(velocity);
    snapshot.mass.push_back(density * spacing * spacing * spacing);
    snapshot.body.push_back(body);
    snapshot.scalars["density"].push_back(density);
    snapshot.scalars["phase"].push_back(phase);
    snapshot.scalars["temperature"].push_back(temperature);
    snapshot.scalars["melted_fraction"].push_back(phase > 0.0 ? 1.0 : 0.0);
    snapshot.scalars["failed"].push_back(0.0);
  }
  /// All lattice points (i + 1/2) spacing inside.
  void fill(const Vector3& lower, const Vector3& upper, const std::function<bool(const Vector3&)>& inside,
            const Vector3& velocity, std::uint16_t body = 0, double phase = 0.0) {
    const auto first = [&](double x) { return static_cast<long>(std::floor(x / spacing)); };
    for (long i = first(lower.x()); i <= first(upper.x()); ++i) {
      for (long j = first(lower.y()); j <= first(upper.y()); ++j) {
        for (long k = first(lower.z()); k <= first(upper.z()); ++k) {
          const Vector3 p =
              spacing * (Vector3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) +
                         Vector3::Constant(0.5));
          if ((p.array() < lower.array()).any() || (p.array() > upper.array()).any() || !inside(p)) continue;
          add(p, velocity, body, phase);
        }
      }
    }
  }
};

/// A quarter model that flies up along z.
inline Frame quarter(double impact_speed = 6000.0) {
  Frame frame;
  frame.planes = frame.cuts = {{0, 0.0}, {1, 0.0}};
  frame.impact_speed = impact_speed;
  return frame;
}

inline double value(const Quantities& row, const std::string& name) {
  const auto found = std::ranges::find(row, name, &Quantity::name);
  if (found == row.end()) ADD_FAILURE() << "no quantity " << name;
  return found == row.end() ? 0.0 : found->value;
}

}  // namespace whipple::analysis
