// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmark/sph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "src/core/base/error.hpp"
#include "src/material/update.hpp"

namespace whipple::sph {
namespace {

/// Share of the particle distance by which the search for pairs reaches further than the sums.
constexpr double skin = 0.3;

/// Cubic spline of reach 2 h.
double spline(double r, double h) {
  const double q = r / h, scale = 1.0 / (std::numbers::pi * h * h * h);
  if (q >= 2.0) return 0.0;
  return q < 1.0 ? scale * (1.0 - 1.5 * q * q + 0.75 * q * q * q) : 0.25 * scale * std::pow(2.0 - q, 3);
}

/// Returns dW/dr over r.
double slope_over_distance(double r, double h) {
  const double q = r / h, scale = 1.0 / (std::numbers::pi * h * h * h * h * h);
  if (q >= 2.0) return 0.0;
  return q < 1.0 ? scale * (-3.0 + 2.25 * q) : -0.75 * scale * (2.0 - q) * (2.0 - q) / q;
}

/// Particles and images sorted by cell, for the search of pairs.
struct Cells {
  Cells(const Vector3& lower, const Vector3& upper, double width) : origin(lower), inverse(1.0 / width) {
    for (int a = 0; a < 3; ++a) counts[a] = std::max(1, static_cast<int>((upper[a] - lower[a]) * inverse));
    first.assign(static_cast<std::size_t>(counts[0]) * counts[1] * counts[2] + 1, 0);
  }
  /// Points outside belong to the cells at the border.
  [[nodiscard]] std::array<int, 3> cell(const Vector3& x) const {
    std::array<int, 3> c{};
    for (int a = 0; a < 3; ++a) {
      c[a] = static_cast<int>(std::clamp(std::floor((x[a] - origin[a]) * inverse), 0.0, counts[a] - 1.0));
    }
    return c;
  }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i) * counts[1] + j) * counts[2] + k;
  }

  Vector3 origin;
  double inverse;
  std::array<int, 3> counts{};
  std::vector<std::size_t> first;
};

}  // namespace

Simulation::Simulation(const cases::Case& setup, const Options& options) : setup_(setup), options_(options) {
  if (setup.domain.is_planar()) throw InputError("sph: needs three dimensions");
  cases::Seeding seeding = cases::seed(setup);
  particles_ = std::move(seeding.particles);
  bodies_ = std::move(seeding.bodies);
  spacing_ = std::cbrt(*std::ranges::max_element(particles_.volume));
  length_ = options.smoothing * spacing_;
  for (int a = 0; a < 3; ++a) {
    mirror_[a] =
        setup.domain.boundary.in_order()[2 * static_cast<std::size_t>(a)] == grid::Boundary::symmetry;
  }
  const std::size_t n = particles_.size();
  stress_.resize(n);
  gradient_.assign(n, Matrix3::Zero());
  shape_.resize(n);
  force_.resize(n);
  closing_.resize(n);
  pushing_.resize(n);
}

double Simulation::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += 0.5 * particles_.mass[i] * particles_.velocity[i].squaredNorm();
  }
  return sum;
}

double Simulation::internal_energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += particles_.mass[i] * particles_.specific_internal_energy[i];
  }
  return sum;
}

Vector3 Simulation::mirrored(const Vector3& v, std::uint8_t image) const {
  Vector3 result = v;
  for (int a = 0; a < 3; ++a) {
    if ((image >> a & 1) != 0) result[a] = -result[a];
  }
  return result;
}

Vector3 Simulation::mirrored_point(const Vector3& x, std::uint8_t image) const {
  return mirrored(x - setup_.domain.lower, image) + setup_.domain.lower;
}

void Simulation::find_pairs() {
  const std::vector<Vector3>& x = particles_.position;
  const double reach = 2.0 * length_ + skin * spacing_;
  std::vector<std::pair<std::uint32_t, std::uint8_t>> points;  // particles, then images
  std::vector<Vector3> at;
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    if (!x[i].allFinite()) {
      throw StateError(fmt::format("sph: t = {} s: the position of particle {} is undefined", time_, i));
    }
    for (std::uint8_t image = 0; image < 8; ++image) {
      bool near = true;
      for (int a = 0; a < 3 && near; ++a) {
        near = (image >> a & 1) == 0 || (mirror_[a] && x[i][a] - setup_.domain.lower[a] < reach);
      }
      if (!near) continue;
      points.emplace_back(i, image);
      at.push_back(mirrored_point(x[i], image));
    }
  }
  Cells cells(setup_.domain.lower - Vector3::Constant(reach), setup_.domain.upper, reach);
  std::vector<std::size_t> cell_of(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [a, b, c] = cells.cell(at[k]);
    ++cells.first[(cell_of[k] = cells.index(a, b, c)) + 1];
  }
  for (std::size_t c = 1; c < cells.first.size(); ++c) cells.first[c] += cells.first[c - 1];
  std::vector<std::size_t> next(cells.first.begin(), cells.first.end() - 1), sorted(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) sorted[next[cell_of[k]]++] = k;

  pairs_.clear();
  for (std::uint32_t i = 0; i < x.size(); ++i) {
    const auto [a, b, c] = cells.cell(x[i]);
    for (int ia = std::max(0, a - 1); ia <= std::min(a + 1, cells.counts[0] - 1); ++ia) {
      for (int ib = std::max(0, b - 1); ib <= std::min(b + 1, cells.counts[1] - 1); ++ib) {
        // Cells along the last axis lie behind one another.
        const std::size_t begin = cells.first[cells.index(ia, ib, std::max(0, c - 1))];
        const std::size_t end = cells.first[cells.index(ia, ib, std::min(c + 1, cells.counts[2] - 1)) + 1];
        for (std::size_t s = begin; s < end; ++s) {
          const auto [j, image] = points[sorted[s]];
          if (image == 0 && j <= i) continue;
          if ((at[sorted[s]] - x[i]).squaredNorm() < reach * reach) pairs_.push_back({i, j, image});
        }
      }
    }
  }
  links_.resize(pairs_.size());
  found_at_ = x;
}

void Simulation::find_forces() {
  const Particles& q = particles_;
  const double h = length_, at_spacing = spline(spacing_, h);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double density = q.mass[i] / volume(i), pressure = q.pressure[i];
    stress_[i] = (q.deviatoric_stress[i].matrix() - pressure * Matrix3::Identity()) / (density * density);
    pushing_[i] = pressure < 0.0 ? -options_.artificial_stress * pressure / (density * density) : 0.0;
    force_[i].setZero();
    closing_[i] = 0.0;
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [i, j, image] = pairs_[k];
    Link& link = links_[k];
    link.apart = q.position[i] - mirrored_point(q.position[j], image);
    const double square = link.apart.squaredNorm(), r = std::sqrt(square);
    link.slope = slope_over_distance(r, h);
    if (link.slope == 0.0) {
      link.force.setZero();
      continue;
    }
    double scalar = 0.0;
    const double closing = (q.velocity[i] - mirrored(q.velocity[j], image)).dot(link.apart);
    if (closing < 0.0) {
      const double mu = -h * closing / (square + 0.01 * h * h);
      const double sound = 0.5 * (q.sound_speed[i] + q.sound_speed[j]);
      const double density = 0.5 * (q.mass[i] / volume(i) + q.mass[j] / volume(j));
      scalar = mu * (options_.linear_viscosity * sound + options_.quadratic_viscosity * mu) / density;
      closing_[i] = std::max(closing_[i], mu);
      closing_[j] = std::max(closing_[j], mu);
    }
    if (pushing_[i] + pushing_[j] > 0.0) {
      scalar += (pushing_[i] + pushing_[j]) * std::pow(spline(r, h) / at_spacing, 4);
    }
    const Vector3 traction = stress_[i] * link.apart +
                             mirrored(stress_[j] * mirrored(link.apart, image), image) - scalar * link.apart;
    link.force = q.mass[i] * q.mass[j] * link.slope * traction;
    force_[i] += link.force;
    if (image == 0) force_[j] -= link.force;
  }
}

void Simulation::heat_and_find_gradients(double dt) {
  Particles& q = particles_;
  std::ranges::fill(gradient_, Matrix3::Zero());
  std::ranges::fill(shape_, Matrix3::Zero());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [i, j, image] = pairs_[k];
    const Link& link = links_[k];
    if (link.slope == 0.0) continue;
    const Vector3 now = q.velocity[i] - mirrored(q.velocity[j], image);
    const Vector3 mean = 0.5 * (now + before_[i] - mirrored(before_[j], image));
    const double work = -0.5 * dt * link.force.dot(mean);  // of half of the pair
    const Vector3 towards = -link.slope * link.apart;      // - grad W
    const Matrix3 rate = now * towards.transpose(), length = link.apart * towards.transpose();
    q.specific_internal_energy[i] += work / q.mass[i];
    gradient_[i] += volume(j) * rate;
    shape_[i] += volume(j) * length;
    if (image != 0) continue;
    q.specific_internal_energy[j] += work / q.mass[j];
    gradient_[j] += volume(i) * rate;
    shape_[j] += volume(i) * length;
  }
  // Inside the shape is 1, at a corner 1/8; a particle with neighbours in one plane or fewer keeps the sum as it is.
  constexpr double flat = 1e-4;
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (std::abs(shape_[i].determinant()) > flat) gradient_[i] = (gradient_[i] * shape_[i].inverse()).eval();
  }
}

void Simulation::advance(double until) {
  Particles& q = particles_;
  double moved = found_at_.empty() ? spacing_ : 0.0;
  for (std::size_t i = 0; i < found_at_.size(); ++i) {
    moved = std::max(moved, (q.position[i] - found_at_[i]).squaredNorm());
  }
  if (found_at_.empty() || 4.0 * moved > skin * skin * spacing_ * spacing_) find_pairs();
  find_forces();
  double fastest = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double viscous =
        options_.linear_viscosity * q.sound_speed[i] + options_.quadratic_viscosity * closing_[i];
    fastest = std::max(fastest, q.sound_speed[i] + 1.2 * viscous);
  }
  // Nothing moves further than the search reaches.
  double speed = 0.0;
  for (const Vector3& v : q.velocity) speed = std::max(speed, v.norm());
  double dt = std::min(until - time_, options_.courant * length_ / fastest);
  if (speed > 0.0) dt = std::min(dt, 0.5 * spacing_ / speed);
  before_ = q.velocity;
  for (std::size_t i = 0; i < q.size(); ++i) q.velocity[i] += dt / q.mass[i] * force_[i];
  heat_and_find_gradients(dt);
  for (std::size_t i = 0; i < q.size(); ++i) q.position[i] += dt * q.velocity[i];
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const std::size_t first = bodies_[b].first, count = bodies_[b].count;
    update_material(*setup_.materials[b], q, first, first + count, std::span(gradient_).subspan(first, count),
                    {.time_step = dt,
                     .cell_size = length_,
                     .linear_viscosity = 0.0,
                     .quadratic_viscosity = 0.0,
                     .time = time_ + dt});
  }
  time_ += dt;
}

}  // namespace whipple::sph
