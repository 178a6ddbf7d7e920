// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/hugoniot.hpp"

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(HugoniotPlan& plan) {
  static const ParameterTable<HugoniotPlan> table = {
      real_list("volume_ratio", &HugoniotPlan::volume_ratio, "", range::open_between(0.1, 1.0),
                "V behind the shock over the volume of the static crystal at zero pressure")};
  return join_keys(with_size(bind(table, plan), plan.size),
                   keys(plan.target, "", "wanted standard error of the shock velocity, relative"));
}

void check(const HugoniotPlan&, const Plan& plan, input::Table& table) {
  if (!plan.zero_pressure) {
    table.error("[hugoniot] needs the section [zero_pressure_volume]: it is the state before the shock");
  }
}

}  // namespace whipple::md
