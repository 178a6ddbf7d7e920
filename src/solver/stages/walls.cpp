// SPDX-License-Identifier: BSD-3-Clause
// Contact with images at mirror planes and walls.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "src/case/build/placement.hpp"
#include "src/solver/stages/contact.hpp"

namespace whipple::solver {

/// Sets the continuity of velocity fields with their images: a field is continuous at a plane if one of its bodies
/// touches it at the start.
void ContactStage::set_up_walls() {
  const std::vector<std::uint8_t> touched = cases::faces_touched(state_.setup);
  std::vector<std::uint8_t> field_of_body = field_of_body_;
  field_of_body.resize(touched.size(), 0);  // one field without contact of bodies
  const unsigned fields = state_.setup.contact_fields.count();
  // Fields without a body count as continuous as well, so that no search is necessary for them.
  const unsigned used = cracks_ ? cracks_->fields().count() : fields;
  std::array<grid::FieldSet, 6> bonded;
  bonded.fill(grid::FieldSet::from(used));
  for (std::size_t b = 0; b < touched.size(); ++b) {
    for (std::size_t face = 0; face < 6; ++face) {
      if ((touched[b] >> face & 1U) == 0) continue;
      const unsigned field = field_of_body[b];
      bonded[face] |= cracks_ ? cracks_->fields().parts(field) : grid::FieldSet::of(field);
      for (std::uint8_t part = 1; part < state_.setup.contact_fields.parts(b); ++part)
        bonded[face].insert(state_.setup.contact_fields.of_part(b, part));
    }
  }
  state_.grid.bond_at_planes(bonded);
  first_touches_.emplace(fields);
  first_touches_->set(state_.run.touched);
  with_images_.watch(*first_touches_);
}

bool ContactStage::is_one_with_image(std::size_t body, std::size_t face) const {
  return state_.grid.is_bonded_at(face, field_of_body_.empty() ? 0U : field_of_body_[body]);
}

bool ContactStage::may_meet_images() const {
  for (std::size_t face = 0; face < 6; ++face) {
    if (state_.grid.is_apart_at(face)) return true;
  }
  return false;
}

void ContactStage::find_surfaces_at_walls() {
  if (!may_meet_images()) return;
  state_.profile.time("walls", [&] {
    with_images_.find_surfaces(state_.shape, state_.particles, state_.transition.position, state_.grid,
                               state_.run.time_step);
  });
}

}  // namespace whipple::solver
