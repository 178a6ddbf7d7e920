// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages.hpp"

#include <algorithm>
#include <utility>

namespace whipple::solver {

Stages::Stages(const cases::Case& setup, MPI_Comm communicator, const RunState& run,
               std::vector<fem::Mesh> meshes, std::vector<fem::Bars> bars)
    : state(setup, communicator, run),
      particles(state),
      hexahedra(state, loads, std::move(meshes)),
      trusses(state, loads, std::move(bars)),
      applied_loads(state, carriers),
      activity(state, loads),
      material(state, activity),
      transfers(state, loads, activity),
      contact(state, hexahedra, transfers.grid_update()),
      time_step(state, carriers, particles),
      partition(state, carriers, particles, activity),
      elements(state, carriers, particles, hexahedra, partition),
      fill(state),
      load_step(state, loads, applied_loads, partition),
      balance(state, carriers),
      plausibility(state, carriers) {
  carriers.push_back(&particles);
  for (Carrier* carrier : {static_cast<Carrier*>(&hexahedra), static_cast<Carrier*>(&trusses)}) {
    if (!carrier->empty()) carriers.push_back(carrier);
  }
  applied_loads.add_to(loads);
  // The force on driven bodies is computed from all others (Drive); registered as a load, it prevents inactive blocks.
  if (std::ranges::any_of(setup.bodies, &cases::Body::driven))
    loads.add(uniform_load("drive", [](double) { return Vector3(Vector3::Zero()); }));
}

}  // namespace whipple::solver
