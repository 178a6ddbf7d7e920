// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/run_size.hpp"

namespace whipple::md {

ParameterTable<RunSize> RunSize::parameters() {
  return {
      integer("cells", &RunSize::cells, {.lower = 2, .upper = 100}, "unit cells along each edge of the cube")
          .optional(),
      integer("equilibration_steps", &RunSize::equilibration_steps, {.lower = 100, .upper = 1e9},
              "time steps before averaging")
          .optional(),
      integer("steps", &RunSize::steps, {.lower = 200, .upper = 1e9}, "time steps that are averaged")
          .optional(),
      real("time_step", &RunSize::time_step, "s", range::between(0.0, 1e-13),
           "0: 2 fs for the mass of copper, less when hot or compressed")
          .optional()};
}

}  // namespace whipple::md
