// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/isotherm.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(IsothermPlan& plan) {
  static const ParameterTable<IsothermPlan> table = {
      real("temperature", &IsothermPlan::temperature, "K", range::positive(), "temperature of the isotherm")
          .optional(),
      real_list("volume_ratio", &IsothermPlan::volume_ratio, "", range::open_between(0.1, 3.0),
                "V over the volume of the static crystal at zero pressure")};
  return join_keys(with_size(bind(table, plan), plan.size),
                   keys(plan.target, "Pa", "wanted standard error of the pressure"));
}

}  // namespace whipple::md
