// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/device/device_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/log.hpp"
#include "src/solver/device/problem.hpp"

namespace whipple::solver {
namespace {

using S = device::StepSums;

/// Number of steps between sorts of the particles in memory; they move less than a cell in one. Counted from the start of
/// the run, so that a run that is continued adds in the same order.
constexpr std::int64_t sort_every = 20;

/// Returns the totals that sums begin with.
template <class Sums>
Totals totals_of_sums(const Sums& of) {
  const auto vector = [&](std::size_t first) {
    return Vector3(of.sum[first], of.sum[first + 1], of.sum[first + 2]);
  };
  return {.mass = of.sum[S::total_mass],
          .momentum = vector(S::momentum),
          .momentum_scale = of.sum[S::momentum_scale],
          .angular_momentum = vector(S::angular_momentum),
          .kinetic_energy = of.sum[S::kinetic],
          .affine_kinetic_energy = of.sum[S::affine_kinetic],
          .internal_energy = of.sum[S::internal],
          .unresolved_energy = of.sum[S::unresolved_]};
}

std::unique_ptr<device::Engine> engine_of(Device device, const device::Problem& problem,
                                          const device::PointsOnHost& points) {
  return device == Device::gpu ? device::gpu_engine(problem, points)
                               : device::emulated_engine(problem, points);
}

}  // namespace

DeviceStage::DeviceStage(State& state, ContactStage& contact, Device device)
    : state_(state), contact_(contact) {
  if (state.is_parallel()) throw InputError("--device: a device steps a run on one rank");
  if (std::vector<InputFault> faults = device_faults(state.setup); !faults.empty())
    throw InputError(std::move(faults));
  to_columns(state_.particles, points_);
  engine_ = engine_of(device, device_problem(state, contact), points_);
  measured_ = engine_->measure();
  log::info("device: {}, {:.3g} GB", engine_->device(), 1e-9 * static_cast<double>(engine_->bytes()));
}

DeviceStage::~DeviceStage() = default;

Totals DeviceStage::totals() const { return totals_of_sums(measured_); }

const std::vector<device::BodyFigures>& DeviceStage::figures() {
  if (figures_.empty()) figures_ = engine_->figures();
  return figures_;
}

void DeviceStage::add_phases(std::span<PhaseMasses> of_body) {
  using F = device::BodyFigures;
  for (std::size_t b = 0; b < of_body.size(); ++b) {
    const std::array<double, F::sums>& sum = figures()[b].sum;
    of_body[b] += {{sum[F::solid], sum[F::melting], sum[F::liquid], sum[F::vapour]}, sum[F::failed_mass]};
  }
}

void DeviceStage::add_figures(Figures& figures_of_run) {
  using F = device::BodyFigures;
  for (const F& body : figures()) {
    const auto raise = [&](double& so_far, F::Maximum k) { so_far = std::max(so_far, body.largest[k]); };
    raise(figures_of_run.pressure, F::highest_pressure);
    raise(figures_of_run.temperature, F::highest_temperature);
    figures_of_run.speed =
        std::max(figures_of_run.speed, std::sqrt(std::max(body.largest[F::squared_speed], 0.0)));
    figures_of_run.elastic_energy += body.sum[F::elastic];
    figures_of_run.stored_energy += body.sum[F::stored];
    figures_of_run.stored_cold_work += body.sum[F::stored];
  }
}

double DeviceStage::largest_speed(const Vector3& frame) {
  if (frame != frame_) {
    frame_ = frame;
    engine_->set_frame({frame[0], frame[1], frame[2]});
    measured_ = engine_->measure();
  }
  return std::sqrt(measured_.largest[S::relative]);
}

double DeviceStage::rate_of_most(double share, double least, double largest) {
  return engine_->rate_of_most(state_.totals.mass, share, least, largest);
}

double DeviceStage::step(double accurate_step, const Vector3& acceleration, bool looks_at_fill) {
  const double dt = state_.run.time_step;
  is_current_ = false;
  figures_.clear();
  state_.run.particles_at_rest = 0;  // a device steps all of them
  double beside_voids = 0.0;
  state_.profile.time("device", [&] {
    const device::Outcome outcome =
        engine_->step({.dt = dt,
                       .end = state_.run.time + dt,
                       .acceleration = {acceleration[0], acceleration[1], acceleration[2]},
                       .least_closing_speed = contact_.least_closing_speed(accurate_step),
                       .looks_at_fill = looks_at_fill,
                       .sorts = state_.run.step % sort_every == 0});
    state_.booked.external_impulse += totals().mass * dt * acceleration;
    require_two_fields(outcome);
    measured_ = outcome.sums;
    beside_voids = outcome.beside_voids;
    book(outcome);
    require_valid(outcome);
  });
  const std::array<double, device::stage_count>& times = engine_->stage_times();
  for (std::size_t stage = 0; stage < times.size(); ++stage) {
    if (times[stage] == times_[stage]) continue;
    state_.profile.reassign("device", device::stage_names[stage], times[stage] - times_[stage]);
    times_[stage] = times[stage];
  }
  return beside_voids;
}

/// Adds the sums of a step to the contributions of the step.
void DeviceStage::book(const device::Outcome& outcome) {
  Ledger& booked = state_.booked;
  const auto& sum = outcome.sums.sum;
  booked.work += sum[S::work_];
  booked.external_work += sum[S::external_work_];
  booked.viscous_work += sum[S::viscous_work_];
  booked.transfer_heat += sum[S::heat_];
  booked.unresolved_kept += sum[S::kept_];
  booked.unresolved_returned += sum[S::returned_];
  booked.plastic_work += sum[S::plastic_work_];
  booked.dissipation += sum[S::dissipation_];
  booked.plastic_heat += sum[S::plastic_heat_];
  booked.conducted_heat += outcome.conducted_heat;
  booked.contact_heat += outcome.contact[0] + outcome.wall_heat;
  booked.friction_heat += outcome.contact[1];
  booked.contact_impulse += outcome.contact[2];
  booked.friction_impulse += outcome.contact[3];
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    booked.wall_impulse[a] += outcome.plane_impulse[axis] + sum[S::wall_impulse + axis];
  }
  booked.wall_impulse[1] += outcome.hoop_impulse;
  const auto counted = [&](std::uint32_t event) {
    return sum[S::first_event + static_cast<std::size_t>(std::countr_zero(event))];
  };
  booked.held_pressures += outcome.held_pressures;
  booked.below_cold_curve += counted(device::event::below_cold_curve);
  booked.limited_volume_changes += counted(device::event::limited_volume_change);
  booked.limited_densities += counted(device::event::limited_density);
  booked.limited_compressions += counted(device::event::squeezed);
  booked.limited_void_steps += counted(device::event::limited_void_step);
  for (std::size_t body = 0; body < outcome.outflow.size(); ++body) {
    if (outcome.outflow[body].sum[S::total_mass] > 0.0) {
      state_.book_outflow(body, totals_of_sums(outcome.outflow[body]));
    }
  }
  state_.rates.squared_change = outcome.sums.largest[S::change];
  state_.rates.compression = outcome.sums.largest[S::rate];
  for (const device::DecidingApproaches& of_pair : outcome.approaches) contact_.see(of_pair);
  for (std::size_t face = 0; face < outcome.face_approaches.size(); ++face) {
    contact_.see_face(face, outcome.face_approaches[face]);
  }
}

/// Ends the run where more than two velocity fields meet.
void DeviceStage::require_two_fields(const device::Outcome& outcome) const {
  if (!(outcome.contact[4] > 0.0)) return;
  const Triple<double>& at = outcome.crowded_at;
  throw StateError(
      fmt::format("step {}, t = {} s: more than two bodies meet at ({:.6g}, {:.6g}, {:.6g}) m, and a device "
                  "computes contact of two velocity fields: --device cpu computes that of any number, "
                  "contact_group joins bodies in one field",
                  state_.run.step, state_.run.time, at.x, at.y, at.z));
}

/// Ends the run if the state of a particle is not defined or out of the range of its material.
void DeviceStage::require_valid(const device::Outcome& outcome) {
  const auto first = [&](std::size_t ending) { return outcome.sums.largest[S::first_ends + ending]; };
  if (first(3) > 0.0) fail(first(3), "the state is not defined (NaN, or a volume that is not positive)");
  if (first(0) > 0.0) fail(first(0), "the state is not defined (NaN)");
  if (first(1) > 0.0) fail(first(1), "the equation of state is out of range: density outside of it");
  if (first(2) > 0.0) fail(first(2), "the equation of state is out of range: energy above it");
  for (std::size_t body = 0; body < outcome.squeezed.size(); ++body) {
    const auto& [number, of_mass, all, mass] = outcome.squeezed[body].sum;
    if (!MaterialReport::is_too_dense(of_mass, mass)) continue;
    throw StateError(
        fmt::format("step {}, t = {} s, body \"{}\": the equation of state is out of range: {:.0f} of {:.0f} "
                    "points would "
                    "be denser than it allows",
                    state_.run.step, state_.run.time, state_.setup.bodies[body].name, number, all));
  }
}

/// @param first  all_of_origin less the origin of the particle
void DeviceStage::fail(double first, const std::string& reason) {
  const auto origin = static_cast<std::uint32_t>(device::all_of_origin - first);
  synchronize();
  const auto found = std::ranges::find(points_.origin, origin);
  const auto p = static_cast<std::size_t>(found - points_.origin.begin());
  throw StateError(state_.describe_particle(p, state_.run.time + state_.run.time_step, reason));
}

bool DeviceStage::must_divide() { return engine_->must_divide(); }

void DeviceStage::upload() {
  to_columns(state_.particles, points_);
  engine_->upload(points_);
  figures_.clear();
  is_current_ = true;
}

void DeviceStage::synchronize() {
  if (is_current_) return;
  state_.profile.time("device to host", [&] {
    engine_->download(points_);
    from_columns(points_, state_.particles);
    state_.find_bodies();
    state_.grid.particles_reordered();
  });
  is_current_ = true;
}

}  // namespace whipple::solver
