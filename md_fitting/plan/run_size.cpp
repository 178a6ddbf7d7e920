// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/plan/run_size.hpp"

namespace whipple::md {

std::vector<BoundParameter> keys(RunSize& size) {
  static const ParameterTable<RunSize> table = {
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
  return bind(table, size);
}

std::vector<BoundParameter> with_size(std::vector<BoundParameter> own, RunSize& size) {
  return join_keys(std::move(own), keys(size));
}

std::vector<BoundParameter> join_keys(std::vector<BoundParameter> first,
                                      const std::vector<BoundParameter>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace whipple::md
