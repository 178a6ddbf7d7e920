// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

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
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = i + 2; j < corners.size(); ++j) {
        if (i == 0 && j + 1 == corners.size()) continue;  // neighbours
        if (!do_cross(corners[i], next(i), corners[j], next(j))) continue;
        return fmt::format("the edges from corner {} to {} and from corner {} to {} cross", i + 1, i + 2,
                           j + 1, (j + 1) % corners.size() + 1);
      }
    }
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
    for (std::size_t i = 0; i < corners.size(); ++i) f(corners[i], next(i));
  }

 private:
  using Point = std::array<double, 2>;
  [[nodiscard]] const Point& next(std::size_t i) const { return corners[(i + 1) % corners.size()]; }
  /// Returns twice the area of a triangle, positive counter-clockwise.
  static double side(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  /// Returns whether each of two edges has the ends of the other one on different sides: those that touch do not cross.
  static bool do_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto apart = [](double x, double y) { return (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0); };
    return apart(side(a, b, c), side(a, b, d)) && apart(side(c, d, a), side(c, d, b));
  }
  /// Sums f over the triangles of the origin with every edge, weighted by their areas.
  template <class Function>
  [[nodiscard]] double moment(Function&& f) const {
    double sum = 0.0;
    for_each_edge([&](const auto& a, const auto& b) { sum += 0.5 * (a[0] * b[1] - b[0] * a[1]) * f(a, b); });
    return sum;
  }
};

}  // namespace whipple::cases
