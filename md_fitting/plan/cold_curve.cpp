// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/cold_curve.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(ColdCurvePlan& plan) {
  static const ParameterTable<ColdCurvePlan> table = {
      real_list("volume_ratio", &ColdCurvePlan::volume_ratio, "", range::open_between(0.1, 3.0),
                "V over the volume of the static crystal at zero pressure; above 1: tension")};
  return bind(table, plan);
}

}  // namespace whipple::md
