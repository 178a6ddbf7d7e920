// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/contact/contact.hpp"
#include "src/contact/grid_update.hpp"
#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/conduction.hpp"

namespace whipple::solver {

/// Contact of bodies with one another (docs/theory/contact.md), and with their images at mirror planes and walls: one
/// with its image, or in contact with it (docs/theory/mpm.md, section 3).
class ContactStage {
 public:
  /// @param grid_update  applies the contact with images
  ContactStage(State& state, Hexahedra& hexahedra, contact::GridUpdate& grid_update);

  /// Returns whether a body is one with its image at a face, as the field that it moves in is.
  [[nodiscard]] bool is_one_with_image(std::size_t body, std::size_t face) const;
  /// Returns whether there is material that may meet its image as another body.
  [[nodiscard]] bool may_meet_images() const;
  /// Returns whether bodies have velocity fields of their own.
  [[nodiscard]] bool has_fields() const { return state_.setup.contact_fields.several(); }

  /// Separates the velocity fields where bodies are near one another, after particles were binned. Collective.
  void separate_fields();
  /// Finds the surfaces of bodies at nodes, once in a step: heat conduction may ask for them before the transfer to
  /// the grid. Collective.
  void find_surfaces(bool after_transfer);
  /// Finds the surfaces at mirror planes and walls. Collective.
  void find_surfaces_at_walls();
  /// Changes the velocities of nodes so that bodies do not penetrate one another.
  void apply();
  /// Returns where bodies with velocity fields of their own exchange heat; empty without any.
  [[nodiscard]] transfer::TouchAtNode touch_at_node() const;

  /// Watches touches that could strain material, in one whole step, by more than the time step is to follow.
  /// @param accurate_step  s, that the state allows
  void watch_touches(double accurate_step);
  /// Foresees, at the end of a step, when bodies touch next for the first time. Collective.
  /// @param accurate_step  s, that the state allowed
  void foresee_touches(double accurate_step);

 private:
  void set_up_walls();
  [[nodiscard]] std::vector<double> least_relaxation_rates() const;
  [[nodiscard]] std::vector<double> friction_of_fields() const;

  State& state_;
  Hexahedra& hexahedra_;
  contact::MirrorContact& with_images_;
  std::optional<contact::Contact>
      contact_;                            // if bodies have velocity fields of their own, or divide at cracks
  std::optional<contact::Cracks> cracks_;  // of bodies that divide at them
  std::vector<std::uint8_t> field_of_body_;
  std::optional<contact::FirstTouches> first_touches_;
  bool surfaces_found_ = false;              // in the step under way
  std::vector<std::uint8_t> field_;          // of each particle
  std::vector<std::uint8_t> field_of_node_;  // of each node of elements that moves with the grid
  contact::SurfacePoints surface_points_;
};

}  // namespace whipple::solver
