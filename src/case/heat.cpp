// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/heat.hpp"

#include <fmt/format.h>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<HeatControl> HeatControl::parameters() {
  return {boolean("conduction", &HeatControl::conduction,
                  "heat conduction between particles with the conductivities of their materials ([thermal])")
              .optional()};
}

void HeatControl::check(const Case& setup, const Faults& faults) const {
  if (!conduction) return;
  if (setup.transfer.shape_function == transfer::ShapeFunction::linear) {
    faults.add("conduction",
               "'conduction' needs smooth shape functions; transfer.shape_function is \"linear\"");
  }
  bool conducts = false;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Material* material = setup.materials[b].get();
    if (material == nullptr || !(material->conductivity > 0.0)) continue;
    conducts = true;
    if (!(material->reference.heat_capacity > 0.0)) {
      faults.add("conduction", fmt::format("'conduction': the equation of state of body \"{}\" has no "
                                           "temperature",
                                           setup.bodies[b].name));
    }
  }
  if (!conducts) {
    faults.add("conduction", "'conduction' is on, but no material has a conductivity ([thermal])");
  }
}

}  // namespace whipple::cases
