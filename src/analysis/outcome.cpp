// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <ranges>

#include "src/analysis/measures.hpp"
#include "src/core/base/error.hpp"

namespace whipple::analysis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the smallest extent of the projectile by its shape, otherwise that of its particles along the flight.
double diameter_of(const Run& run, const Snapshot& first, const Frame& flight) {
  const BodyInput& body = run.bodies[flight.projectile];
  return std::isfinite(body.size) ? body.size
                                  : axial_extent(first, flight, flight.projectile, body.spacing).length();
}

/// Holds sums over the particles of the remaining wall in each cell over its face.
struct Cell {
  double mass = 0.0, momentum = 0.0;
  double rear = -infinity;
};

std::vector<Cell> cells_of(const Snapshot& snapshot, const Wall& wall, const Wall::Remains& left) {
  std::vector<Cell> cells(wall.face_cells());
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (left.wall[i] == 0) continue;
    const auto at = wall.cell_at(snapshot.position[i], left.shift);
    if (!at) continue;
    Cell& cell = cells[*at];
    cell.mass += snapshot.mass[i];
    cell.momentum += snapshot.mass[i] * wall.frame().axial(snapshot.velocity[i]);
    cell.rear = std::max(cell.rear, wall.frame().axial(snapshot.position[i]));
  }
  return cells;
}

}  // namespace

Judge::Judge(const Run& run, const Snapshot& first, const Frame& flight, const Wall& wall)
    : wall_(wall),
      body_(run.bodies[wall.body()].name),
      cell_(run.cell_size),
      debris_speed_(flight.debris_speed()) {
  const std::vector<double> volumes = first.volumes();
  double mass = 0.0, volume = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] == flight.projectile)
      momentum_ += flight.copies() * first.mass[i] * wall.frame().axial(first.velocity[i]);
    if (first.body[i] != wall.body()) continue;
    mass += first.mass[i];
    volume += volumes[i];
  }
  const double diameter = diameter_of(run, first, flight);
  window_ = rule::window * diameter;
  plug_ = mass / volume * wall.extent().length() * 0.25 * std::numbers::pi * diameter * diameter;
  verdict_.reason = "no snapshot was judged";
}

/// Returns the momentum along the wall's axis of the debris of other bodies that has not passed its front face yet.
double Judge::momentum_under_way(const Snapshot& snapshot) const {
  const Frame& frame = wall_.frame();
  double sum = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] == wall_.body()) continue;
    const double speed = frame.axial(snapshot.velocity[i]);
    if (speed > debris_speed_ && frame.axial(snapshot.position[i]) < wall_.extent().lower)
      sum += frame.copies() * snapshot.mass[i] * speed;
  }
  return sum;
}

/// Returns the mean plastic strain of the remaining wall.
double Judge::mean_strain(const Snapshot& snapshot, const Wall::Remains& left) {
  const std::vector<double>& strain = *snapshot.scalar("plastic_strain");
  double mass = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (left.wall[i] == 0) continue;
    mass += snapshot.mass[i];
    sum += snapshot.mass[i] * strain[i];
  }
  return mass > 0.0 ? sum / mass : 0.0;
}

/// Returns whether the mean plastic strain has hardly grown over the window. A free wall keeps vibrating elastically, so
/// that no speed tells when it has stopped.
bool Judge::has_stopped(double time, double strain) {
  strains_.emplace_back(time, strain);
  const auto before = std::ranges::find_if(strains_ | std::views::reverse, [&](const auto& entry) {
    return entry.first <= time - window_ * (1.0 - 1e-9);
  });
  return before != std::ranges::rend(strains_) && strain - before->second <= rule::growth * strain;
}

Judge::ComeOff Judge::come_off(const Snapshot& snapshot, const Wall::Remains& left) const {
  const Frame& frame = wall_.frame();
  const std::vector<Cell> cells = cells_of(snapshot, wall_, left);
  ComeOff sum;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != wall_.body() || left.wall[i] != 0) continue;
    const auto at = wall_.cell_at(snapshot.position[i], left.shift);
    const bool before_wall = at && cells[*at].mass > 0.0;
    const double rear = before_wall ? cells[*at].rear : wall_.extent().upper;
    const double speed = before_wall ? cells[*at].momentum / cells[*at].mass : 0.0;
    const double distance = frame.axial(snapshot.position[i]) - rear;
    if (!(distance > rule::gap * cell_)) continue;
    const double mass = frame.copies() * snapshot.mass[i];
    sum.mass += mass;
    sum.speed += mass * (frame.axial(snapshot.velocity[i]) - speed);
    sum.distance += mass * distance;
    sum.particles += 1.0;
  }
  if (sum.mass > 0.0) {
    sum.speed /= sum.mass;
    sum.distance /= sum.mass;
  }
  return sum;
}

Judge::Shape Judge::shape(const Snapshot& snapshot, const Wall::Remains& left) const {
  const Frame& frame = wall_.frame();
  std::map<std::size_t, std::vector<double>> coordinates;  // of the wall, by cells over its face
  double rim = 0.0, count = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (left.wall[i] == 0) continue;
    const double z = frame.axial(snapshot.position[i]);
    if (const auto at = wall_.cell_at(snapshot.position[i], left.shift)) coordinates[*at].push_back(z);
    if (!wall_.began_on_rim(snapshot.id[i])) continue;
    rim += z - frame.axial(*wall_.place_of(snapshot.id[i]));
    count += 1.0;
  }
  if (count > 0.0) rim /= count;
  Shape result;
  for (auto& [cell, z] : coordinates) {
    std::ranges::sort(z);
    result.bulge = std::max(result.bulge, z.back() - wall_.extent().upper - rim);
    double widest = 0.0;
    for (std::size_t k = 1; k < z.size(); ++k) widest = std::max(widest, z[k] - z[k - 1]);
    if (widest > rule::gap * cell_) result.open_area += wall_.cell_area(cell);
  }
  return result;
}

void Judge::add(const Snapshot& snapshot, const Wall::Remains& left) {
  if (decided()) return;
  if (!left.undecided.empty()) {
    verdict_.reason = left.undecided;
    return;
  }
  if (!left.closed) {
    decide(Outcome::perforated, snapshot.time, "a path leads through the wall");
    return;
  }
  const ComeOff off = come_off(snapshot, left);
  const bool spalled = off.mass >= rule::spall_share * plug_ && off.speed > rule::spall_speed;
  const double thickness = wall_.extent().length();
  const auto tell_spall = [&] {
    return fmt::format("{:.3g} mg of it are {:.3g} mm behind it and leave it at {:.3g} m/s", 1e6 * off.mass,
                       1e3 * off.distance, off.speed);
  };
  if (spalled && off.distance >= thickness) {
    decide(Outcome::detached_spall, snapshot.time, tell_spall());
    return;
  }
  if (snapshot.scalar("plastic_strain") == nullptr) {
    verdict_.reason = "the snapshots lack the field plastic_strain";
    return;
  }
  const double coming = momentum_under_way(snapshot) / momentum_;
  if (!(coming <= rule::under_way)) {
    verdict_.reason = fmt::format("{:.2g} of the projectile's momentum is still on its way", coming);
    return;
  }
  if (!has_stopped(snapshot.time, mean_strain(snapshot, left))) {
    verdict_.reason = "the wall still deforms";
    return;
  }
  const Shape bent = shape(snapshot, left);
  if (spalled) {
    decide(Outcome::detached_spall, snapshot.time, tell_spall());
  } else if (bent.open_area >= 0.25 * std::numbers::pi * thickness * thickness) {
    decide(Outcome::attached_spall, snapshot.time,
           fmt::format("it has opened inside over {:.3g} mm^2", 1e6 * bent.open_area));
  } else if (bent.bulge > std::max(rule::bulged * thickness, cell_)) {
    decide(Outcome::bulge, snapshot.time,
           fmt::format("its rear face stands out by {:.3g} mm", 1e3 * bent.bulge));
  } else {
    decide(Outcome::whole, snapshot.time, fmt::format("it has stopped, {:.3g} mm out", 1e3 * bent.bulge));
  }
}

Quantities Judge::measures() const {
  const bool known = decided();
  return {measured("defeated", body_, known ? (verdict_.is_defeat() ? 1.0 : 0.0) : nan, verdict_.reason),
          measured("outcome_time", body_, verdict_.time, verdict_.reason)};
}

Verdict judge(const Run& run, const std::string& body) {
  if (run.snapshots.empty())
    throw InputError(fmt::format("{}: error: has no snapshots", run.folder.string()));
  const auto found = std::ranges::find(run.bodies, body, &BodyInput::name);
  if (found == run.bodies.end()) {
    std::string names;
    for (const BodyInput& known : run.bodies) names += (names.empty() ? "" : ", ") + known.name;
    throw InputError(fmt::format("the run has no body \"{}\" (bodies: {})", body, names));
  }
  const Snapshot first = read_snapshot(run.snapshots.front());
  if (first.scalar("density") == nullptr) return {.reason = "the snapshots lack the field density"};
  const Frame flight = find_frame(run, first);
  Wall wall(run, first, flight, static_cast<std::size_t>(found - run.bodies.begin()));
  Judge judge(run, first, flight, wall);
  for (const SnapshotEntry& entry : run.snapshots) {
    const Snapshot snapshot = read_snapshot(entry);
    judge.add(snapshot, wall.look(snapshot));
    if (judge.decided()) break;
  }
  return judge.verdict();
}

}  // namespace whipple::analysis
