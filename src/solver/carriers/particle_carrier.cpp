// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/carriers/particle_carrier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/carriers/explosives.hpp"
#include "src/solver/carriers/figures.hpp"
#include "src/solver/device/device_stage.hpp"

namespace whipple::solver {

void ParticleCarrier::complete_seeded(bool extent) {
  Particles& particles = state_.particles;
  if (!(state_.affine_inertia() > 0.0)) {
    std::vector<Matrix3>().swap(particles.affine_velocity);
  } else if (!(state_.particle_affine_inertia() > 0.0)) {
    std::ranges::fill(particles.affine_velocity, Matrix3::Zero().eval());
  }
  if (!extent) std::vector<SymmetricTensor>().swap(particles.extent);
}

void ParticleCarrier::add_fields_of_motion() {
  Particles& particles = state_.particles;
  if (state_.affine_inertia() > 0.0 && particles.affine_velocity.empty())
    particles.affine_velocity.resize(particles.size(), Matrix3::Zero());
  if (state_.keeps_losses() && particles.unresolved_energy.empty()) use_stores(particles);
}

void ParticleCarrier::complete_read(bool extent) {
  require_fields(extent);
  sort_by_body(state_.particles);  // checkpoints hold the particles rank by rank
  state_.find_bodies();
}

/// Returns, for each chunk of particles, 1 if it has been inactive since its values were computed.
/// @param arrangement  arrangement of the particles at that time; set to the present one
std::vector<std::uint8_t> ParticleCarrier::stays_since(std::size_t& arrangement) const {
  const bool same = std::exchange(arrangement, state_.grid.arrangement()) == state_.grid.arrangement();
  std::vector<std::uint8_t> stays(parallel::chunk_count(state_.particles.size()), 0);
  if (!same) return stays;
  parallel::for_each(stays.size(),
                     [&](std::size_t chunk) { stays[chunk] = state_.grid.chunk_rests(chunk) ? 1 : 0; });
  return stays;
}

std::size_t ParticleCarrier::particle_count() const {
  return state_.device != nullptr ? state_.device->particle_count() : state_.particles.size();
}

double ParticleCarrier::fastest() {
  if (state_.device != nullptr) return state_.device->fastest();
  const Particles& particles = state_.particles;
  const Explosives explosives(state_);
  const grid::Geometry& geometry = state_.grid.geometry();
  const bool two_levels = geometry.levels.are_two();
  const std::vector<std::uint8_t> stays = stays_since(fastest_.arrangement);
  parallel::update_chunks(
      particles.size(), fastest_.values, [&](std::size_t chunk) { return stays[chunk] != 0; },
      [&](std::size_t begin, std::size_t end) {
        double fastest = 0.0;
        for (std::size_t p = begin; p < end; ++p) {
          const double speed = particles.sound_speed[p] + particles.velocity[p].cwiseAbs().maxCoeff();
          // In coarse cells, twice as fast is as far.
          const bool coarse = two_levels && geometry.level_at(particles.position[p]) == grid::Level::coarse;
          fastest = std::max(fastest, coarse ? 0.5 * speed : speed);
        }
        if (explosives.any()) fastest = std::max(fastest, explosives.fastest(begin, end));
        return fastest;
      });
  double speed = 0.0;
  for (const double fastest : fastest_.values) speed = std::max(speed, fastest);
  return speed;
}

void ParticleCarrier::sort() {
  std::vector<std::uint32_t> next;
  for (const cases::BodySummary& body : state_.bodies) next.push_back(static_cast<std::uint32_t>(body.first));
  state_.grid.list_by_stencil(by_stencil_);
  sorted_.resize(state_.particles.size());
  for (const std::uint32_t p : by_stencil_) sorted_[next[state_.particles.body[p]]++] = p;
  reorder(state_.particles, sorted_, sort_buffers_);
  state_.grid.particles_reordered(sorted_);
}

void ParticleCarrier::reallocated() {
  sort_by_body(state_.particles);
  state_.find_bodies();
  state_.grid.particles_reordered();
}

void ParticleCarrier::add_totals(Totals& sum) {
  if (state_.device != nullptr) {
    sum += state_.device->totals();
    return;
  }
  sum += totals_of(state_.particles, state_.inertia_of_particles(), totals_.values,
                   stays_since(totals_.arrangement));
}

void ParticleCarrier::add_phases(std::span<PhaseMasses> of_body) const {
  if (state_.device != nullptr) return state_.device->add_phases(of_body);
  const Particles& particles = state_.particles;
  for (std::uint32_t b = 0; b < of_body.size(); ++b) {
    const auto own = std::ranges::equal_range(particles.body, b);
    of_body[b] +=
        phase_masses(particles, static_cast<std::size_t>(own.begin() - particles.body.begin()), own.size());
  }
}

void ParticleCarrier::add_figures(Figures& figures) const {
  if (state_.device != nullptr) return state_.device->add_figures(figures);
  add_speeds(state_.particles.velocity, figures);
  add_state(state_.particles, figures);
  add_energy_parts(
      state_.particles, state_.setup.materials, [&](std::size_t p) { return state_.particles.body[p]; },
      figures);
  figures.chemical_energy += Explosives(state_).chemical_energy();
}

void ParticleCarrier::add_releasable(Releasable& sum) const { add_releasable_of(state_.particles, sum); }

double ParticleCarrier::largest_speed(const Vector3& frame) {
  if (state_.device != nullptr) return state_.device->largest_speed(frame);
  const std::vector<Vector3>& velocity = state_.particles.velocity;
  if (frame != frame_of_speeds_) largest_squares_.arrangement = 0;
  frame_of_speeds_ = frame;
  const std::vector<std::uint8_t> stays = stays_since(largest_squares_.arrangement);
  parallel::update_chunks(
      velocity.size(), largest_squares_.values, [&](std::size_t chunk) { return stays[chunk] != 0; },
      [&](std::size_t begin, std::size_t end) {
        double largest = 0.0;
        for (std::size_t p = begin; p < end; ++p) {
          largest = std::max(largest, (velocity[p] - frame).squaredNorm());
        }
        return largest;
      });
  double largest = 0.0;
  for (const double of_chunk : largest_squares_.values) largest = std::max(largest, of_chunk);
  return std::sqrt(largest);
}

std::uint64_t ParticleCarrier::largest_particle_id() const {
  return state_.particles.size() == 0 ? 0 : std::ranges::max(state_.particles.id);
}

std::size_t ParticleCarrier::bytes() const { return bytes_of(state_.particles); }

double ParticleCarrier::mass_in(const cases::LoadedRegion& region) const {
  const Particles& q = state_.particles;
  return parallel::sum<double>(
      q.size(), [&](std::size_t p) { return region.contains(q.body[p], q.position[p]) ? q.mass[p] : 0.0; });
}

void ParticleCarrier::for_each_point(const std::function<void(const Point& point)>& visit) const {
  const Particles& q = state_.particles;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const double c = q.sound_speed[p];
    const bool is_stressed = std::abs(q.pressure[p]) * q.volume[p] > 1e-6 * q.mass[p] * c * c;
    visit({q.body[p], q.position[p], q.velocity[p], c, is_stressed, q.mass[p]});
  }
}

void ParticleCarrier::for_each_part(const SelectElement&,
                                    const std::function<void(const Part& part)>& visit) const {
  const Particles& q = state_.particles;
  for (std::size_t p = 0; p < q.size(); ++p) {
    visit({q.id[p], q.position[p], q.velocity[p], q.mass[p], q.volume[p], q, p});
  }
}

std::string ParticleCarrier::count_text(std::size_t body) const {
  if (state_.setup.bodies[body].discretization.has_elements() ||
      state_.setup.bodies[body].discretization.is_bars()) {
    return {};
  }
  return fmt::format("{} particles", sum_over_ranks(state_.communicator, state_.bodies[body].count));
}

}  // namespace whipple::solver
