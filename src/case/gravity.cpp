// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/gravity.hpp"

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Gravity> Gravity::parameters() {
  return {
      vector("acceleration", &Gravity::acceleration, "m/s^2", range::any(), "acceleration of all material")
          .optional(),
      real("rise_time", &Gravity::rise_time, "s", range::non_negative(),
           "time over which it increases from 0, so that bodies at rest do not begin to vibrate")
          .optional()};
}

void Gravity::check(const Case& setup, const Faults& faults) const {
  if (!acceleration.isZero(0.0) && setup.transfer.free_flight) {
    faults.add("acceleration", "'acceleration': particles of transfer.free_flight would not fall");
  }
}

}  // namespace whipple::cases
