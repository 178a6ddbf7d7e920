// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "src/core/base/tensor.hpp"

namespace whipple::solids {

/// Divides a box into cubes, and what is outside among those at its faces.
struct Raster {
  Raster(const Vector3& lower_corner, const Vector3& upper, double edge_length)
      : lower(lower_corner), edge(edge_length) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      count[a] = 1 + static_cast<std::int64_t>((upper[axis] - lower[axis]) / edge);
    }
  }
  [[nodiscard]] std::array<std::int64_t, 3> bin_of(const Vector3& point) const {
    std::array<std::int64_t, 3> bin{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      bin[a] = std::clamp(static_cast<std::int64_t>(std::floor((point[axis] - lower[axis]) / edge)),
                          std::int64_t{0}, count[a] - 1);
    }
    return bin;
  }
  /// Returns the number of a cube; those along z lie next to each other.
  [[nodiscard]] std::size_t index(const std::array<std::int64_t, 3>& bin) const {
    return static_cast<std::size_t>((bin[0] * count[1] + bin[1]) * count[2] + bin[2]);
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count[0] * count[1] * count[2]); }

  Vector3 lower;
  double edge;
  std::array<std::int64_t, 3> count{};
};

/// Sorts numbered points of a box into cubes, to find those near a place.
class Bins {
 public:
  /// @param edge  of the cubes: the distance up to which points are found
  Bins(const Vector3& lower, const Vector3& upper, double edge)
      : raster_(lower, upper, edge), bins_(raster_.size()) {}
  void add(const Vector3& point, std::uint32_t number) {
    bins_[raster_.index(raster_.bin_of(point))].push_back(number);
  }
  void clear() {
    for (auto& bin : bins_) bin.clear();
  }
  /// Returns whether f(number) is false for all points in the cube of a place and in its neighbours.
  template <class Function>
  [[nodiscard]] bool none_near(const Vector3& point, Function&& f) const {
    const std::array<std::int64_t, 3> at = raster_.bin_of(point);
    std::array<std::int64_t, 3> from{}, to{};
    for (std::size_t a = 0; a < 3; ++a) {
      from[a] = std::max<std::int64_t>(at[a] - 1, 0);
      to[a] = std::min(at[a] + 1, raster_.count[a] - 1);
    }
    for (std::int64_t i = from[0]; i <= to[0]; ++i) {
      for (std::int64_t j = from[1]; j <= to[1]; ++j) {
        for (std::int64_t k = from[2]; k <= to[2]; ++k) {
          if (std::ranges::any_of(bins_[raster_.index({i, j, k})], f)) return false;
        }
      }
    }
    return true;
  }

 private:
  Raster raster_;
  std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace whipple::solids
