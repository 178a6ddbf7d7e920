// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/core/base/error.hpp"
#include "src/core/base/random_bits.hpp"
#include "src/solids/bins.hpp"

namespace whipple::solids {
namespace {

constexpr std::int64_t farthest_neighbour = 2;  // spacings
constexpr double margin = 2.5;  // spacings around the box, so that its cells have all neighbours

void require_few(const Vector3& edges, double spacing) {
  constexpr double most = 1e6;
  const double count = (edges / spacing).prod();
  if (count <= most) return;
  throw InputError(fmt::format("{:.2g} cells of {:.3g} m fill the box; at most {:.0e}: enlarge 'cell'", count,
                               spacing, most));
}

Raster raster_of(const std::vector<Vector3>& seeds, double spacing) {
  Vector3 lower = seeds.front(), upper = lower;
  for (const Vector3& x : seeds) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  return {lower, upper, spacing};
}

}  // namespace

Cells::Cells(std::vector<Vector3> seeds, double spacing)
    : seeds_(std::move(seeds)), raster_(raster_of(seeds_, spacing)) {
  const auto index = [&](const Vector3& x) { return raster_.index(raster_.bin_of(x)); };
  std::vector<std::size_t> order(seeds_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return index(seeds_[i]); });
  std::vector<Vector3> sorted;
  begins_.assign(raster_.size() + 1, 0);
  for (const std::size_t i : order) {
    sorted.push_back(seeds_[i]);
    ++begins_[index(seeds_[i]) + 1];
  }
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  seeds_ = std::move(sorted);
}

template <class F>
void Cells::for_each_near(const Vector3& point, std::int64_t spacings, F&& f) const {
  const std::array<std::int64_t, 3> bin = raster_.bin_of(point);
  // The bins along z lie next to each other.
  const std::int64_t from = std::max<std::int64_t>(0, bin[2] - spacings),
                     to = std::min(raster_.count[2] - 1, bin[2] + spacings);
  for (std::int64_t i = std::max<std::int64_t>(0, bin[0] - spacings);
       i <= std::min(raster_.count[0] - 1, bin[0] + spacings); ++i) {
    for (std::int64_t j = std::max<std::int64_t>(0, bin[1] - spacings);
         j <= std::min(raster_.count[1] - 1, bin[1] + spacings); ++j) {
      for (std::size_t s = begins_[raster_.index({i, j, from})]; s < begins_[raster_.index({i, j, to}) + 1];
           ++s) {
        f(s);
      }
    }
  }
}

// A face of x's cell lies (|x - s|^2 - |x - o|^2)/(2 |s - o|) >= (|x - s| - |x - o|)/2 from x, where o is the seed of the
// cell, and |x - o| is at most the distance of the nearest seed of another point plus that of the two points.
std::size_t Cells::near(const Vector3& point, double radius, double reach) const {
  double least = std::numeric_limits<double>::infinity();
  for_each_near(point, farthest_neighbour,
                [&](std::size_t s) { least = std::min(least, (seeds_[s] - point).squaredNorm()); });
  const double farthest = std::sqrt(least) + 2.0 * (radius + reach);
  if (farthest > static_cast<double>(farthest_neighbour) * raster_.edge)
    return seeds_.size();  // more than what is visited
  std::size_t count = 0;
  for_each_near(point, farthest_neighbour, [&](std::size_t s) {
    count += (seeds_[s] - point).squaredNorm() <= farthest * farthest ? 1 : 0;
  });
  return count;
}

Cells::Distances Cells::distances_by(const Vector3& point, std::int64_t spacings, double& matters) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double least = infinity;
  std::size_t own = 0;
  for_each_near(point, spacings, [&](std::size_t s) {
    const double square = (seeds_[s] - point).squaredNorm();
    if (square < least) {
      least = square;
      own = s;
    }
  });
  Distances distances{infinity, infinity};
  for_each_near(point, spacings, [&](std::size_t s) {
    if (s == own) return;
    const double square = (seeds_[s] - point).squaredNorm();
    // A face is no nearer than half of the difference of the two distances.
    if (const double reach = std::sqrt(least) + 2.0 * distances.second; square > reach * reach) return;
    const double face = (square - least) / (2.0 * (seeds_[s] - seeds_[own]).norm());
    if (face < distances.face) {
      distances = {face, distances.face};
    } else if (face < distances.second) {
      distances.second = face;
    }
  });
  matters = std::sqrt(least) + 2.0 * distances.second;
  return distances;
}

Cells::Distances Cells::distances(const Vector3& point) const {
  double matters = 0.0;
  const Distances distances = distances_by(point, 1, matters);
  return matters <= raster_.edge ? distances : distances_by(point, farthest_neighbour, matters);
}

std::vector<Vector3> kelvin_seeds(const Vector3& lower, const Vector3& upper, double spacing) {
  require_few(upper - lower + Vector3::Constant(2.0 * margin * spacing), spacing);
  const double edge = std::cbrt(2.0) * spacing;  // of the cube that holds two cells
  const auto extra = static_cast<std::int64_t>(std::ceil(margin));
  std::array<std::int64_t, 3> count{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    count[a] = static_cast<std::int64_t>(std::ceil((upper[axis] - lower[axis]) / edge)) + extra;
  }
  std::vector<Vector3> seeds;
  for (std::int64_t i = -extra; i <= count[0]; ++i) {
    for (std::int64_t j = -extra; j <= count[1]; ++j) {
      for (std::int64_t k = -extra; k <= count[2]; ++k) {
        const Vector3 corner(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        seeds.push_back(lower + edge * corner);
        seeds.push_back(lower + edge * (corner + Vector3::Constant(0.5)));
      }
    }
  }
  return seeds;
}

std::vector<Vector3> random_seeds(const Vector3& lower, const Vector3& upper, double spacing,
                                  std::uint64_t seed) {
  const Vector3 corner = lower - Vector3::Constant(margin * spacing);
  const Vector3 edges = upper - lower + Vector3::Constant(2.0 * margin * spacing);
  require_few(edges, spacing);
  constexpr double least_distance =
      0.7;  // spacings: 0.18 of the volume in spheres, far from the limit of 0.38
  const auto wanted = static_cast<std::size_t>(std::lround((edges / spacing).prod()));
  Bins bins(corner, corner + edges, spacing);
  std::vector<Vector3> seeds;
  for (std::uint64_t number = 0; seeds.size() < wanted; number += 3) {
    const Vector3 part(uniform(seed, number), uniform(seed, number + 1), uniform(seed, number + 2));
    const Vector3 x = corner + part.cwiseProduct(edges);
    const double square = least_distance * least_distance * spacing * spacing;
    const bool is_free =
        bins.none_near(x, [&](std::uint32_t s) { return (seeds[s] - x).squaredNorm() < square; });
    if (!is_free) continue;
    bins.add(x, static_cast<std::uint32_t>(seeds.size()));
    seeds.push_back(x);
  }
  return seeds;
}

}  // namespace whipple::solids
