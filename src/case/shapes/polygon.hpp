// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace whipple::cases {

/// Describes a polygon in a plane by its corners, in either sense of rotation.
struct Polygon {
  std::vector<std::array<double, 2>> corners;  ///< m

  /// Takes the corners from their two lists of coordinates.
  /// @returns why they are none, or an empty text
  std::string set(const std::vector<double>& first, const std::vector<double>& second) {
    if (first.size() != second.size()) return "the lists of coordinates differ in length";
    if (first.size() < 3) return "a polygon has at least three corners";
    corners.clear();
    for (std::size_t i = 0; i < first.size(); ++i) corners.push_back({first[i], second[i]});
    return area() > 0.0 ? std::string() : std::string("the polygon has no area");
  }

  /// Returns whether a ray from the point crosses the boundary an odd number of times.
  [[nodiscard]] bool contains(double x, double y) const {
    bool inside = false;
    for_each_edge([&](const auto& a, const auto& b) {
      if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1])) inside = !inside;
    });
    return inside;
  }
  [[nodiscard]] double area() const {
    return std::abs(moment([](const auto&, const auto&) { return 1.0; }));
  }
  /// Returns the integral of the first coordinate over the polygon, m^3.
  [[nodiscard]] double first_moment() const {
    return std::abs(moment([](const auto& a, const auto& b) { return (a[0] + b[0]) / 3.0; }));
  }

  /// Calls f(from, to) for every edge.
  template <class Function>
  void for_each_edge(Function&& f) const {
    for (std::size_t i = 0; i < corners.size(); ++i) f(corners[i], corners[(i + 1) % corners.size()]);
  }

 private:
  /// Sums f over the triangles of the origin with every edge, weighted by their areas.
  template <class Function>
  [[nodiscard]] double moment(Function&& f) const {
    double sum = 0.0;
    for_each_edge([&](const auto& a, const auto& b) { sum += 0.5 * (a[0] * b[1] - b[0] * a[1]) * f(a, b); });
    return sum;
  }
};

}  // namespace whipple::cases
