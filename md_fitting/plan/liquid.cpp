// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/liquid.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(LiquidPlan& plan) {
  static const ParameterTable<LiquidPlan> table = {
      real_list("temperature", &LiquidPlan::temperature, "K", range::positive(), "temperatures of the melt"),
      real_list("pressure", &LiquidPlan::pressure, "Pa", range::non_negative(),
                "pressures; every temperature is combined with every pressure")
          .optional()};
  return join_keys(with_size(bind(table, plan), plan.size),
                   keys(plan.target, "", "wanted relative standard error of the volume"));
}

void check(const LiquidPlan& section, const Plan&, input::Table& table) {
  if (section.temperature.empty()) table.error_at("temperature", "needs at least one temperature");
  if (section.pressure.empty()) table.error_at("pressure", "needs at least one pressure");
}

}  // namespace whipple::md
