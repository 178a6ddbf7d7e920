// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/zero_pressure.hpp"

namespace whipple::md {

ParameterTable<ZeroPressurePlan> ZeroPressurePlan::parameters() {
  ParameterTable<ZeroPressurePlan> own = {
      real_list("temperature", &ZeroPressurePlan::temperature, "K", range::positive(),
                "temperatures at zero pressure; the first is the state before the shock")
          .optional()};
  return with_run(std::move(own), &ZeroPressurePlan::size, &ZeroPressurePlan::target, "",
                  "target relative standard error of the volume");
}

void ZeroPressurePlan::check(const Plan&, const input::Faults& faults) const {
  if (temperature.empty()) faults.add("temperature", "needs at least one temperature");
}

}  // namespace whipple::md
