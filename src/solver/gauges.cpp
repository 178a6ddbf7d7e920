// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/gauges.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "src/base/error.hpp"
#include "src/parallel/mpi.hpp"

namespace whipple::solver {
namespace {

/// What a gauge tells, and what it is weighted with in a mean over particles.
struct Quantity {
  const char* name;
  const char* unit;
  bool by_volume;
  double (*value)(const Particles& particles, std::size_t p);
};

using P = Particles;
constexpr auto quantities = std::to_array<Quantity>({
    {"velocity_x", "m/s", false, [](const P& a, std::size_t p) { return a.velocity[p][0]; }},
    {"velocity_y", "m/s", false, [](const P& a, std::size_t p) { return a.velocity[p][1]; }},
    {"velocity_z", "m/s", false, [](const P& a, std::size_t p) { return a.velocity[p][2]; }},
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
    {"plastic_strain", "1", false, [](const P& a, std::size_t p) { return a.plastic_strain[p]; }},
    {"melted_fraction", "1", false, [](const P& a, std::size_t p) { return a.melted_fraction[p]; }},
    {"vaporised_fraction", "1", false, [](const P& a, std::size_t p) { return a.vaporised_fraction[p]; }},
});

/// Weighted sums of one gauge over the particles of a rank.
struct Sums {
  double mass = 0.0, volume = 0.0;  // weights
  std::array<double, 3> position{};
  std::array<double, quantities.size()> value{};

  void add(const Particles& particles, std::size_t p, double by_mass, double by_volume) {
    mass += by_mass;
    volume += by_volume;
    for (std::size_t a = 0; a < 3; ++a) {
      position[a] += by_mass * particles.position[p][static_cast<Eigen::Index>(a)];
    }
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      value[q] += (quantities[q].by_volume ? by_volume : by_mass) * quantities[q].value(particles, p);
    }
  }
};
static_assert(sizeof(Sums) == (5 + quantities.size()) * sizeof(double));

/// Quadratic B-spline of a distance in cells.
double spline(double x) {
  const double r = std::abs(x);
  if (r < 0.5) return 0.75 - r * r;
  return r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}

std::string checkpoint_name(const setup::Gauge& gauge) { return "gauge_particle." + gauge.name; }

/// Particle nearest to each position; of several, the one of the least number.
std::vector<std::uint64_t> nearest(const std::vector<setup::Gauge>& gauges, const Particles& particles,
                                   MPI_Comm communicator) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> closest(gauges.size(), -infinity), number(gauges.size(), -infinity);
  const auto distance = [&](std::size_t g, std::size_t p) {
    return (particles.position[p] - gauges[g].position).squaredNorm();
  };
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    for (std::size_t p = 0; gauges[g].moving() && p < particles.size(); ++p) {
      closest[g] = std::max(closest[g], -distance(g, p));
    }
  }
  parallel::maximum(communicator, closest);
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    for (std::size_t p = 0; gauges[g].moving() && p < particles.size(); ++p) {
      if (-distance(g, p) == closest[g])
        number[g] = std::max(number[g], -static_cast<double>(particles.id[p]));
    }
  }
  parallel::maximum(communicator, number);
  std::vector<std::uint64_t> ids(gauges.size(), 0);
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    if (gauges[g].moving()) ids[g] = static_cast<std::uint64_t>(-number[g]);
  }
  return ids;
}

}  // namespace

GaugeRecorder::GaugeRecorder(const std::vector<setup::Gauge>& gauges, const Particles& particles,
                             MPI_Comm communicator)
    : gauges_(gauges), particle_(nearest(gauges, particles, communicator)) {}

GaugeRecorder::GaugeRecorder(const std::vector<setup::Gauge>& gauges, const io::CheckpointValues& values)
    : gauges_(gauges), particle_(gauges.size(), 0) {
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
}

std::vector<io::HistoryValue> GaugeRecorder::row(const Simulation& simulation) const {
  const Particles& particles = simulation.particles();
  const double per_cell = 1.0 / simulation.setup().domain.cell_size;
  std::vector<Sums> sums(gauges_.size());
  std::unordered_multimap<std::uint64_t, std::size_t> gauge_of;
  std::vector<std::size_t> fixed;
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    if (gauges_[g].moving()) {
      gauge_of.emplace(particle_[g], g);
    } else {
      fixed.push_back(g);
    }
  }
  for (std::size_t p = 0; p < particles.size(); ++p) {
    for (const std::size_t g : fixed) {
      const Vector3 r = per_cell * (particles.position[p] - gauges_[g].position);
      if (r.cwiseAbs().maxCoeff() >= 1.5) continue;
      const double weight = spline(r[0]) * spline(r[1]) * spline(r[2]);
      sums[g].add(particles, p, weight * particles.mass[p], weight * particles.volume[p]);
    }
    if (gauge_of.empty()) continue;
    const auto [begin, end] = gauge_of.equal_range(particles.id[p]);
    for (auto entry = begin; entry != end; ++entry) sums[entry->second].add(particles, p, 1.0, 1.0);
  }
  parallel::sum(simulation.communicator(), std::span(reinterpret_cast<double*>(sums.data()),
                                                     sums.size() * sizeof(Sums) / sizeof(double)));

  std::vector<io::HistoryValue> row = {{"step", "", static_cast<double>(simulation.state().step)},
                                       {"time", "s", simulation.state().time}};
  for (std::size_t g = 0; g < gauges_.size(); ++g) {
    const Sums& s = sums[g];
    for (std::size_t a = 0; a < 3; ++a) {
      const double x =
          gauges_[g].moving() ? s.position[a] / s.mass : gauges_[g].position[static_cast<Eigen::Index>(a)];
      row.push_back({fmt::format("{}.{}", gauges_[g].name, "xyz"[a]), "m", x});
    }
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const double weight = quantities[q].by_volume ? s.volume : s.mass;
      row.push_back({fmt::format("{}.{}", gauges_[g].name, quantities[q].name), quantities[q].unit,
                     s.value[q] / weight});  // 0/0: no matter
    }
  }
  return row;
}

}  // namespace whipple::solver
