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

std::vector<Cell> cells_of(const Snapshot& snapshot, const Wall& wall, const std::vector<std::uint8_t>& held,
                           const Vector3& shift) {
  std::vector<Cell> cells(wall.face_cells());
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (held[i] == 0) continue;
    const auto at = wall.cell_at(snapshot.position[i], shift);
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
  const double per_edge = rule::spall_width * cell_ / run.bodies[wall.body()].spacing;
  least_particles_ =
      flight.is_planar() ? std::max(rule::spall_particles, per_edge * per_edge) : rule::spall_particles;
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

/// Returns strain and failure of all material of the body, whether it still belongs to the remaining wall or not:
/// otherwise a strained point that fails would lower the mean strain. A failed point keeps its last strain.
Judge::State Judge::state_of(const Snapshot& snapshot) const {
  const std::vector<double>& strain = *snapshot.scalar("plastic_strain");
  const std::vector<double>& failed = *snapshot.scalar("failed");
  State state{.time = snapshot.time};
  double mass = 0.0;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != wall_.body()) continue;
    mass += snapshot.mass[i];
    state.strain += snapshot.mass[i] * strain[i];
    if (failed[i] > 0.0) state.failed += wall_.frame().copies() * snapshot.mass[i];
  }
  if (mass > 0.0) state.strain /= mass;
  return state;
}

/// Returns whether mean plastic strain and failed mass have hardly grown over the window. A free wall keeps vibrating
/// elastically, so that no speed tells when it has stopped.
bool Judge::has_stopped(const State& now) {
  states_.push_back(now);
  const auto before = std::ranges::find_if(states_ | std::views::reverse, [&](const State& state) {
    return state.time <= now.time - window_ * (1.0 - 1e-9);
  });
  return before != std::ranges::rend(states_) && now.strain - before->strain <= rule::growth * now.strain &&
         now.failed - before->failed < rule::failing * plug_;
}

/// Returns the motion of the rim of a wall; where nothing of the rim is left, that of the whole.
Judge::Motion Judge::rim_of(const Snapshot& snapshot, const std::vector<std::uint8_t>& held) const {
  const Frame& frame = wall_.frame();
  struct Sum {
    double count = 0.0, displacement = 0.0, speed = 0.0;
  } rim, all;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (held[i] == 0) continue;
    const Vector3* place = wall_.place_of(snapshot.id[i]);
    if (place == nullptr) continue;
    const auto add = [&](Sum& sum) {
      sum.count += 1.0;
      sum.displacement += frame.axial(snapshot.position[i]) - frame.axial(*place);
      sum.speed += frame.axial(snapshot.velocity[i]);
    };
    add(all);
    if (wall_.began_on_rim(snapshot.id[i])) add(rim);
  }
  const Sum& sum = rim.count > 0.0 ? rim : all;
  if (!(sum.count > 0.0)) return {};
  return {sum.displacement / sum.count, sum.speed / sum.count};
}

/// Sums what lies behind the material that holds; where that has no cell over the face, behind its rim.
Judge::ComeOff Judge::come_off(const Snapshot& snapshot, const std::vector<std::uint8_t>& held,
                               const Vector3& shift) const {
  const Frame& frame = wall_.frame();
  const std::vector<Cell> cells = cells_of(snapshot, wall_, held, shift);
  const Motion rim = rim_of(snapshot, held);
  ComeOff sum;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != wall_.body() || held[i] != 0) continue;
    const auto at = wall_.cell_at(snapshot.position[i], shift);
    const bool before_wall = at && cells[*at].mass > 0.0;
    const double rear = before_wall ? cells[*at].rear : wall_.extent().upper + rim.displacement;
    const double speed = before_wall ? cells[*at].momentum / cells[*at].mass : rim.speed;
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

bool Judge::is_spall(const ComeOff& off) const {
  return off.mass >= rule::spall_share * plug_ && off.particles >= least_particles_ * (1.0 - 1e-9) &&
         off.speed > rule::spall_speed;
}

Judge::Shape Judge::shape(const Snapshot& snapshot, const Wall::Remains& left) const {
  const Frame& frame = wall_.frame();
  std::map<std::size_t, std::vector<double>> coordinates;  // of the wall, by cells over its face
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (left.wall[i] == 0) continue;
    const double z = frame.axial(snapshot.position[i]);
    if (const auto at = wall_.cell_at(snapshot.position[i], left.shift)) coordinates[*at].push_back(z);
  }
  const double rim = rim_of(snapshot, left.wall).displacement;
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
  // A layer that parts over the whole face closes it as well: it holds unless it leaves the layer before it.
  ComeOff off = come_off(snapshot, left.wall, left.shift);
  if (!is_spall(off)) off = come_off(snapshot, left.front, left.shift);
  const bool spalled = is_spall(off);
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
  if (!has_stopped(state_of(snapshot))) {
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
