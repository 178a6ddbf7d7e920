// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<QuasiStatic> QuasiStatic::parameters() {
  return {integer("steps", &QuasiStatic::steps, range::between(1, 1e6),
                  "number of load steps from the start to time.end, while none of them is cut")
              .optional(),
          real("least_step", &QuasiStatic::least_step, "", range::between(1e-9, 1.0),
               "part of time.end below which a load step that does not converge is not halved again: the "
               "run ends at its limit load")
              .optional(),
          real("tolerance", &QuasiStatic::tolerance, "", range::between(1e-13, 1e-2),
               "largest imbalance of the nodes, as a part of the forces on them")
              .optional(),
          integer("iterations", &QuasiStatic::iterations, range::between(1, 1000),
                  "most iterations of Newton's method in a load step; it is halved if they do not suffice")
              .optional(),
          choice("grid", &QuasiStatic::grid,
                 "undeformed in every load step | that of the start: finite elements with particles as "
                 "integration points")
              .optional(),
          real("border_stiffness", &QuasiStatic::border_stiffness, "", range::between(0.0, 1.0),
               "stiffness of the cells at the border of the material against displacements of a load step, "
               "as a part of that of the material: holds nodes of small support")
              .optional()};
}

namespace {

constexpr std::string_view scheme = "time.scheme = \"quasi_static\"";

bool moves_at_start(const Body& body) {
  return !body.driven &&
         !(body.velocity.isZero(0.0) && body.angular_velocity.isZero(0.0) && body.expansion_rate.isZero(0.0));
}

void check_body(const Case& setup, std::size_t b, const Faults& faults) {
  const Body& body = setup.bodies[b];
  if (!body.discretization.has_particles()) {
    faults.add("discretization",
               fmt::format("{} moves particles only: expected method = \"particles\"", scheme));
  }
  if (moves_at_start(body)) {
    faults.add("velocity", fmt::format("{} has no inertia: expected a body at rest, or driven = true, whose "
                                       "velocity times the load step is its displacement",
                                       scheme));
  }
  if (body.driven && !body.angular_velocity.isZero(0.0)) {
    faults.add("angular_velocity", fmt::format("{} moves driven bodies without rotation", scheme));
  }
  if (body.volumetric == Volumetric::cell) {
    faults.add("volumetric", fmt::format("{} has no means over cells: expected \"point\"", scheme));
  }
  if (setup.materials[b] != nullptr && setup.materials[b]->burns()) {
    faults.add("material", fmt::format("{} has no explosives", scheme));
  }
}

}  // namespace

void check_load_steps(const Case& setup, const Faults& faults) {
  if (has_inertia(setup.time.scheme)) {
    if (setup.quasi_static != QuasiStatic{}) {
      faults.add("quasi_static", "[quasi_static] belongs to time.scheme = \"quasi_static\"");
    }
    return;
  }
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) check_body(setup, b, faults.in("body").in(b));
  if (std::ranges::any_of(setup.domain.boundary.in_order(), grid::lets_part)) {
    faults.in("domain").add("boundary", fmt::format("{} has no walls from which material parts: expected "
                                                    "symmetry, no_slip or outflow",
                                                    scheme));
  }
  if (setup.heat.conduction) {
    faults.in("heat").add("conduction", fmt::format("{} conducts no heat", scheme));
  }
  if (setup.damping.coefficient > 0.0) {
    faults.in("damping").add("coefficient", fmt::format("{} has no velocities to damp", scheme));
  }
  if (setup.transfer.random_shift) {
    faults.in("transfer").add("random_shift", fmt::format("{} has no random grid", scheme));
  }
  if (setup.splitting.of == Divided::all) {
    faults.in("splitting").add("of", fmt::format("{} splits no particles", scheme));
  }
  for (std::size_t i = 0; i < setup.loads.size(); ++i) {
    if (setup.loads[i].is_damping())
      faults.in("load").in(i).add("damping", fmt::format("{} has no velocities to damp", scheme));
  }
}

void check_load_step_fields(const Case& setup, const Faults& faults) {
  if (has_inertia(setup.time.scheme) || !setup.contact_fields.several()) return;
  faults.in("contact").add(
      "method", fmt::format("{} moves all bodies in one field, and these have several: contact.method = "
                            "\"none\" bonds those that touch",
                            scheme));
}

}  // namespace whipple::cases
