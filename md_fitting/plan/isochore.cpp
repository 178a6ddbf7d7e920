// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/isochore.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(IsochorePlan& plan) {
  static const ParameterTable<IsochorePlan> table = {
      real("volume_ratio", &IsochorePlan::volume_ratio, "", range::open_between(0.1, 3.0),
           "V over the volume of the static crystal at zero pressure"),
      real_list("temperature", &IsochorePlan::temperature, "K", range::positive(),
                "temperatures along the isochore")};
  return join_keys(with_size(bind(table, plan), plan.size),
                   keys(plan.target, "Pa", "wanted standard error of the pressure"));
}

}  // namespace whipple::md
