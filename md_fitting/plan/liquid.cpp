// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/liquid.hpp"

namespace whipple::md {

ParameterTable<LiquidPlan> LiquidPlan::parameters() {
  ParameterTable<LiquidPlan> own = {
      real_list("temperature", &LiquidPlan::temperature, "K", range::positive(), "temperatures of the melt"),
      real_list("pressure", &LiquidPlan::pressure, "Pa", range::non_negative(),
                "pressures; every temperature is combined with every pressure")
          .optional()};
  return with_run(std::move(own), &LiquidPlan::size, &LiquidPlan::target, "",
                  "target relative standard error of the volume");
}

void LiquidPlan::check(const Plan&, const input::Faults& faults) const {
  if (temperature.empty()) faults.add("temperature", "needs at least one temperature");
  if (pressure.empty()) faults.add("pressure", "needs at least one pressure");
}

}  // namespace whipple::md
