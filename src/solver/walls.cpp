// SPDX-License-Identifier: BSD-3-Clause
// Material at mirror planes and walls: one with its image, or in contact with it (docs/theory/mpm.md, section
// 3).
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "src/case/build/seeding.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

/// A velocity field is one with its image where one of its bodies touches the plane at the start.
void Simulation::set_up_walls() {
  const std::vector<std::uint8_t> touched = cases::faces_touched(setup_);
  std::vector<std::uint8_t> field_of_body = contact_field_of_body_;
  field_of_body.resize(touched.size(), 0);  // one field without contact of bodies
  const unsigned fields = *std::ranges::max_element(field_of_body) + 1U;
  // What no body has is bonded as well: then nothing has to be looked for.
  const std::uint64_t unused = fields >= grid::maximum_fields ? 0 : ~((std::uint64_t{1} << fields) - 1);
  std::array<std::uint64_t, 6> bonded{};
  bonded.fill(unused);
  for (std::size_t b = 0; b < touched.size(); ++b) {
    for (std::size_t face = 0; face < 6; ++face) {
      if ((touched[b] >> face & 1U) != 0) bonded[face] |= std::uint64_t{1} << field_of_body[b];
    }
  }
  grid_.bond_at_planes(bonded);
  first_touches_ = std::make_unique<transfer::FirstTouches>(fields);
  grid_update_.mirror_contact().watch(*first_touches_);
}

bool Simulation::is_one_with_image(std::size_t body, std::size_t face) const {
  return grid_.is_bonded_at(face, contact_field_of_body_.empty() ? 0U : contact_field_of_body_[body]);
}

/// Returns whether there is material that may meet its image as another body.
bool Simulation::may_meet_images() const {
  for (std::size_t face = 0; face < 6; ++face) {
    if (grid_.is_apart_at(face)) return true;
  }
  return false;
}

void Simulation::find_surfaces_at_walls() {
  if (!may_meet_images()) return;
  profile_.time("walls", [&] {
    grid_update_.mirror_contact().find_surfaces(shape_, particles_, transition_.position, grid_,
                                                state_.time_step);
  });
}

}  // namespace whipple::solver
