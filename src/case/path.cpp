// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/path.hpp"

#include <algorithm>
#include <cmath>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Path> Path::parameters() {
  return with_part(ParameterTable<Path>{}, &Path::table, TimeTable::parameters());
}

void Path::check(const Case&, const Faults& faults) const { table.check(faults); }

double Path::largest() const {
  double most = 0.0;
  for (const double factor : table.factors) most = std::max(most, std::abs(factor));
  return most;
}

}  // namespace whipple::cases
