// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/zero_pressure.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(ZeroPressurePlan& plan) {
  static const ParameterTable<ZeroPressurePlan> table = {
      real_list("temperature", &ZeroPressurePlan::temperature, "K", range::positive(),
                "temperatures at zero pressure; the first is the state before the shock")
          .optional()};
  return join_keys(with_size(bind(table, plan), plan.size),
                   keys(plan.target, "", "wanted relative standard error of the volume"));
}

void check(const ZeroPressurePlan& section, const Plan&, input::Table& table) {
  if (section.temperature.empty()) table.error_at("temperature", "needs at least one temperature");
}

}  // namespace whipple::md
