// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/failure_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/case/case.hpp"
#include "src/core/base/random_bits.hpp"

namespace whipple::cases {

ParameterTable<FailureGrains> FailureGrains::parameters() {
  using G = FailureGrains;
  return {real("size", &G::size, "m", range::positive(),
               "edge of a cube (square in two dimensions) of the mean volume of a grain"),
          real("strength", &G::strength, "", range::between(1.0, 1e6),
               "factor of the failure thresholds within a grain, more than half a cell from its faces")
              .optional(),
          integer("seed", &G::seed, range::between(0, 1e18), "seed of the grains").optional()};
}

void FailureGrains::check(const Case& setup, const Faults& faults) const {
  const double cell = setup.domain.cell_size;
  if (!given() || !(size < cell)) return;
  faults.add("size",
             fmt::format("'size' is {:.3g} of a cell ({:.3g} mm): expected at least one, as all of a smaller "
                         "grain lies at its faces",
                         size / cell, 1e3 * cell));
}

bool FailureGrains::given() const { return std::isfinite(size); }

double FailureGrains::factor(const Vector3& place, double cell_size, bool planar) const {
  const Vector3 x = place / size;
  const std::array<int, 3> reach = {2, 2, planar ? 0 : 2};
  std::array<std::int64_t, 3> cube{};
  for (std::size_t a = 0; a < 3; ++a) cube[a] = static_cast<std::int64_t>(std::floor(x[static_cast<int>(a)]));
  // The nearest seed is within two cubes, as the seed of the containing cube is at most 1.73 edges away; the seeds that
  // bound the nearest face are too, except for very unlikely arrangements.
  std::array<Vector3, 125> seeds;
  std::size_t count = 0, nearest = 0;
  for (int i = -reach[0]; i <= reach[0]; ++i) {
    for (int j = -reach[1]; j <= reach[1]; ++j) {
      for (int k = -reach[2]; k <= reach[2]; ++k) {
        std::uint64_t key = static_cast<std::uint64_t>(seed);
        Vector3& s = seeds[count];
        const std::array<std::int64_t, 3> at = {cube[0] + i, cube[1] + j, planar ? 0 : cube[2] + k};
        for (const std::int64_t c : at) key = random_bits(key, static_cast<std::uint64_t>(c));
        for (std::size_t a = 0; a < 3; ++a) {
          s[static_cast<int>(a)] = static_cast<double>(at[a]) + uniform(key, a);
        }
        if (planar) s[2] = x[2];
        if ((s - x).squaredNorm() < (seeds[nearest] - x).squaredNorm()) nearest = count;
        ++count;
      }
    }
  }
  double to_face = std::numeric_limits<double>::infinity();  // in edges
  for (std::size_t n = 0; n < count; ++n) {
    if (n == nearest) continue;
    const Vector3 between = seeds[n] - seeds[nearest];
    const Vector3 middle = 0.5 * (seeds[n] + seeds[nearest]);
    to_face = std::min(to_face, (middle - x).dot(between) / between.norm());
  }
  return to_face * size < 0.5 * cell_size ? 1.0 : strength;
}

}  // namespace whipple::cases
