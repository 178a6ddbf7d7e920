// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/hugoniot.hpp"

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

ParameterTable<HugoniotPlan> HugoniotPlan::parameters() {
  ParameterTable<HugoniotPlan> own = {
      real_list("volume_ratio", &HugoniotPlan::volume_ratio, "", range::open_between(0.1, 1.0),
                "V behind the shock over the volume of the static crystal at zero pressure")};
  return with_run(std::move(own), &HugoniotPlan::size, &HugoniotPlan::target, "",
                  "target standard error of the shock velocity, relative");
}

void HugoniotPlan::check(const Plan& plan, const input::Faults& faults) const {
  if (!plan.zero_pressure) {
    faults.add("", "[hugoniot] needs the section [zero_pressure_volume]: it is the state before the shock");
  }
}

}  // namespace whipple::md
