// SPDX-License-Identifier: BSD-3-Clause
// Contact of bodies in the step (docs/theory/contact.md).
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "src/afemp/transition.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

void Simulation::set_up_contact() {
  const cases::ContactControl& control = setup_.contact;
  if (!setup_.contact_fields.several()) return;
  // Other schemes strain bodies by velocities before contact, or after it of each body alone.
  const bool common = control.method == cases::ContactMethod::automatic &&
                      setup_.time.scheme == cases::Scheme::symplectic;
  contact_.emplace(
      contact::Settings{.response = common ? contact::Response::common_field : contact::Response::impulses,
                        .normal = control.normal,
                        .friction = control.friction,
                        .gap_test = control.gap_test,
                        .gap = control.gap,
                        .least_relaxation_rate = least_relaxation_rates()});
  contact_field_of_body_ = setup_.contact_fields.of_body;
}

/// kappa c/dx with a quarter of the sound speed at rest: material that has failed and opened, or boiled, is
/// softer.
std::vector<double> Simulation::least_relaxation_rates() const {
  constexpr double share_of_tight_matter = 0.25;
  // Others relax by no speed of sound.
  if (setup_.transfer.particle_update != cases::ParticleUpdate::relaxed_affine) return {};
  const std::vector<std::uint8_t>& field_of_body = setup_.contact_fields.of_body;
  std::vector<double> rates(*std::ranges::max_element(field_of_body) + std::size_t{1},
                            std::numeric_limits<double>::infinity());
  for (std::size_t b = 0; b < field_of_body.size(); ++b) {
    double& rate = rates[field_of_body[b]];
    rate = std::min(rate, share_of_tight_matter * setup_.transfer.kappa *
                              setup_.materials[b]->reference.sound_speed / setup_.domain.cell_size);
  }
  return rates;
}

void Simulation::separate_fields() {
  if (!contact_) return;
  surfaces_found_ = false;
  contact_field_.resize(particles_.size());
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    contact_field_[p] = contact_field_of_body_[particles_.body[p]];
  }
  std::vector<std::uint8_t> field_of_node;
  for (const fem::Mesh& mesh : meshes_) {
    const auto count = static_cast<std::size_t>(std::ranges::count(mesh.nodes.in_transition, 1));
    field_of_node.insert(field_of_node.end(), count, contact_field_of_body_[mesh.body]);
  }
  for (const fem::Bars& bars : bars_) {
    field_of_node.insert(field_of_node.end(), bars.nodes.size(), contact_field_of_body_[bars.body]);
  }
  grid_.separate_fields(transfer::stencil(shape_), {particles_.position, contact_field_},
                        {transition_.position, field_of_node},
                        *std::ranges::max_element(contact_field_of_body_) + 1U, setup_.contact.everywhere);
}

/// Conduction of heat, which comes before the transfer to the grid, asks for them too.
void Simulation::find_surfaces(bool after_transfer) {
  if (!contact_ || std::exchange(surfaces_found_, true)) return;
  profile_.time("contact", [&] {
    surface_points_.clear();
    if (surfaces_changed_) {
      surface_facets_.clear();
      for (const fem::Mesh& mesh : meshes_) {
        surface_facets_.push_back(afemp::free_facets(mesh, setup_.geometry));
      }
      shared_nodes_.drop_inner_facets(meshes_, surface_facets_);
      surfaces_changed_ = false;
    }
    // Of the contact slots of other ranks nothing is known here.
    std::optional<contact::BlocksAtContact> near;
    if (parallel::size(communicator_) == 1) near.emplace(grid_);
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      surface_points_.add(meshes_[m], surface_facets_[m], contact_field_of_body_[meshes_[m].body],
                          setup_.domain.cell_size, near ? &*near : nullptr);
    }
    surface_points_.send_to_owners(grid_, transfer::stencil(shape_), communicator_);
    contact_->find_surfaces(shape_, particles_, surface_points_, grid_,
                            after_transfer ? state_.time_step : 0.0);
  });
}

/// Where bodies with velocity fields of their own exchange heat; empty without any.
transfer::TouchAtNode Simulation::touch_at_node() const {
  if (!contact_) return {};
  return [this](std::size_t slot, std::size_t node, std::size_t a, std::size_t b) {
    return contact_->touch(grid_, slot, node, a, b);
  };
}

void Simulation::apply_contact() {
  if (!contact_) return;
  const contact::Balance balance = contact_->apply(grid_, state_.time_step, *first_touches_);
  step_.contact_heat += balance.contact_heat;
  step_.friction_heat += balance.friction_heat;
  step_.contact_impulse += balance.impulse;
  step_.friction_impulse += balance.friction_impulse;
}

}  // namespace whipple::solver
