// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/hugoniostat.hpp"

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(HugoniostatPlan& plan) {
  static const ParameterTable<HugoniostatPlan> table = {real_list(
      "pressure", &HugoniostatPlan::pressure, "Pa", range::positive(), "pressures behind the shock")};
  return with_size(bind(table, plan), plan.size);
}

void check(const HugoniostatPlan& section, const Plan& plan, input::Table& table) {
  if (section.pressure.empty()) table.error_at("pressure", "needs at least one pressure");
  if (!plan.zero_pressure) {
    table.error("[hugoniostat] needs the section [zero_pressure_volume]: it is the state before the shock");
  }
}

}  // namespace whipple::md
