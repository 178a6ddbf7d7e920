// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/hugoniostat.hpp"

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

ParameterTable<HugoniostatPlan> HugoniostatPlan::parameters() {
  ParameterTable<HugoniostatPlan> own = {real_list("pressure", &HugoniostatPlan::pressure, "Pa",
                                                   range::positive(), "pressures behind the shock")};
  return with_part(std::move(own), &HugoniostatPlan::size, RunSize::parameters());
}

void HugoniostatPlan::check(const Plan& plan, const input::Faults& faults) const {
  if (pressure.empty()) faults.add("pressure", "needs at least one pressure");
  if (!plan.zero_pressure) {
    faults.add("",
               "[hugoniostat] needs the section [zero_pressure_volume]: it is the state before the shock");
  }
}

}  // namespace whipple::md
