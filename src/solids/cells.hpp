// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/core/base/tensor.hpp"
#include "src/solids/bins.hpp"

namespace whipple::solids {

/// Divides space among seeds: the cell of a seed holds the points nearest to it (Voronoi cells, the bubbles of a foam).
class Cells {
 public:
  /// @param spacing  cube root of the volume per seed, m
  Cells(std::vector<Vector3> seeds, double spacing);

  /// Holds distances from a point, m: to the nearest face between two cells, and to the second nearest one. Near an
  /// edge of a cell, where three meet, both are small.
  struct Distances {
    double face, second;
  };
  [[nodiscard]] Distances distances(const Vector3& point) const;
  /// Counts the seeds that may hold a point within `radius` of this one, or have a face within `reach` of it: of a point
  /// that is nearer than `reach` to n faces there are n + 1.
  [[nodiscard]] std::size_t near(const Vector3& point, double radius, double reach) const;
  [[nodiscard]] std::size_t size() const { return seeds_.size(); }

 private:
  /// Calls f(seed) for the seeds within so many spacings of a point, and some more.
  template <class F>
  void for_each_near(const Vector3& point, std::int64_t spacings, F&& f) const;
  /// Computes the distances from those seeds alone, and that beyond which a seed cannot change them.
  [[nodiscard]] Distances distances_by(const Vector3& point, std::int64_t spacings, double& matters) const;

  std::vector<Vector3> seeds_;  // sorted by bin
  std::vector<std::size_t> begins_;
  Raster raster_;
};

/// Places the seeds of Kelvin's foam, whose cells are truncated octahedra, in a box and around it: a body-centred
/// lattice with the first seed in the lower corner.
/// @param spacing  cube root of the volume of a cell, m
/// @throws InputError if there are more than a million
std::vector<Vector3> kelvin_seeds(const Vector3& lower, const Vector3& upper, double spacing);

/// Places seeds at random in a box and around it, none nearer to another than 0.7 spacings.
/// @throws InputError if there are more than a million
std::vector<Vector3> random_seeds(const Vector3& lower, const Vector3& upper, double spacing,
                                  std::uint64_t seed);

}  // namespace whipple::solids
