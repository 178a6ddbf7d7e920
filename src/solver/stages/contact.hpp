// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "src/contact/contact.hpp"
#include "src/contact/grid_update.hpp"
#include "src/device/contact/constants.hpp"
#include "src/device/contact/touches.hpp"
#include "src/solver/carriers/hexahedra.hpp"
#include "src/solver/state.hpp"
#include "src/transfer/conduction.hpp"

namespace whipple::solver {

/// Applies contact between bodies (docs/theory/contact.md), and between bodies and their images at mirror planes and
/// walls, with which they are either continuous or in contact (docs/theory/mpm.md, section 3).
class ContactStage {
 public:
  /// @param grid_update  applies the contact with images
  ContactStage(State& state, Hexahedra& hexahedra, contact::GridUpdate& grid_update);

  /// Returns whether a body is continuous with its image at a face, as its velocity field is.
  [[nodiscard]] bool is_one_with_image(std::size_t body, std::size_t face) const;
  /// Returns whether any material may be in contact with its image.
  [[nodiscard]] bool may_meet_images() const;
  /// Returns whether bodies have separate velocity fields.
  [[nodiscard]] bool has_fields() const { return state_.setup.contact_fields.several(); }

  /// Separates the velocity fields where bodies are close to each other. Call after particles were binned. Collective.
  void separate_fields();
  /// Finds the surfaces of bodies at nodes, once in a step: heat conduction may require them before the transfer to the
  /// grid. Collective.
  void find_surfaces(bool after_transfer);
  /// Finds the surfaces at mirror planes and walls. Collective.
  void find_surfaces_at_walls();
  /// Changes the velocities of nodes so that bodies do not penetrate each other.
  void apply();
  /// Returns a function that states where bodies with separate velocity fields exchange heat; empty without such
  /// bodies.
  [[nodiscard]] transfer::TouchAtNode touch_at_node() const;

  /// Watches for first contacts that could strain material in one whole step by more than the limit of the time step.
  /// @param accurate_step  time step that the state allows, s
  void watch_touches(double accurate_step);
  /// Predicts, at the end of a step, the next first contact of bodies. Collective.
  /// @param accurate_step  time step that the state allowed, s
  void foresee_touches(double accurate_step);
  /// Returns the minimum closing speed (m/s) of first contacts that limit the time step.
  [[nodiscard]] double least_closing_speed(double accurate_step) const;
  /// Records what a device found of first contacts.
  void see(const device::DecidingApproaches& of_pair);
  void see_face(std::size_t face, const device::DecidingApproaches& of_face);
  /// Returns the constants of contact on a device.
  [[nodiscard]] device::ContactConstants constants_for_device() const;

 private:
  void set_up_walls();
  [[nodiscard]] std::vector<double> least_relaxation_rates() const;
  [[nodiscard]] std::vector<double> friction_of_fields() const;

  State& state_;
  Hexahedra& hexahedra_;
  contact::MirrorContact& with_images_;
  // If bodies have separate velocity fields, or are divided at cracks
  std::optional<contact::Contact> contact_;
  std::optional<contact::Cracks> cracks_;  // of the bodies that are divided at cracks
  std::vector<std::uint8_t> field_of_body_;
  std::optional<contact::FirstTouches> first_touches_;
  bool surfaces_found_ = false;              // in the current step
  std::vector<std::uint8_t> field_;          // of each particle
  std::vector<std::uint8_t> field_of_node_;  // of each node of elements that moves with the grid
  contact::SurfacePoints surface_points_;
};

}  // namespace whipple::solver
