// SPDX-License-Identifier: BSD-3-Clause
// Contact of bodies in the step (docs/theory/contact.md).
#include <algorithm>

#include "src/solver/simulation.hpp"

namespace whipple::solver {
namespace {

contact::Normal normal(const std::string& name) {
  using enum contact::Normal;
  return name == "collinear" ? collinear : name == "logistic_regression" ? logistic_regression : separating;
}

}  // namespace

void Simulation::set_up_contact() {
  const setup::ContactControl& control = setup_.contact;
  if (control.method == "none") return;
  contact_.emplace(contact::Settings{.normal = normal(control.normal),
                                     .friction = control.friction,
                                     .gap_test = control.gap_test,
                                     .gap = control.gap});
  contact_field_of_body_ = setup_.contact_fields();
}

void Simulation::separate_fields() {
  if (!contact_) return;
  contact_field_.resize(particles_.size());
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    contact_field_[p] = contact_field_of_body_[particles_.body[p]];
  }
  grid_.separate_fields(transfer::stencil(shape_), {particles_.position, contact_field_}, {},
                        *std::ranges::max_element(contact_field_of_body_) + 1U, setup_.contact.everywhere);
}

void Simulation::apply_contact() {
  if (!contact_) return;
  const contact::Balance balance = contact_->apply(grid_, state_.time_step);
  step_.contact_heat += balance.contact_heat;
  step_.friction_heat += balance.friction_heat;
  step_.contact_impulse += balance.impulse;
  step_.friction_impulse += balance.friction_impulse;
}

}  // namespace whipple::solver
