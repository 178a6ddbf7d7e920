// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/target.hpp"

namespace whipple::md {

ParameterTable<Target> Target::parameters(const std::string& unit, const std::string& meaning) {
  return {real("target_error", &Target::error, unit, range::non_negative(),
               meaning + "; a point with a larger one is continued, also one from an earlier call")
              .optional("none"),
          integer("most_steps", &Target::most_steps, {.lower = 0, .upper = 1e12},
                  "averaged steps of one point that are not exceeded for it")
              .optional("20 times steps")};
}

}  // namespace whipple::md
