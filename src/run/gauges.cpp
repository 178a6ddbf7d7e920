// SPDX-License-Identifier: BSD-3-Clause
#include "src/run/gauges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <unordered_map>
#include <unordered_set>

#include "src/core/base/error.hpp"
#include "src/core/parallel/mpi.hpp"

namespace whipple::run {
namespace {

using solver::Part;

/// Visits all particles of this rank and the parts of selected elements.
void for_each_part(const solver::Simulation& simulation, const solver::SelectElement& select,
                   const std::function<void(const Part&)>& visit) {
  for (const solver::Carrier* carrier : simulation.carriers()) carrier->for_each_part(select, visit);
}

/// Defines a quantity of the state at a gauge, and whether its mean over particles is weighted with volume or mass.
struct Quantity {
  const char* name;
  const char* unit;
  bool by_volume;
  double (*value)(const MaterialPoints& points, std::size_t p);
};

using P = MaterialPoints;
constexpr auto quantities = std::to_array<Quantity>({
    {"density", "kg/m^3", true, [](const P& a, std::size_t p) { return a.mass[p] / a.volume[p]; }},
    {"pressure", "Pa", true, [](const P& a, std::size_t p) { return a.pressure[p]; }},
    {"temperature", "K", false, [](const P& a, std::size_t p) { return a.temperature[p]; }},
    {"internal_energy", "J/kg", false,
     [](const P& a, std::size_t p) { return a.specific_internal_energy[p]; }},
    {"stress_xx", "Pa", true,
     [](const P& a, std::size_t p) { return a.deviatoric_stress[p].xx - a.pressure[p]; }},
    {"stress_yy", "Pa", true,
     [](const P& a, std::size_t p) { return a.deviatoric_stress[p].yy - a.pressure[p]; }},
    {"stress_zz", "Pa", true,
     [](const P& a, std::size_t p) { return a.deviatoric_stress[p].zz - a.pressure[p]; }},
    {"stress_xy", "Pa", true, [](const P& a, std::size_t p) { return a.deviatoric_stress[p].xy; }},
    {"stress_yz", "Pa", true, [](const P& a, std::size_t p) { return a.deviatoric_stress[p].yz; }},
    {"stress_zx", "Pa", true, [](const P& a, std::size_t p) { return a.deviatoric_stress[p].zx; }},
    {"plastic_strain", "1", false, [](const P& a, std::size_t p) { return a.plastic_strain[p]; }},
    {"failed_fraction", "1", false, [](const P& a, std::size_t p) { return a.failed[p] != 0 ? 1.0 : 0.0; }},
    {"melted_fraction", "1", false, [](const P& a, std::size_t p) { return a.melted_fraction[p]; }},
    {"vaporised_fraction", "1", false, [](const P& a, std::size_t p) { return a.vaporised_fraction[p]; }},
});

/// Accumulates the weighted sums of one gauge over the particles of a rank.
struct Sums {
  double mass = 0.0, volume = 0.0;  // weights
  std::array<double, 3> position{}, velocity{};
  std::array<double, quantities.size()> value{};

  void add(const Part& part, double by_mass, double by_volume) {
    mass += by_mass;
    volume += by_volume;
    for (std::size_t a = 0; a < 3; ++a) {
      position[a] += by_mass * part.position[static_cast<Eigen::Index>(a)];
      velocity[a] += by_mass * part.velocity[static_cast<Eigen::Index>(a)];
    }
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      value[q] += (quantities[q].by_volume ? by_volume : by_mass) * quantities[q].value(part.points, part.p);
    }
  }
};
static_assert(sizeof(Sums) == (8 + quantities.size()) * sizeof(double));

constexpr double support = 1.5;  // of the B-spline, in cells

/// Evaluates the quadratic B-spline at a distance in cells.
double spline(double x) {
  const double r = std::abs(x);
  if (r < 0.5) return 0.75 - r * r;
  return r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}

constexpr const char* last_time_name = "force_gauges_time";
constexpr const char* last_impulses_name = "force_gauges_written";

std::string checkpoint_name(const cases::Gauge& gauge) { return "gauge_particle." + gauge.name; }

/// Finds the particle nearest to each moving gauge; of several, the one with the lowest number. Collective.
std::vector<std::uint64_t> nearest(const std::vector<cases::Gauge>& gauges,
                                   const solver::Simulation& simulation) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> closest(gauges.size(), -infinity), number(gauges.size(), -infinity);
  const auto distance = [&](std::size_t g, const Part& part) {
    return (part.position - gauges[g].position).squaredNorm();
  };
  const bool any = std::ranges::any_of(gauges, [](const cases::Gauge& g) { return g.moving(); });
  const auto for_all = [&](const auto& f) {
    const auto seen = [&](std::uint64_t, const Vector3&, double) { return true; };
    if (any) for_each_part(simulation, seen, f);
  };
  for_all([&](const Part& part) {
    for (std::size_t g = 0; g < gauges.size(); ++g) closest[g] = std::max(closest[g], -distance(g, part));
  });
  parallel::maximum(simulation.communicator(), closest);
  for_all([&](const Part& part) {
    for (std::size_t g = 0; g < gauges.size(); ++g) {
      if (-distance(g, part) == closest[g]) number[g] = std::max(number[g], -static_cast<double>(part.id));
    }
  });
  parallel::maximum(simulation.communicator(), number);
  std::vector<std::uint64_t> ids(gauges.size(), 0);
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    if (gauges[g].moving() && std::isfinite(number[g])) ids[g] = static_cast<std::uint64_t>(-number[g]);
  }
  return ids;
}

}  // namespace

GaugeRecorder::GaugeRecorder(const std::vector<cases::Gauge>& gauges,
                             const std::vector<cases::ForceGauge>& forces,
                             const solver::Simulation& simulation)
    : gauges_(gauges), particle_(nearest(gauges, simulation)), forces_(forces) {
  row_written(simulation);
}

std::vector<GaugeColumn> gauge_columns(const cases::Gauge& gauge) {
  std::vector<GaugeColumn> columns;
  for (const char axis : {'x', 'y', 'z'}) columns.push_back({fmt::format("{}.{}", gauge.name, axis), "m"});
  for (const char axis : {'x', 'y', 'z'})
    columns.push_back({fmt::format("{}.velocity_{}", gauge.name, axis), "m/s"});
  for (const Quantity& quantity : quantities)
    columns.push_back({fmt::format("{}.{}", gauge.name, quantity.name), quantity.unit});
  return columns;
}

std::vector<GaugeColumn> gauge_columns(const cases::ForceGauge& gauge) {
  std::vector<GaugeColumn> columns;
  for (const char axis : {'x', 'y', 'z'})
    columns.push_back({fmt::format("{}.force_{}", gauge.name, axis), "N"});
  for (const char axis : {'x', 'y', 'z'})
    columns.push_back({fmt::format("{}.moment_{}", gauge.name, axis), "N m"});
  return columns;
}

GaugeRecorder::GaugeRecorder(const std::vector<cases::Gauge>& gauges,
                             const std::vector<cases::ForceGauge>& forces, const io::CheckpointValues& values)
    : gauges_(gauges), particle_(gauges.size(), 0), forces_(forces), last_impulse_(forces.size()) {
  if (!forces_.empty()) {
    last_time_ = values.real(last_time_name);
    const std::vector<double>& numbers = values.array(last_impulses_name);
    if (numbers.size() != 6 * forces_.size()) {
      throw InputError(fmt::format("the checkpoint has {} numbers in \"{}\": expected {}", numbers.size(),
                                   last_impulses_name, 6 * forces_.size()));
    }
    for (std::size_t g = 0; g < forces_.size(); ++g) {
      const double* const n = &numbers[6 * g];
      last_impulse_[g] = {Vector3(n[0], n[1], n[2]), Vector3(n[3], n[4], n[5])};
    }
  }
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    if (gauges_[g].moving()) {
      particle_[g] = static_cast<std::uint64_t>(values.integer(checkpoint_name(gauges_[g])));
    }
  }
}

void GaugeRecorder::to_checkpoint(io::CheckpointValues& values) const {
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    if (gauges_[g].moving()) {
      values.integers[checkpoint_name(gauges_[g])] = static_cast<std::int64_t>(particle_[g]);
    }
  }
  if (forces_.empty()) return;
  values.reals[last_time_name] = last_time_;
  std::vector<double>& numbers = values.arrays[last_impulses_name];
  for (const solver::GaugedImpulse& of : last_impulse_) {
    for (const Vector3& v : {of.impulse, of.moment}) numbers.insert(numbers.end(), v.begin(), v.end());
  }
}

void GaugeRecorder::row_written(const solver::Simulation& simulation) {
  last_time_ = simulation.state().time;
  last_impulse_ = simulation.state().gauged;
}

std::vector<io::HistoryValue> GaugeRecorder::row(const solver::Simulation& simulation) const {
  std::vector<io::HistoryValue> row = {{"step", "", static_cast<double>(simulation.state().step)},
                                       {"time", "s", simulation.state().time}};
  if (!gauges_.empty()) add_states(simulation, row);
  add_forces(simulation, row);
  return row;
}

/// Adds impulses over times, (3.6a); 0 in the first row, before which no time has passed.
void GaugeRecorder::add_forces(const solver::Simulation& simulation,
                               std::vector<io::HistoryValue>& row) const {
  const double interval = simulation.state().time - last_time_;
  for (std::size_t g = 0; g < forces_.size(); ++g) {
    const solver::GaugedImpulse& now = simulation.state().gauged[g];
    const std::vector<GaugeColumn> columns = gauge_columns(forces_[g]);
    std::array<double, 6> gained{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      gained[c] = now.impulse[i] - last_impulse_[g].impulse[i];
      gained[c + 3] = now.moment[i] - last_impulse_[g].moment[i];
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      row.push_back({columns[c].name, columns[c].unit, interval > 0.0 ? gained[c] / interval : 0.0});
    }
  }
}

void GaugeRecorder::add_states(const solver::Simulation& simulation,
                               std::vector<io::HistoryValue>& row) const {
  const grid::Geometry& geometry = simulation.setup().geometry;
  std::vector<Sums> sums(gauges_.size());
  std::unordered_multimap<std::uint64_t, std::size_t> gauge_of;
  struct Fixed {
    std::size_t number;
    double per_cell;  ///< of the cells around it, 1/m
  };
  std::vector<Fixed> fixed;
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    if (gauges_[g].moving()) {
      gauge_of.emplace(particle_[g], g);
    } else {
      fixed.push_back({g, 1.0 / geometry.cell_size_at(gauges_[g].position)});
    }
  }
  std::unordered_set<std::uint64_t> elements;  // those with the parts of moving gauges
  for (const auto& [part, g] : gauge_of) elements.insert(part / 8);
  const auto seen = [&](std::uint64_t element, const Vector3& centre, double reach) {
    return elements.contains(element) || std::ranges::any_of(fixed, [&](const Fixed& gauge) {
             const Vector3& place = gauges_[gauge.number].position;
             return gauge.per_cell * ((centre - place).cwiseAbs().maxCoeff() - reach) < support;
           });
  };
  for_each_part(simulation, seen, [&](const Part& part) {
    for (const auto& [g, per_cell] : fixed) {
      const Vector3 r = per_cell * (part.position - gauges_[g].position);
      if (r.cwiseAbs().maxCoeff() >= support) continue;
      const double weight = spline(r[0]) * spline(r[1]) * spline(r[2]);
      sums[g].add(part, weight * part.mass, weight * part.volume);
    }
    if (gauge_of.empty()) return;
    const auto [begin, end] = gauge_of.equal_range(part.id);
    for (auto entry = begin; entry != end; ++entry) sums[entry->second].add(part, 1.0, 1.0);
  });
  parallel::sum(simulation.communicator(), std::span(reinterpret_cast<double*>(sums.data()),
                                                     sums.size() * sizeof(Sums) / sizeof(double)));

  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const Sums& s = sums[g];
    const std::vector<GaugeColumn> columns = gauge_columns(gauges_[g]);
    std::size_t next = 0;
    const auto add = [&](double value) {
      row.push_back({columns[next].name, columns[next].unit, value});
      ++next;
    };
    for (std::size_t a = 0; a < 3; ++a) {
      add(gauges_[g].moving() ? s.position[a] / s.mass : gauges_[g].position[static_cast<Eigen::Index>(a)]);
    }
    for (std::size_t a = 0; a < 3; ++a) add(s.velocity[a] / s.mass);
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      add(s.value[q] / (quantities[q].by_volume ? s.volume : s.mass));  // 0/0 without material
    }
  }
}

}  // namespace whipple::run
