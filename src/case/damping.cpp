// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/damping.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Damping> Damping::parameters() {
  using D = Damping;
  return with_part(
      ParameterTable<D>{real("coefficient", &D::coefficient, "",
                             Range{.lower = 0.0, .upper = 1.0, .upper_open = true},
                             "part of the force on each node that acts against its motion, times the factor; "
                             "0.3 to 0.8 to reach a state of rest; 0: none")
                            .optional()},
      &D::table, TimeTable::parameters());
}

void Damping::check(const Case& setup, const Faults& faults) const {
  table.check(faults);
  if (!table.is_default() && coefficient == 0.0) {
    faults.add("times", "'times' and 'factors' are those of 'coefficient', which is missing or zero");
  }
  for (const double factor : table.factors) {
    if (factor >= 0.0 && coefficient * factor < 1.0) continue;
    faults.add("factors",
               fmt::format("'coefficient' times its factor is {:.6g}: expected 0 or more, and less than 1",
                           coefficient * factor));
    break;
  }
  if (coefficient > 0.0 && setup.transfer.free_flight) {
    faults.add("coefficient", "'coefficient': particles of transfer.free_flight would not be damped");
  }
}

}  // namespace whipple::cases
