// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace whipple::transfer {

/// Sums over particles of what a transfer to them did.
struct TransferBalance {
  double work = 0.0;            ///< J, of the stress on the strain of the mean grid velocity
  double viscous_work = 0.0;    ///< J, part of it: of the artificial viscosity
  double heat = 0.0;            ///< J, kinetic energy lost in the transfer that became heat at once, >= 0
  double kept = 0.0;            ///< J, the rest of the loss, now unresolved energy, >= 0
  double returned = 0.0;        ///< J, unresolved energy that became heat, >= 0
  double external_work = 0.0;   ///< J, of the external acceleration, on the mean grid velocity
  double squared_change = 0.0;  ///< m^2/s^2, the largest of any particle's velocity; no sum
  TransferBalance& operator+=(const TransferBalance& other) {
    work += other.work;
    viscous_work += other.viscous_work;
    heat += other.heat;
    kept += other.kept;
    returned += other.returned;
    external_work += other.external_work;
    squared_change = std::max(squared_change, other.squared_change);
    return *this;
  }
};

}  // namespace whipple::transfer
