// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/lighting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

#include "src/case/build/lattice.hpp"
#include "src/case/case.hpp"
#include "src/core/base/log.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::cases {
namespace {

constexpr double unlit = std::numeric_limits<double>::infinity();
constexpr double samples_per_cell = 2.0;  ///< along a ray
constexpr double most_cells = 2e6;
constexpr double hot_cells = 4.0;  ///< radius around detonators that burns by time in mode "volume"

}  // namespace

Arrival::Arrival(DetonationField field, std::span<const Detonation> detonations)
    : field_(std::move(field)), detonations_(detonations.begin(), detonations.end()) {
  const std::size_t count = field_.cells[0] * field_.cells[1] * field_.cells[2];
  velocity_.resize(count);
  time_.assign(count, unlit);
  source_.assign(count, 0);
  parallel::for_each_uneven(count, [&](std::size_t c) { velocity_[c] = field_.velocity(centre(c)); });
  at_surface_.resize(count);
  parallel::for_each_uneven(count, [&](std::size_t c) {
    for_each_neighbour(index_of(c), [&](std::size_t n) {
      if (velocity_[n] != velocity_[c]) at_surface_[c] = 1;
    });
  });
  light_in_sight();
  light_shadows();
}

Arrival::Index Arrival::index_of(const Vector3& point) const {
  Index index{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    if (field_.cells[a] > 1) {
      index[a] = static_cast<std::ptrdiff_t>(std::floor((point[axis] - field_.lower[axis]) / field_.cell));
    }
  }
  return index;
}

std::size_t Arrival::number_of(const Index& index) const {
  const auto at = [&](std::size_t a) { return static_cast<std::size_t>(index[a]); };
  return (at(2) * field_.cells[1] + at(1)) * field_.cells[0] + at(0);
}

bool Arrival::holds(const Index& index) const {
  for (std::size_t a = 0; a < 3; ++a) {
    if (index[a] < 0 || index[a] >= static_cast<std::ptrdiff_t>(field_.cells[a])) return false;
  }
  return true;
}

Arrival::Index Arrival::index_of(std::size_t cell) const {
  const auto signed_of = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
  const std::size_t row = cell / field_.cells[0];
  return {signed_of(cell % field_.cells[0]), signed_of(row % field_.cells[1]),
          signed_of(row / field_.cells[1])};
}

Vector3 Arrival::centre(std::size_t cell) const {
  const Index index = index_of(cell);
  Vector3 at = field_.lower;
  for (std::size_t a = 0; a < 3; ++a) {
    if (field_.cells[a] > 1)
      at[static_cast<Eigen::Index>(a)] += (static_cast<double>(index[a]) + 0.5) * field_.cell;
  }
  return at;
}

template <class Function>
void Arrival::for_each_neighbour(const Index& index, Function&& f) const {
  for (std::ptrdiff_t k = -1; k <= 1; ++k) {
    for (std::ptrdiff_t j = -1; j <= 1; ++j) {
      for (std::ptrdiff_t i = -1; i <= 1; ++i) {
        const Index next = {index[0] + i, index[1] + j, index[2] + k};
        if ((i != 0 || j != 0 || k != 0) && holds(next)) f(number_of(next));
      }
    }
  }
}

bool Arrival::sees(const Vector3& from, const Vector3& to, double velocity, bool from_outside) const {
  const Vector3 way = to - from;
  const auto steps = static_cast<std::size_t>(std::ceil(samples_per_cell * way.norm() / field_.cell));
  bool inside = !from_outside;
  for (std::size_t i = 0; i < steps; ++i) {
    const Vector3 at = from + static_cast<double>(i) / static_cast<double>(steps) * way;
    const Index index = index_of(at);
    const std::size_t cell = holds(index) ? number_of(index) : time_.size();
    // In cells at a surface, the velocity is evaluated at the point instead of the centre.
    const double here = cell == time_.size()     ? 0.0
                        : at_surface_[cell] != 0 ? field_.velocity(at)
                                                 : velocity_[cell];
    if (here != velocity && (here != 0.0 || inside)) return false;
    inside = inside || here == velocity;
  }
  return true;
}

double Arrival::by_source(std::uint32_t source, const Vector3& point, double velocity) const {
  if (source < detonations_.size()) return detonations_[source].arrival(point, velocity);
  const std::size_t cell = source - detonations_.size();
  return time_[cell] + (point - centre(cell)).norm() / velocity;
}

void Arrival::light_in_sight() {
  parallel::for_each_uneven(time_.size(), [&](std::size_t c) {
    if (velocity_[c] == 0.0) return;
    const Vector3 at = centre(c);
    for (std::size_t d = 0; d < detonations_.size(); ++d) {
      const Detonation::Ray ray = detonations_[d].ray_to(at, velocity_[c]);
      const double time = ray.time + (at - ray.from).norm() / velocity_[c];
      if (!(time < time_[c]) || !sees(ray.from, at, velocity_[c], true)) continue;
      time_[c] = time;
      source_[c] = static_cast<std::uint32_t>(d);
    }
  });
}

void Arrival::light_shadows() {
  using Entry = std::pair<double, std::size_t>;  // ties are resolved by the cell number
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  // The front starts only at cells with neighbours still to be lit.
  for (std::size_t c = 0; c < time_.size(); ++c) {
    if (time_[c] == unlit) continue;
    bool at_rim = false;
    for_each_neighbour(index_of(c), [&](std::size_t n) {
      const bool alike = time_[n] != unlit && source_[n] == source_[c] && velocity_[n] == velocity_[c];
      at_rim = at_rim || (velocity_[n] > 0.0 && !alike);
    });
    if (at_rim) front.emplace(time_[c], c);
  }
  std::vector<std::uint8_t> done(time_.size(), 0);
  constexpr double round_off = 1e-12;
  while (!front.empty()) {
    const auto [time, c] = front.top();
    front.pop();
    if (done[c] != 0 || time > time_[c]) continue;
    done[c] = 1;
    const Vector3 from = centre(c);
    for_each_neighbour(index_of(c), [&](std::size_t n) {
      if (velocity_[n] == 0.0 || done[n] != 0) return;
      const Vector3 at = centre(n);
      const double bound = time_[n] * (1.0 - round_off), D = velocity_[n];
      double arrival = unlit;
      std::uint32_t source = source_[c];
      if (velocity_[n] == velocity_[c]) {
        arrival = by_source(source, at, D);
        const bool of_detonator = source < detonations_.size();
        const Vector3 origin =
            of_detonator ? detonations_[source].ray_to(at, D).from : centre(source - detonations_.size());
        if (!(arrival < bound) || !sees(origin, at, D, of_detonator)) arrival = unlit;
      }
      if (arrival == unlit) {
        source = static_cast<std::uint32_t>(detonations_.size() + c);
        arrival = time_[c] + (at - from).norm() / D;
      }
      if (!(arrival < bound)) return;
      time_[n] = arrival;
      source_[n] = source;
      front.emplace(arrival, n);
    });
  }
}

double Arrival::at(const Vector3& point, double velocity) const {
  const Index index = index_of(point);
  double first = unlit;
  std::vector<std::uint32_t> tried;
  const auto try_source_of = [&](std::size_t c) {
    if (time_[c] == unlit || velocity_[c] != velocity) return;
    if (std::ranges::find(tried, source_[c]) != tried.end()) return;
    tried.push_back(source_[c]);
    first = std::min(first, by_source(source_[c], point, velocity));
  };
  if (holds(index)) try_source_of(number_of(index));
  for_each_neighbour(index, try_source_of);
  return first == unlit ? never : first;
}

namespace {

/// Returns the region that contains all burning bodies.
DetonationField field_of(const Case& setup) {
  Shape::Bounds box = {Vector3::Constant(unlit), Vector3::Constant(-unlit)};
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (!setup.materials[b]->burns()) continue;
    const Shape::Bounds bounds = common_part(bounds_of(setup, setup.bodies[b]), domain_of(setup));
    box.lower = box.lower.cwiseMin(bounds.lower);
    box.upper = box.upper.cwiseMax(bounds.upper);
  }
  const bool planar = setup.geometry.is_planar();
  Vector3 edges = box.upper - box.lower;
  if (planar) edges[2] = box.lower[2] = 0.0;
  DetonationField field;
  field.lower = box.lower;
  field.cell = setup.burn.lighting_cell * setup.geometry.cell_size;
  const double dimensions = planar ? 2.0 : 3.0;
  const double count = (planar ? edges[0] * edges[1] : edges.prod()) / std::pow(field.cell, dimensions);
  if (count > most_cells) field.cell *= std::pow(count / most_cells, 1.0 / dimensions);
  for (std::size_t a = 0; a < (planar ? 2U : 3U); ++a) {
    const double edge = edges[static_cast<Eigen::Index>(a)];
    field.cells[a] = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(edge / field.cell)));
  }
  field.velocity = [&setup](const Vector3& point) {
    for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
      const Material& material = *setup.materials[b];
      if (material.burns() && setup.holds(setup.bodies[b], point))
        return material.burning_explosive().detonation_velocity;
    }
    return 0.0;
  };
  return field;
}

/// Returns the arrival in straight lines, regardless of obstacles; `never` if no detonator lights the body.
double straight(const Case& setup, const Body& body, const Vector3& point, double velocity) {
  double first = unlit;
  for (const Detonation& detonation : setup.detonations) {
    if (detonation.lights(body.name)) first = std::min(first, detonation.arrival(point, velocity));
  }
  return first == unlit ? never : first;
}

/// Returns whether an explosive burns without lighting times away from the detonators: by compression or by a rate law.
bool burns_elsewhere(const Case& setup, const Material& material) {
  return setup.burn.mode == BurnMode::volume || material.burning_explosive().reaction != nullptr;
}

bool is_near_detonator(const Case& setup, const Body& body, const Vector3& point, double velocity) {
  const double near = hot_cells * setup.geometry.cell_size;
  return std::ranges::any_of(setup.detonations, [&](const Detonation& detonation) {
    return detonation.lights(body.name) && (point - detonation.ray_to(point, velocity).from).norm() <= near;
  });
}

}  // namespace

void set_lighting_times(const Case& setup, Particles& particles) {
  if (!setup.has_burn()) return;
  const bool shadowed = setup.burn.lighting == LightingRule::shadowed;
  std::optional<Arrival> arrival;
  if (shadowed) arrival.emplace(field_of(setup), setup.detonations);
  std::vector<double>& times = particles.history.scalar("lighting_time");
  parallel::for_each_uneven(particles.size(), [&](std::size_t p) {
    const Material& material = *setup.materials[particles.body[p]];
    if (!material.burns()) return;
    const double velocity = material.burning_explosive().detonation_velocity;
    const Vector3& at = particles.position[p];
    const Body& body = setup.bodies[particles.body[p]];
    if (burns_elsewhere(setup, material) && !is_near_detonator(setup, body, at, velocity)) return;
    times[p] = shadowed ? arrival->at(at, velocity) : straight(setup, body, at, velocity);
  });
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (!setup.materials[b]->burns() || burns_elsewhere(setup, *setup.materials[b])) continue;
    std::size_t of_body = 0, dark = 0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      of_body += particles.body[p] == b ? 1U : 0U;
      dark += particles.body[p] == b && times[p] == never ? 1U : 0U;
    }
    if (dark == 0) continue;
    log::warning("body \"{}\": no detonation reaches {} of its {} particles: they stay unburnt",
                 setup.bodies[b].name, dark, of_body);
  }
}

}  // namespace whipple::cases
