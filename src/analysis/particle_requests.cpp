// SPDX-License-Identifier: BSD-3-Clause
// Measures of the particles of a body at snapshots: jets along x, and deviations from exact profiles. Places and
// velocities are those of the case, whatever moves at the start.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "src/analysis/requests.hpp"
#include "src/analysis/run.hpp"
#include "src/analysis/run_table.hpp"
#include "src/case/shapes/axis.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/units.hpp"

namespace whipple::analysis {
namespace {

/// Particles of one body.
struct Particles {
  std::vector<double> x, mass;
  std::vector<Vector3> position, velocity;
  std::map<std::string, std::vector<double>> scalars;  ///< fields, and of the velocity its component along x
};

/// Reads the particles of a body at the last snapshot until a time; nothing without one.
/// @throws InputError if the run has no such body
std::optional<Particles> particles_of(const Run& run, const std::string& name, double time) {
  const auto body = std::ranges::find(run.bodies, name, &BodyInput::name);
  if (body == run.bodies.end()) {
    std::vector<std::string> names;
    for (const BodyInput& other : run.bodies) names.push_back(other.name);
    throw InputError(fmt::format("there is no body \"{}\"; there are {}", name, fmt::join(names, ", ")));
  }
  const SnapshotEntry* last = nullptr;
  for (const SnapshotEntry& entry : run.snapshots) {
    const bool is_until = entry.time <= time * (1.0 + 1e-6);
    if (is_until && (last == nullptr || entry.time >= last->time)) last = &entry;
  }
  if (last == nullptr) return std::nullopt;
  const Snapshot snapshot = read_snapshot(*last);
  Particles found;
  for (std::size_t p = 0; p < snapshot.size(); ++p) {
    if (snapshot.body[p] != static_cast<std::size_t>(body - run.bodies.begin())) continue;
    found.position.emplace_back(snapshot.position[p] + snapshot.time * last->frame_velocity);
    found.x.push_back(found.position.back().x());
    found.mass.push_back(snapshot.mass[p]);
    found.velocity.emplace_back(snapshot.velocity[p] + last->frame_velocity);
    found.scalars["velocity"].push_back(found.velocity.back().x());
    for (const auto& [scalar, values] : snapshot.scalars) found.scalars[scalar].push_back(values[p]);
  }
  return found;
}
std::optional<Particles> particles_of(const Request& request, double time) {
  return particles_of(read_run(request.folder), request.names[0], time);
}
constexpr double whenever = std::numeric_limits<double>::infinity();

/// Orders particles by a value, the greatest first.
template <class Value>
std::vector<std::size_t> descending(std::size_t size, const Value& value) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
  return order;
}

/// Returns the place in an order from which on a fraction of the mass has been counted.
std::size_t place_of_fraction(const Particles& particles, const std::vector<std::size_t>& order,
                              double fraction) {
  const double wanted = fraction * std::accumulate(particles.mass.begin(), particles.mass.end(), 0.0);
  double mass = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    mass += particles.mass[order[i]];
    if (mass >= wanted) return i;
  }
  return order.size() - 1;
}

/// Returns the number of an axis, "x", "y" or "z".
/// @throws InputError for another word
Eigen::Index axis_of(const std::string& word) {
  if (const std::optional<cases::Axis> axis = value_of<cases::Axis>(word)) return index_of(*axis);
  throw InputError(fmt::format("\"{}\" is no axis; there are x, y, z", word));
}

double tip_speed(const Particles& particles, double fraction) {
  const auto speed = [&](std::size_t p) { return particles.velocity[p].x(); };
  const std::vector<std::size_t> order = descending(particles.mass.size(), speed);
  return order.empty() ? nan : speed(order[place_of_fraction(particles, order, fraction)]);
}

/// SI units of the fields whose profiles are compared.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> profile_units = {
    {{"x", "m"},
     {"pressure", "Pa"},
     {"density", "kg/m^3"},
     {"velocity", "m/s"},
     {"temperature", "K"},
     {"internal_energy", "J/kg"}}};

/// Returns a column of a profile in SI units.
/// @throws InputError naming the file if it is missing, has another dimension, or has gaps
std::vector<double> profile_column(const RunTable& table, const std::string& file, const std::string& name) {
  const auto known = std::ranges::find(profile_units, name, [](const auto& entry) { return entry.first; });
  if (known == profile_units.end()) {
    throw InputError(fmt::format(
        "profiles of \"{}\" are not compared: accepted are pressure, density, velocity, temperature, "
        "internal_energy",
        name));
  }
  if (table.columns().empty()) throw InputError(fmt::format("{}: there is no such table", file));
  const Column* const column = table.find(name);
  if (column == nullptr) throw InputError(fmt::format("{}: has no column \"{}\"", file, name));
  if (column->unit.empty()) throw InputError(fmt::format("{}: column \"{}\" has no unit", file, name));
  const double factor = units::conversion(column->unit, known->second).factor;
  std::vector<double> values = column->values;
  for (double& value : values) value *= factor;
  if (values.size() < 2 || !std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
    throw InputError(fmt::format("{}: expected two or more complete rows of \"x\" and \"{}\"", file, name));
  return values;
}

}  // namespace

double profile_error(const Request& request) {
  const RunTable exact(request.table, RunTable::Row::complete);
  const std::string file = request.table.string();
  const std::vector<double> places = profile_column(exact, file, "x"),
                            values = profile_column(exact, file, request.names[1]);
  if (!std::ranges::is_sorted(places)) throw InputError(fmt::format("{}: x must increase", file));
  const std::optional<Particles> found = particles_of(request, whenever);
  if (!found) return nan;
  const auto field = found->scalars.find(request.names[1]);
  if (field == found->scalars.end()) return nan;
  double miss = 0.0, scale = 0.0;
  for (std::size_t p = 0; p < found->mass.size(); ++p) {
    if (found->x[p] < places.front() || found->x[p] > places.back()) continue;
    const double wanted = value_at(found->x[p], places, values);
    miss += found->mass[p] * std::abs(field->second[p] - wanted);
    scale += found->mass[p] * std::abs(wanted);
  }
  return scale > 0.0 ? miss / scale : nan;
}

double reach(const Request& request) {
  const Eigen::Index axis = axis_of(request.names[1]);
  const std::optional<Particles> found = particles_of(request, whenever);
  if (!found || found->mass.empty()) return nan;
  const auto place = [&](std::size_t p) { return found->position[p][axis]; };
  const std::vector<std::size_t> order = descending(found->mass.size(), place);
  return place(order[place_of_fraction(*found, order, request.fraction)]);
}

double height(const Request& request) {
  const Eigen::Index up = axis_of(request.names[1]), along = axis_of(request.names[2]);
  const Run run = read_run(request.folder);
  const std::optional<Particles> found = particles_of(run, request.names[0], whenever);
  if (!found) return nan;
  double greatest = -whenever;
  for (const Vector3& position : found->position) {
    if (std::abs(position[along] - request.place) <= 0.5 * run.cell_size)
      greatest = std::max(greatest, position[up]);
  }
  return greatest;
}

double jet_speed(const Request& request) {
  const std::optional<Particles> found = particles_of(request, whenever);
  return found ? tip_speed(*found, request.fraction) : nan;
}

double jet_gap(const Request& request) {
  const Run run = read_run(request.folder);
  const std::optional<Particles> found = particles_of(run, request.names[0], whenever);
  if (!found || found->mass.empty()) return nan;
  const double tip = tip_speed(*found, request.fraction);
  const std::vector<std::size_t> order =
      descending(found->mass.size(), [&](std::size_t p) { return found->x[p]; });
  std::set<double> cells;
  for (std::size_t i = place_of_fraction(*found, order, request.fraction); i < order.size(); ++i) {
    if (found->velocity[order[i]].x() >= 0.25 * tip)
      cells.insert(std::floor(found->x[order[i]] / run.cell_size));
  }
  if (cells.empty()) return nan;
  return 1.0 - static_cast<double>(cells.size()) / (*cells.rbegin() - *cells.begin() + 1.0);
}

double jet_fraction(const Request& request) {
  const Run run = read_run(request.folder);
  const std::optional<Particles> before = particles_of(run, request.names[0], request.time),
                                 after = particles_of(run, request.names[0], whenever);
  if (!before || !after) return nan;
  const auto body = std::ranges::find(run.bodies, request.names[0], &BodyInput::name);
  const double towards = std::abs(body->velocity.y() + run.frame_velocity.y());
  struct Masses {
    double jet = 0.0, turned = 0.0;
  };
  const auto masses = [&](const Particles& particles) {
    Masses sum;
    for (std::size_t p = 0; p < particles.mass.size(); ++p) {
      if (particles.velocity[p].x() > request.speed) sum.jet += particles.mass[p];
      if (std::abs(particles.velocity[p].y()) < 0.5 * towards) sum.turned += particles.mass[p];
    }
    return sum;
  };
  const Masses first = masses(*before), last = masses(*after);
  return last.turned > first.turned ? (last.jet - first.jet) / (last.turned - first.turned) : nan;
}

}  // namespace whipple::analysis
