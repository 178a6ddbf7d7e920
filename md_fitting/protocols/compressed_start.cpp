// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/compressed_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "md_fitting/lammps/units.hpp"
#include "md_fitting/protocols/crystal.hpp"
#include "src/core/base/error.hpp"

namespace whipple::md {

CompressedStart compressed_start(const Potential& potential, double pressure) {
  constexpr std::int64_t cells = 3;
  constexpr double small = 0.97;       // relative length that a barostat can change safely
  constexpr double resolution = 1e-5;  // of the length
  const double a0 = potential.lattice_constant();
  const CompressedStart uncompressed{a0, 1.0};
  if (!(pressure > 0.0)) return uncompressed;
  Crystal crystal(potential, a0, cells, cells, cells);
  const auto reaches = [&](double length) {
    crystal.rescale(length * a0);
    crystal.evaluate();
    return crystal.lammps().variable("virial") * metal::bar > pressure;
  };
  if (reaches(small)) return uncompressed;
  // Below its smallest volume a potential extrapolates or fails.
  const double least_ratio = std::max(0.4, potential.least_volume_ratio());
  double low = std::cbrt(least_ratio);
  double high = small;
  if (!(low < high) || !reaches(low)) {
    throw StateError(fmt::format("the static crystal of {} does not reach {:.4g} GPa at V/V0 = {:.3f}",
                                 potential.name(), 1e-9 * pressure, least_ratio));
  }
  while (high - low > resolution) {
    const double middle = 0.5 * (low + high);
    (reaches(middle) ? low : high) = middle;
  }
  return {high * a0, std::pow(high, 3)};
}

}  // namespace whipple::md
