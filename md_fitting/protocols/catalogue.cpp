// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/catalogue.hpp"

#include <array>

namespace whipple::md {

std::span<const Protocol> protocols() {
  static constexpr std::array all = {
      Protocol{"zero_pressure_volume", 4, add_zero_pressure},
      Protocol{"lattice", 1, add_lattice},
      Protocol{"coexistence", 4, add_coexistence},
      Protocol{"isotherm", 4, add_isotherms},
      Protocol{"isochore", 4, add_isochores},
      Protocol{"hugoniot", 4, add_hugoniot},
      Protocol{"cold_curve", 1, add_cold_curve},
      Protocol{"elastic", 1, add_elastic},
      Protocol{"quantum", 1, add_quantum},
      Protocol{"hugoniostat", 3, add_hugoniostat},
      Protocol{"liquid", 2, add_liquid},
      Protocol{"piston", 1, add_piston},
      Protocol{"spall", 2, add_spall},
      Protocol{"liquid_vapour", 3, add_liquid_vapour},
      Protocol{"fluid", 1, add_fluid},
  };
  return all;
}

std::vector<Task> make_tasks(const Plan& plan, const Potential& potential) {
  TaskList list(plan, potential);
  for (const Protocol& protocol : protocols()) {
    list.begin_protocol(protocol.name, protocol.revision);
    protocol.add(plan, list);
  }
  return list.take();
}

}  // namespace whipple::md
