// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/contact.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "src/solver/stages/levels.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::solver {

ContactStage::ContactStage(State& state, Hexahedra& hexahedra, contact::GridUpdate& grid_update)
    : state_(state), hexahedra_(hexahedra), with_images_(grid_update.mirror_contact()) {
  const cases::ContactControl& control = state_.setup.contact;
  const cases::ContactFields& fields = state_.setup.contact_fields;
  if (!fields.cracked.empty()) {
    cracks_.emplace(contact::SectorFields(fields.count(), fields.cracked, state_.setup.geometry.is_planar()));
    state_.grid.set_wholes(cracks_->fields().wholes());
  }
  if (fields.several() || cracks_) {
    // Other schemes strain bodies by velocities before contact, or by those of each body alone after it.
    const bool common = control.method == cases::ContactMethod::automatic &&
                        state_.setup.time.scheme == cases::Scheme::symplectic;
    contact_.emplace(
        contact::Settings{.response = common ? contact::Response::common_field : contact::Response::impulses,
                          .normal = control.normal,
                          .friction = control.friction,
                          .friction_of_field = friction_of_fields(),
                          .crack_friction = control.crack_friction,
                          .gap_test = control.gap_test,
                          .gap = control.gap,
                          .least_relaxation_rate = least_relaxation_rates()});
    field_of_body_ = fields.of_body;
  }
  set_up_walls();
}

/// Returns the Coulomb coefficients of the fields; that of explosives is separate, so that their products can slide.
std::vector<double> ContactStage::friction_of_fields() const {
  if (!state_.setup.has_burn()) return {};
  const std::vector<std::uint8_t>& field_of_body = state_.setup.contact_fields.of_body;
  const cases::ContactControl& control = state_.setup.contact;
  std::vector<double> friction(state_.setup.contact_fields.count(), control.friction);
  for (std::size_t b = 0; b < field_of_body.size(); ++b) {
    if (state_.setup.materials[b]->burns()) friction[field_of_body[b]] = control.explosive_friction;
  }
  return friction;
}

/// Returns kappa c/dx with a quarter of the sound speed at rest: failed material with open voids and boiled material
/// relax more slowly.
std::vector<double> ContactStage::least_relaxation_rates() const {
  constexpr double share_of_tight_matter = 0.25;
  // Other particle updates have no relaxation by the sound speed.
  if (state_.setup.transfer.particle_update != cases::ParticleUpdate::relaxed_affine) return {};
  const cases::ContactFields& fields = state_.setup.contact_fields;
  std::vector<double> rates(fields.count(), std::numeric_limits<double>::infinity());
  for (std::size_t b = 0; b < fields.of_body.size(); ++b) {
    const double of_body = share_of_tight_matter * state_.setup.transfer.kappa *
                           state_.setup.materials[b]->reference.sound_speed / state_.setup.domain.cell_size;
    for (std::uint8_t part = 0; part < fields.parts(b); ++part) {
      double& rate = rates[fields.of_part(b, part)];
      rate = std::min(rate, of_body);
    }
  }
  return rates;
}

void ContactStage::separate_fields() {
  if (!contact_) return;
  surfaces_found_ = false;
  field_.resize(state_.particles.size());
  for (std::size_t p = 0; p < state_.particles.size(); ++p) {
    field_[p] = field_of_body_[state_.particles.body[p]];
  }
  field_of_node_.clear();
  for (std::size_t i = 0; i < state_.transition_body.size(); ++i) {
    field_of_node_.push_back(
        state_.setup.contact_fields.of_part(state_.transition_body[i], state_.transition_part[i]));
  }
  if (cracks_) {
    state_.profile.time("cracks", [&] {
      cracks_->find(state_.shape, state_.particles,
                    {state_.transition.position, state_.transition.mass, field_of_node_}, state_.grid,
                    field_);
    });
  }
  state_.grid.separate_fields(transfer::stencil(state_.shape), {state_.particles.position, field_},
                              {state_.transition.position, field_of_node_},
                              cracks_ ? cracks_->fields().count() : state_.setup.contact_fields.count(),
                              state_.setup.contact.everywhere);
}

namespace {

/// Divides the facets of a mesh by the parts that their nodes belong to; empty `part`: all are of part 0.
std::map<std::uint8_t, std::vector<fem::Facet>> facets_by_part(const std::vector<fem::Facet>& facets,
                                                               const std::vector<std::uint8_t>& part) {
  if (part.empty()) return {{std::uint8_t{0}, facets}};
  std::map<std::uint8_t, std::vector<fem::Facet>> divided;
  for (const fem::Facet& facet : facets) divided[part[facet[0]]].push_back(facet);
  return divided;
}

}  // namespace

void ContactStage::find_surfaces(bool after_transfer) {
  if (!has_fields() || std::exchange(surfaces_found_, true)) return;
  state_.profile.time("contact", [&] {
    surface_points_.clear();
    const std::vector<std::vector<fem::Facet>>& facets = hexahedra_.free_facets();
    // The contact slots of other ranks are unknown here.
    std::optional<contact::BlocksAtContact> near;
    if (!state_.is_parallel()) near.emplace(state_.grid);
    const std::vector<fem::Mesh>& meshes = hexahedra_.meshes();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      for (const auto& [part, of_part] : facets_by_part(facets[m], hexahedra_.parts(m))) {
        surface_points_.add(meshes[m], of_part, state_.setup.contact_fields.of_part(meshes[m].body, part),
                            state_.setup.domain.cell_size, near ? &*near : nullptr);
      }
    }
    surface_points_.send_to_owners(state_.grid, transfer::stencil(state_.shape), state_.communicator);
    contact_->find_surfaces(state_.shape, state_.particles, surface_points_, state_.grid,
                            after_transfer ? state_.run.time_step : 0.0);
  });
  if (state_.grid.has_two_levels())
    stop_at_mixed(state_, contact_->mixed_particle(state_.grid), "bodies meet");
}

transfer::TouchAtNode ContactStage::touch_at_node() const {
  if (!contact_) return {};
  return [this](std::size_t slot, std::size_t node, std::size_t a, std::size_t b) {
    return contact_->touch(state_.grid, slot, node, a, b);
  };
}

void ContactStage::apply() {
  if (!contact_) return;
  const contact::Balance balance =
      contact_->apply(state_.grid, state_.run.time_step, *first_touches_, cracks_ ? &*cracks_ : nullptr);
  state_.booked.contact_heat += balance.contact_heat;
  state_.booked.friction_heat += balance.friction_heat;
  state_.booked.contact_impulse += balance.impulse;
  state_.booked.friction_impulse += balance.friction_impulse;
}

}  // namespace whipple::solver
