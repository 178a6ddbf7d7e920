// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "md_fitting/plan/plan.hpp"

namespace whipple::md {

ParameterTable<AdaptivePlan> AdaptivePlan::parameters() {
  return {choice("outcome", &AdaptivePlan::outcome, {adaptive_outcomes.begin(), adaptive_outcomes.end()},
                 "result of the fitted equation of state whose error is to fall"),
          real("volume_ratio", &AdaptivePlan::volume_ratio, "", range::open_between(0.1, 1.0),
               "V/V0 behind the shock, of hugoniot_pressure and hugoniot_temperature")
              .optional("none"),
          real("pressure", &AdaptivePlan::pressure, "Pa", range::non_negative(),
               "after release, or of the melting temperature")
              .optional(),
          real("target_error", &AdaptivePlan::target_error, "", range::non_negative(),
               "relative error of the outcome at which the work ends")
              .optional("none"),
          real("budget", &AdaptivePlan::budget, "", range::non_negative(),
               "atoms times steps of all points of the store that are not exceeded")
              .optional("none"),
          integer("candidates", &AdaptivePlan::candidates, {.lower = 3, .upper = 100},
                  "equidistant values to choose from along each range of the plan")
              .optional(),
          boolean("model_errors", &AdaptivePlan::model_errors,
                  "the error includes that of the fitted laws, not the noise alone")
              .optional()};
}

void AdaptivePlan::check(const Plan& plan, const input::Faults& faults) const {
  std::set<double> volumes;
  bool sharpened = plan.zero_pressure && plan.zero_pressure->target.error > 0.0;
  for (const IsochorePlan& isochore : plan.isochores) {
    if (isochore.temperature.size() >= 2) volumes.insert(isochore.volume_ratio);
    sharpened = sharpened || isochore.target.error > 0.0;
  }
  if (!plan.zero_pressure || !plan.hugoniot || plan.hugoniot->volume_ratio.size() < 3 || volumes.size() < 2) {
    faults.add(
        "",
        "[adaptive] chooses within the ranges of [zero_pressure_volume], [hugoniot] (three volumes or more) "
        "and [[isochore]] (two volumes or more, each with two temperatures or more): they must be there");
  }
  sharpened =
      sharpened || (plan.hugoniot && plan.hugoniot->target.error > 0.0) ||
      std::ranges::any_of(plan.coexistences, [](const auto& section) { return section.target.error > 0.0; });
  if (plan.coexistences.size() > 1) {
    faults.add("", "[adaptive] chooses pressures within one [[coexistence]]: the plan has several");
  }
  if (sharpened) {
    faults.add("",
               "[adaptive] requires the cost of a point in advance: no target_error in the other sections");
  }
  const bool of_hugoniot = outcome.starts_with("hugoniot_");
  const bool given = std::isfinite(volume_ratio);
  if (of_hugoniot && !given) {
    faults.add("", fmt::format("outcome = \"{}\" needs volume_ratio", outcome));
  }
  if (!of_hugoniot && given) {
    faults.add("volume_ratio", fmt::format("does not belong to outcome = \"{}\"", outcome));
  }
  if (target_error == 0.0 && budget == 0.0) {
    faults.add("", "[adaptive] needs target_error or budget, or both: one of them ends the work");
  }
}

}  // namespace whipple::md
