// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/gravity.hpp"

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Gravity> Gravity::parameters() {
  return with_part(
      ParameterTable<Gravity>{
          vector("acceleration", &Gravity::acceleration, "m/s^2", range::any(),
                 "acceleration of all material")
              .optional(),
          real("rise_time", &Gravity::rise_time, "s", range::non_negative(),
               "time over which it increases from 0, so that bodies at rest do not begin to vibrate")
              .optional()},
      &Gravity::table, TimeTable::parameters());
}

void Gravity::check(const Case& setup, const Faults& faults) const {
  if (!acceleration.isZero(0.0) && setup.transfer.free_flight) {
    faults.add("acceleration", "'acceleration': particles of transfer.free_flight would not fall");
  }
  table.check(faults);
  if (table.is_default()) return;
  if (rise_time > 0.0) {
    faults.add("rise_time",
               "gravity increases with 'rise_time' or by the table of 'times' and 'factors', not both");
  }
  if (acceleration.isZero(0.0)) {
    faults.add("times", "'times' and 'factors' are those of 'acceleration', which is missing or zero");
  }
}

}  // namespace whipple::cases
